"""Tests the crowd example: it compiles as C11 and C++17, levels depend on distance, the budget is kept, and frames are complete."""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, os.pardir, os.pardir))
PROGRAM, SBFMT = os.environ.get("CROWD_PROGRAM", ""), os.environ.get("SBFMT_PROGRAM", "")
if not os.path.exists(PROGRAM) or not os.path.exists(SBFMT):
    print("skipped: CROWD_PROGRAM and SBFMT_PROGRAM name no programs")
    sys.exit(77)
LINE = re.compile(r"(\d+) s: (\d+) visits a tick; (\d+) soft \((\d+) coarsely\), (\d+) jiggle, (\d+) bones, (\d+) away; "
                  r"predicted off by ([\d.]+) pixels at most, ([\d.]+) on average")


class Crowd(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="sbfmt-crowd-")
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.lizard = os.path.join(cls.folder, "lizard.sbfz")
        model = os.path.join(ROOT, "examples", "lizard", "lizard")
        subprocess.run([SBFMT, "convert", model + ".obj", "--rig", model + ".glb", "-o", cls.lizard], check=True, capture_output=True)

    def crowd(self, *arguments):
        done = subprocess.run([PROGRAM, self.lizard, *map(str, arguments)], capture_output=True, text=True, check=True)
        lines = done.stdout.splitlines()
        self.assertRegex(lines[-1], "^state [0-9a-f]{16}$")
        return [[float(number) for number in LINE.fullmatch(line).groups()] for line in lines[:-1]], lines[-1]

    def test_levels_follow_visibility(self):
        seconds, _ = self.crowd(200, 2, 0)
        self.assertEqual(len(seconds), 2)
        for row in seconds:
            self.assertEqual(row[2] + sum(row[4:7]), 200)
            self.assertGreater(row[2], 0)
            self.assertEqual(row[3], 0)  # springs have one soft level
            self.assertGreater(row[5], 3 * row[2])  # who was near a moment ago is soft for half a second more
            self.assertLess(row[7], 2)
        self.assertGreater(seconds[1][6], 0)

    def test_a_budget_is_kept(self):
        rows, state = self.crowd(60, 2, 600)  # us, by 6 ns a visit: 100,000 visits
        self.assertLess(rows[1][1], 100000)
        self.assertEqual(rows[1][2], 0)
        self.assertEqual(self.crowd(60, 2, 600)[1], state)

    def test_frames_are_whole(self):
        self.crowd(200, 1, 4000, self.folder)
        frames = sorted(name for name in os.listdir(self.folder) if name.endswith(".ppm"))
        self.assertEqual(len(frames), 10)
        with open(os.path.join(self.folder, frames[-1]), "rb") as stream:
            data = stream.read()
        self.assertTrue(data.startswith(b"P6\n960 540\n255\n"))
        pixels = data[15:]
        self.assertEqual(len(pixels), 3 * 960 * 540)
        colours = {pixels[i:i + 3] for i in range(0, len(pixels), 3)}
        self.assertTrue(any(one[0] > one[2] + 60 for one in colours))  # red: soft
        self.assertTrue(any(one[2] > one[0] + 30 for one in colours))  # blue: bones

    def test_colliding_characters_are_soft_and_may_be_coarse(self):
        made = subprocess.run([SBFMT, "build", self.lizard, "--springs", "tetrahedra", "--elements", "200", "--levels", "4", "-o",
                               os.path.join(self.folder, "lattices.sbfz")], capture_output=True, text=True, check=False)
        self.assertEqual(made.returncode, 0, made.stderr)
        done = subprocess.run([PROGRAM, os.path.join(self.folder, "lattices.sbfz"), "8", "1", "0", "-", "close"],
                              capture_output=True, text=True, check=True)
        row = [float(number) for number in LINE.fullmatch(done.stdout.splitlines()[0]).groups()]
        self.assertGreater(row[2], 4)
        self.assertGreater(row[3], 0.5 * row[2])

    def test_wrong_calls(self):
        for arguments, status in (((), 2), ((self.lizard, "0"), 2), ((self.lizard, "2", "1", "0", "-", "far"), 2), ((os.path.join(self.folder, "none.sbfz"),), 1)):
            done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertTrue(done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
