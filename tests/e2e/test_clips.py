"""Compares bones and skin of a bundle's clips with the source's nodes, skin and keys, evaluated by a few lines of Python. Uses
real files."""

import os
import unittest

from bundle_file import Bundle
from bvh_file import Bvh
from glb_file import Glb
from sbfmt_program import ProgramTest, SHARED, main, shared


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


@unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
class Clips(ProgramTest):
    def converted(self, path):
        self.good("convert", "--no-build", path, "-o", self.path("out.sbf"))
        return Bundle(self.path("out.sbf"))

    def check_glb(self, path, between=1e-5):
        """Skins the mesh both ways at some times of each clip: the same surface, but for the move onto the ground.
        `between` is what may be lost, in parts of the body, between keys: a bone that was hung elsewhere moves on
        another arc there."""
        glb, bundle = Glb(path), self.converted(path)
        mesh, = bundle.meshes
        sources = bundle.source_points(mesh)
        self.assertEqual([c.get("name") for c in bundle.clips], [a["name"] for a in glb.json["animations"]])
        for clip, animation in zip(bundle.clips, glb.json["animations"]):
            theirs, ours = glb.tracks(animation), bundle.tracks(clip)
            end = max(times[-1] for times, _ in theirs.values())
            self.assertAlmostEqual(float(clip.get("duration")), end, places=4)
            keys = sorted({time for times, _ in theirs.values() for time in times})
            for time in (0, keys[len(keys) // 3], (keys[-1] + keys[-2]) / 2, end):
                moved = bundle.skinned(mesh, bundle.pose(ours, time))
                expected = glb.skinned(glb.worlds(theirs, time))
                size = max(distance(expected[0], p) for p in expected)
                lift = moved[0][1] - expected[sources[0]][1]
                worst = max(distance((x, y - lift, z), expected[i]) for (x, y, z), i in zip(moved, sources))
                within = 1e-5 if time in keys else between
                self.assertLess(worst, within * size, f"{clip.get('name')} at {time}")

    def test_fox(self):
        self.check_glb(shared("fox", "fox.glb"))

    def test_greenman(self):
        self.check_glb(shared("greenman", "greenman.glb"))

    def test_snake(self):
        self.check_glb(shared("snake", "snake.glb"), between=2e-3)

    def test_spider(self):
        self.check_glb(shared("spider", "spider.glb"), between=2e-3)

    def test_motion_capture(self):
        path = shared("mocap", "cmu_01_01.bvh")
        bvh, bundle = Bvh(path), self.converted(path)
        self.assertEqual(bundle.bone_names(), bvh.names)
        clip, = bundle.clips
        self.assertAlmostEqual(float(clip.get("duration")), (bvh.frame_count - 1) * bvh.frame_time, places=3)
        tracks = bundle.tracks(clip)
        rest = bundle.rest[0][1][3] - bvh.worlds()[0][1][3]
        for frame in (0, 1, 777, 2751):
            expected = [tuple(row[3] for row in world) for world in bvh.worlds(frame)]
            moved = [tuple(row[3] for row in world) for world in bundle.pose(tracks, frame * bvh.frame_time)]
            lift = moved[0][1] - expected[0][1]
            self.assertTrue(abs(lift) < 1e-3 or abs(lift - rest) < 1e-3)
            for name, (x, y, z), there in zip(bvh.names, moved, expected):
                self.assertLess(distance((x, y - lift, z), there), 2e-3, f"{name} in frame {frame}")


if __name__ == "__main__":
    main()
