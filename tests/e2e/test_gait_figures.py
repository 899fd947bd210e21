"""How well the example lizard walks: the measures of `run`, over grounds and speeds, against what was asked of them."""

import json
import unittest

from sbfmt_program import ProgramTest, call, example, main, write_bytes

SLIP_M, SLIP_SHARE, PENETRATION_M, KNEE_DEGREES, LIMIT_DEGREES = 0.002, 0.005, 0.001, 5.0, 0.02
BODY_SHARE, BODY_DEGREES = 0.025, 1.5
HARD_KNEE_DEGREES = 10.0  # on stairs, sideways, at three leg lengths a second: what stands, not what was asked for


class Gait(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = example(cls.class_folder.name)
        cls.leg = json.loads(call("run", cls.file, "--seconds", "0", "--format", "json").out)["leg_length"]

    def json(self, *arguments):
        return self.json_of("run", self.file, *arguments)

    def walk(self, speed, *arguments, seconds=4):
        return self.json("--seconds", str(seconds), "--drive", f"{speed * self.leg},0", *arguments)

    def expect(self, report, knee=KNEE_DEGREES):
        self.assertTrue(report["valid"])
        self.assertLessEqual(report["stance_slip"], min(SLIP_M, SLIP_SHARE * self.leg))
        self.assertLessEqual(report["penetration"], PENETRATION_M)
        self.assertEqual(report["skate_ratio"], 0)
        self.assertEqual(report["opposite_feet_in_air"], 0)
        self.assertLessEqual(report["limit_excess"], LIMIT_DEGREES)
        self.assertLessEqual(report["knee_speed_step"], knee)
        self.assertLessEqual(report["body_speed_step"], BODY_SHARE * self.leg)
        self.assertLessEqual(report["body_turn_step"], BODY_DEGREES)

    def test_slow_walks_are_balanced(self):
        for speed in (0.1, 0.3):
            report = self.walk(speed, seconds=6)
            self.expect(report)
            self.assertGreaterEqual(report["support_margin"], 0)
            for leg in report["rhythm"].values():
                self.assertGreaterEqual(leg["duty"], 0.75)

    def test_faster_walks_keep_their_speed(self):
        for speed in (1, 2):
            report = self.walk(speed)
            self.expect(report)
            self.assertGreaterEqual(report["distance"], 0.92 * speed * self.leg * 4)
            for leg in report["rhythm"].values():
                self.assertLessEqual(leg["period_jitter"], 0.12)
        self.expect(self.walk(3), knee=HARD_KNEE_DEGREES)

    def test_backward_turning_starting_stopping(self):
        self.expect(self.walk(-0.5))
        self.expect(self.json("--seconds", "4", "--drive", "0,1"))
        script = write_bytes(self.path("s.txt"), f"0.5 drive {self.leg} 0\n2 drive 0 0\n3 drive 0 0 {0.4 * self.leg}\n".encode())
        self.expect(self.json("--seconds", "5", "--script", script), knee=HARD_KNEE_DEGREES)

    def test_slopes_stairs_and_rough_ground(self):
        self.expect(self.walk(0.5, "--ground", "slope:20"))
        self.expect(self.walk(1, "--ground", f"noise:{0.3 * self.leg},3"))
        self.expect(self.walk(0.5, "--ground", f"stairs:{0.25 * self.leg},{1.5 * self.leg}"), knee=HARD_KNEE_DEGREES)

    def test_any_frame_rate_shows_the_same_walk(self):
        hashes = set()
        for fps in ("30", "60", "144"):
            report = self.walk(1, "--fps", fps, seconds=2)
            self.expect(report)
            hashes.add(report["state_hash"])
        self.assertEqual(len(hashes), 1)


if __name__ == "__main__":
    unittest.TestCase.longMessage = True
    main()
