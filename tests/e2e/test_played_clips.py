"""Tests `run --clip`: soft bodies follow the bones of an animation, and no element is inverted."""

import csv
import os
import struct
import unittest

from bundle_file import Bundle, rows
from sbfmt_program import ROOT, SHARED, ProgramTest, convert_once, main, read_bytes, shared

LIZARD = os.path.join(ROOT, "examples", "lizard", "lizard.glb")
FADE_S = 0.5  # over which a clip takes the bones from the rest pose


def distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


def samples(path):
    """Of a PC2 point cache: a list of points a frame."""
    data = read_bytes(path)
    count, = struct.unpack_from("<i", data, 16)
    frames, = struct.unpack_from("<i", data, 28)
    flat = struct.unpack_from(f"<{3 * count * frames}f", data, 32)
    return [rows(flat[3 * count * f:3 * count * (f + 1)], 3) for f in range(frames)]


class Played(ProgramTest):
    def heads(self, bundle):
        """Of the pose file: for each frame, where each bone's head is."""
        numbers, found = {bone.get("name"): i for i, bone in enumerate(bundle.bones)}, {}
        with open(self.path("pose.csv"), encoding="utf-8", newline="") as stream:
            for row in csv.DictReader(stream):
                position = tuple(float(row[key]) for key in ("px", "py", "pz"))
                found.setdefault(int(row["frame"]), {})[numbers[row["bone"]]] = position
        return found

    def check(self, bundle_path, name, seconds, worst, usual):
        """The skin beside linear blend skinning of the keys: how far off any vertex may be, and the mean of all, in
        parts of the body: soft parts lag, and the sections' blends are smoother than the skin's weights."""
        bundle, cache = Bundle(bundle_path), self.path("skin.pc2")
        clip, = [c for c in bundle.clips if c.get("name") == name]
        tracks, duration = bundle.tracks(clip), float(clip.get("duration"))
        report = self.json_of("run", bundle_path, "--clip", name, "--seconds", seconds, "--cache", cache, "--pose",
                              self.path("pose.csv"))
        self.assertTrue(report["valid"], name)
        mesh, = [m for m in bundle.meshes if m.find("skin") is not None]
        played, heads = samples(cache), self.heads(bundle)
        rest = bundle.positions(mesh)
        size = max(distance(rest[0], p) for p in rest)
        for frame in range(int(60 * FADE_S) + 6, len(played), 11):
            time = frame / 60
            time = min(time, duration) if clip.get("loop") == "false" else time % duration
            frames = bundle.pose(tracks, time)
            for number, there in heads[frame].items():
                self.assertLess(distance(there, [row[3] for row in frames[number]]), 1e-3 * size)
            expected = bundle.skinned(mesh, frames)
            off = [distance(a, b) / size for a, b in zip(played[frame], expected)]
            self.assertLess(max(off), worst, f"{name} in frame {frame}")
            self.assertLess(sum(off) / len(off), usual, f"{name} in frame {frame}")

    @unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
    def test_a_fox(self):
        path = convert_once(self.class_folder.name, "fox.sbf", shared("fox", "fox.glb"), "--unit", "0.01")
        self.check(path, "Survey", 3, 0.06, 0.007)
        self.check(path, "Walk", 2, 0.13, 0.02)
        self.check(path, "Run", 2, 0.181, 0.03)

    @unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
    def test_a_walking_human(self):
        path = convert_once(self.class_folder.name, "walk.sbf", shared("walk-dae", "walk.dae"))
        self.check(path, "animation", 7, 0.05, 0.002)

    @unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
    def test_a_spider_that_is_thrown_about(self):
        """Legs swing at 40 rad/s, and feet move 2.4 m within a tick: the legs' soft bodies follow."""
        path = convert_once(self.class_folder.name, "spider.sbf", shared("spider", "spider.glb"))
        for clip in range(5):
            report = self.json_of("run", path, "--clip", str(clip), "--seconds", "3")
            self.assertTrue(report["valid"], clip)
            self.assertGreater(report["volume_ratio_least"], 0.6, clip)

    def test_a_missing_clip_is_refused(self):
        path = convert_once(self.class_folder.name, "lizard.sbf", LIZARD)
        self.assertIn("no clip 'Walk': the file has none", self.fails(2, "run", path, "--clip", "Walk"))


if __name__ == "__main__":
    main()
