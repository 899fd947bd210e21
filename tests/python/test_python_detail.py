"""Levels of detail through Python: detail levels of a model, a host that chooses them, and a world that does."""

import os
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, os.pardir, os.pardir))
sys.path.insert(0, os.path.join(ROOT, "exporters", "python"))
if not os.path.exists(os.environ.get("SBFMT_LIBRARY", "")):
    print("skipped: SBFMT_LIBRARY names no shared library")
    sys.exit(77)
import sbfmt  # noqa: E402
from sbfmt import detail, runtime  # noqa: E402

TICK = 1 / 60


class Detail(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = os.path.join(ROOT, "examples", "lizard")
        source = sbfmt.convert(os.path.join(folder, "lizard.obj"), rig=os.path.join(folder, "lizard.glb"))
        cls.asset = source.build()
        cls.model = runtime.Model(cls.asset, detail_levels=True)

    def test_detail_levels_range_from_soft_to_none(self):
        levels = detail.detail_levels(self.model)
        self.assertEqual(levels[0].kind, "soft")
        self.assertEqual([one.kind for one in levels[-2:]], ["bones", "away"])
        self.assertLess(levels[0].error_m, levels[-1].error_m)
        for finer, coarser in zip(levels, levels[1:]):
            self.assertGreater(finer.visits, coarser.visits)
        self.assertEqual(len(detail.detail_levels(runtime.Model(self.asset))), 1)

    def test_a_host_sets_detail_levels(self):
        last = len(detail.detail_levels(self.model)) - 2
        with runtime.World(runtime.flat(0.0)) as world:
            lizard = world.add(self.model)
            self.assertEqual(detail.detail_level(lizard), 0)
            detail.set_detail_level(lizard, last)
            world.step(TICK)
            self.assertEqual(detail.detail_level(lizard), last)
            begun = detail.fade(lizard)
            for _ in range(60):
                world.step(TICK)
            self.assertGreater(begun, 0)
            self.assertEqual(detail.fade(lizard), 0)

    def test_a_world_chooses_levels_by_visibility(self):
        kinds = [one.kind for one in detail.detail_levels(self.model)]
        with runtime.World(runtime.flat(0.0), capacity=20) as world:
            detail.choose(world, error_px=0.5, offscreen_after_s=0.2)
            near, far, behind = (world.add(self.model, position=(0, 0, z)) for z in (2, 60, -30))
            mirrored = world.add(self.model, position=(1, 0, -1.5))
            behind.drive(forward=0.3)  # who stands asleep costs nothing as it is
            detail.show(mirrored, "always")
            detail.set_views(world, [detail.view(eye=(0, 0.5, 0), forward=(0, 0, 1))])
            for _ in range(30):
                world.step(TICK)
            self.assertEqual([kinds[detail.detail_level(one)] for one in (near, far, behind, mirrored)], ["soft", "bones", "away", "soft"])
            self.assertEqual(detail.error_px(behind), 0)
            self.assertGreater(detail.error_px(far), 0)
            seen = detail.visits(world)
            self.assertGreater(seen, detail.detail_levels(self.model)[0].visits)
            for one in (near, mirrored):
                detail.show(one, "never")
            for _ in range(30):
                world.step(TICK)
            self.assertLess(detail.visits(world), seen / 10)
            detail.set_detail_level(near, 0)
            world.step(TICK)
            self.assertEqual(detail.detail_level(near), 0)
            detail.set_detail_level(near, detail.CHOSEN)
            world.step(TICK)
            self.assertNotEqual(detail.detail_level(near), 0)

    def test_a_budget_is_kept(self):
        with runtime.World(runtime.flat(0.0), capacity=20) as world:
            lizards = [world.add(self.model, position=(x - 2, 0, 3)) for x in range(5)]
            detail.choose(world, error_px=0.01)
            detail.set_views(world, [detail.view(eye=(0, 0.5, 0), forward=(0, 0, 1))])
            world.step(TICK)
            free = detail.visits(world)
            self.assertEqual({detail.detail_level(one) for one in lizards}, {0})
            detail.choose(world, error_px=0.01, budget_us=free / 2 / 1e3, ns_per_visit=1)
            world.step(TICK)
            self.assertLessEqual(detail.visits(world), free / 2)
            self.assertGreater(detail.visits(world), 0)

    def test_wrong_calls(self):
        with runtime.World() as world:
            lizard = world.add(self.model)
            with self.assertRaises(sbfmt.Error):
                detail.choose(world, error_px=0)
            with self.assertRaisesRegex(TypeError, "error_px"):
                detail.choose(world, pixels=1)
            with self.assertRaisesRegex(ValueError, "at most 4"):
                detail.set_views(world, 5 * [detail.view((0, 0, 0), (0, 0, 1))])
            with self.assertRaisesRegex(ValueError, "by_views"):
                detail.show(lizard, "sometimes")


if __name__ == "__main__":
    unittest.main(verbosity=2)
