"""Levels of detail through Python: rungs of a model, a host that chooses them, and a world that does."""

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
        cls.model = runtime.Model(cls.asset, ladder=True)

    def test_a_ladder_goes_from_soft_to_away(self):
        rungs = detail.rungs(self.model)
        self.assertEqual(rungs[0].kind, "soft")
        self.assertEqual([one.kind for one in rungs[-2:]], ["bones", "away"])
        self.assertLess(rungs[0].error_m, rungs[-1].error_m)
        for finer, coarser in zip(rungs, rungs[1:]):
            self.assertGreater(finer.visits, coarser.visits)
        self.assertEqual(len(detail.rungs(runtime.Model(self.asset))), 1)

    def test_a_host_puts_characters_on_rungs(self):
        last = len(detail.rungs(self.model)) - 2
        with runtime.World(runtime.flat(0.0)) as world:
            lizard = world.add(self.model)
            self.assertEqual(detail.rung(lizard), 0)
            detail.set_rung(lizard, last)
            world.step(TICK)
            self.assertEqual(detail.rung(lizard), last)
            begun = detail.fade(lizard)
            for _ in range(60):
                world.step(TICK)
            self.assertGreater(begun, 0)
            self.assertEqual(detail.fade(lizard), 0)

    def test_a_world_chooses_by_what_is_seen(self):
        kinds = [one.kind for one in detail.rungs(self.model)]
        with runtime.World(runtime.flat(0.0), capacity=20) as world:
            detail.choose(world, error_px=0.5, away_after_s=0.2)
            near, far, behind = (world.add(self.model, position=(0, 0, z)) for z in (2, 60, -30))
            mirrored = world.add(self.model, position=(1, 0, -1.5))
            behind.drive(forward=0.3)  # who stands asleep costs nothing as it is
            detail.show(mirrored, "always")
            detail.look(world, [detail.view(eye=(0, 0.5, 0), forward=(0, 0, 1))])
            for _ in range(30):
                world.step(TICK)
            self.assertEqual([kinds[detail.rung(one)] for one in (near, far, behind, mirrored)], ["soft", "bones", "away", "soft"])
            self.assertEqual(detail.error_px(behind), 0)
            self.assertGreater(detail.error_px(far), 0)
            seen = detail.visits(world)
            self.assertGreater(seen, detail.rungs(self.model)[0].visits)
            for one in (near, mirrored):
                detail.show(one, "never")
            for _ in range(30):
                world.step(TICK)
            self.assertLess(detail.visits(world), seen / 10)
            detail.set_rung(near, 0)
            world.step(TICK)
            self.assertEqual(detail.rung(near), 0)
            detail.set_rung(near, detail.CHOSEN)
            world.step(TICK)
            self.assertNotEqual(detail.rung(near), 0)

    def test_a_budget_is_kept(self):
        with runtime.World(runtime.flat(0.0), capacity=20) as world:
            lizards = [world.add(self.model, position=(x - 2, 0, 3)) for x in range(5)]
            detail.choose(world, error_px=0.01)
            detail.look(world, [detail.view(eye=(0, 0.5, 0), forward=(0, 0, 1))])
            world.step(TICK)
            free = detail.visits(world)
            self.assertEqual({detail.rung(one) for one in lizards}, {0})
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
                detail.look(world, 5 * [detail.view((0, 0, 0), (0, 0, 1))])
            with self.assertRaisesRegex(ValueError, "by_views"):
                detail.show(lizard, "sometimes")


if __name__ == "__main__":
    unittest.main(verbosity=2)
