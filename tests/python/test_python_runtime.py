"""The runtime through Python: characters fall, walk, stand on meshes, and come back from snapshots."""

import os
import sys
import unittest
from array import array

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, os.pardir, os.pardir))
sys.path.insert(0, os.path.join(ROOT, "exporters", "python"))
if not os.path.exists(os.environ.get("SBFMT_LIBRARY", "")):
    print("skipped: SBFMT_LIBRARY names no shared library")
    sys.exit(77)
import sbfmt  # noqa: E402
from sbfmt import runtime  # noqa: E402


def lowest(points):
    return min(memoryview(points).cast("B").cast("f")[1::3])


class Jelly(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.asset = sbfmt.load(os.path.join(ROOT, "spec", "samples", "valid", "jelly.sbf")).build()
        cls.model = runtime.Model(cls.asset)

    def test_it_falls_onto_the_ground_and_stays(self):
        with runtime.World(runtime.flat(0.0)) as world:
            jelly = world.add(runtime.Model(self.asset, free=True), position=(0, 0.5, 0))
            before = lowest(jelly.surface(0)) + jelly.origin[1]
            for _ in range(120):
                world.step(1 / 60)
            after = lowest(jelly.surface(0)) + jelly.origin[1]
            self.assertTrue(jelly.health(0).finite)
            self.assertGreaterEqual(jelly.passes(0), 120)
        self.assertGreater(before - after, 0.4)
        self.assertGreater(after, -0.02)

    def test_a_mesh_is_ground(self):
        corners = array("f", [-5, 1, -5, 5, 1, -5, 5, 1, 5, -5, 1, 5])
        ground = runtime.GroundMesh(corners, [0, 2, 1, 0, 3, 2])
        with runtime.World(ground) as world:
            jelly = world.add(self.model)
            for _ in range(60):
                world.step(1 / 60)
            self.assertGreater(lowest(jelly.surface(0)) + jelly.origin[1], 0.95)

    def test_a_triangle_beyond_its_points_is_refused(self):
        with self.assertRaises(sbfmt.Error):
            runtime.GroundMesh(array("f", [0, 0, 0]), [0, 1, 2])

    def test_snapshots_restore_the_same_bits(self):
        with runtime.World(runtime.flat(0.0)) as world:
            jelly = world.add(self.model, position=(0, 0.2, 0))
            kept = world.snapshot()
            hashes = []
            for _ in range(2):
                self.assertTrue(world.restore(kept))
                for _ in range(30):
                    world.step(1 / 60)
                hashes.append((world.state_hash(), bytes(jelly.surface(0))))
        self.assertEqual(*hashes)

    def test_wrong_words_and_worlds_that_are_closed(self):
        with self.assertRaises(ValueError):
            runtime.Model(self.asset, scheme="jam")
        world = runtime.World()
        world.add(self.model)
        world.close()
        world.close()


class Lizard(unittest.TestCase):
    def test_it_walks(self):
        folder = os.path.join(ROOT, "examples", "lizard")
        source = sbfmt.convert(os.path.join(folder, "lizard.obj"), rig=os.path.join(folder, "lizard.glb"))
        asset = source.build()
        with runtime.World(runtime.flat(0.0)) as world:
            lizard = world.add(runtime.Model(asset))
            lizard.drive(forward=0.3)
            for _ in range(180):
                world.step(1 / 60)
            self.assertGreater(lizard.distance, 0.5)
            bones = lizard.bones(len(asset.info()["bones"]))
            self.assertGreater(bones[0].position[2] + lizard.origin[2], 0.5)
            self.assertAlmostEqual(sum(one**2 for one in bones[0].rotation), 1, places=4)
            self.assertEqual(len(lizard.skin(0)), 3 * asset.info()["render_meshes"][0]["vertices"])
            self.assertFalse(any(lizard.torn(0)))


if __name__ == "__main__":
    unittest.main(verbosity=2)
