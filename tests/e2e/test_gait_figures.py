"""Tests how well the example lizard walks: some of the walks of walks.py, against their limits."""

import os
import unittest

from sbfmt_program import ROOT, ProgramTest, convert_once, example, main, shared
from walks import all_walks, failures, leg_of, measure, straight

CHOSEN = ("flat, 0.1", "flat, 1", "flat, 2", "flat, backward 0.5", "flat, turning on the spot",
          "flat, starting, stopping, aside", "slope of 20°, 0.3", "stairs of a quarter leg, 1", "noise, 0.5")


class Gait(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = example(cls.class_folder.name)
        cls.leg = leg_of(cls.file)
        cls.walks = {walk.name: walk for walk in all_walks()}

    def test_walks_have_the_requested_quality(self):
        for name in CHOSEN:
            walk = self.walks[name]
            self.assertEqual(failures(measure(self.file, walk, self.leg), walk, self.leg), [])

    def test_walks_keep_their_speed(self):
        for name, speed in (("flat, 0.5", 0.5), ("flat, 2", 2)):
            report = measure(self.file, self.walks[name], self.leg)
            self.assertGreaterEqual(report["distance"], 0.92 * speed * self.leg * self.walks[name].seconds)
            for leg in report["rhythm"].values():
                self.assertLessEqual(leg["period_jitter"], 0.12)

    def test_a_run_reports_a_drive_too_fast_for_the_legs(self):
        kept = [measure(self.file, self.walks[name], self.leg, "--seconds", "3").get("drive_kept")
                for name in ("flat, 1", "flat, 3", "flat, turning on the spot")]
        self.assertGreaterEqual(kept[0], 0.97)
        self.assertLess(kept[1], 0.8)
        self.assertIsNone(kept[2])

    def faster_is_farther(self, *position):
        """Many legs wait for balance, or for a chain that carries them: never for good."""
        file = convert_once(self.class_folder.name, position[-1] + ".sbf", os.path.join(*position))
        leg = leg_of(file)
        slow, fast, fastest = (measure(file, straight("flat", speed), leg, "--seconds", "10")["distance"] for speed in (0.7, 1, 2.5))
        self.assertGreater(fast, 0.75 * leg * 10)
        self.assertGreater(fast, slow)
        self.assertGreater(fastest, fast)

    def test_many_legs_driven_faster_are_not_slower(self):
        for name in ("spider", "caterpillar"):
            with self.subTest(name):
                self.faster_is_farther(ROOT, "examples", name, name + ".glb")

    def test_a_spider_with_its_mass_behind_its_feet_keeps_its_speed(self):
        spider = (shared("..", "zoo"), "easy_enemies_pack", "Spider.glb")
        if not os.path.exists(os.path.join(*spider)):
            self.skipTest("shared/zoo is not there")
        self.faster_is_farther(*spider)

    def test_slow_feet_are_mainly_planted(self):
        report = measure(self.file, self.walks["flat, 0.1"], self.leg)
        for leg in report["rhythm"].values():
            self.assertGreaterEqual(leg["duty"], 0.75)

    def test_any_frame_rate_shows_the_same_walk(self):
        walk = self.walks["flat, 1"]._replace(seconds=2)
        hashes = set()
        for fps in ("30", "60", "144"):
            report = measure(self.file, walk, self.leg, "--fps", fps)
            self.assertEqual(failures(report, walk, self.leg), [])
            hashes.add(report["state_hash"])
        self.assertEqual(len(hashes), 1)


if __name__ == "__main__":
    unittest.TestCase.longMessage = True
    main()
