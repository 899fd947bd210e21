"""Compares the program's figures of a walk with the same figures measured from the files that it writes."""

import math
import statistics
import unittest

from bundle_file import Bundle
from motion_files import PointCache, read_poses, read_sections, rotated, slip_of, steps_of
from sbfmt_program import ProgramTest, call, example, liz, lizart, main, needs_lizard, write_bytes

STEPS, SLIP_M, DEPARTURE = 4, 0.01, 0.02
START_AND_STOP = b"1 drive 0.5 0\n4 drive 0 0\n"
STILL, MOVING, STOPPED, SETTLED, END = 59, (60, 240), (240, 330), 480, 540


class Walk:
    """Ten seconds at 0.5 m/s, of one lizard."""

    make = None
    speed, least_distance = 0.5, 4.5
    least_volume = 0.95
    departs = True  # whether the skin's departure is asked for: flesh of a small animal hardly moves

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = cls.make(cls.class_folder.name)
        cls.sections = read_sections(cls.file)

    def walk(self, *arguments):
        poses, cache = self.path("p.csv"), self.path("s.pc2")
        report = self.json_of("run", self.file, "--seconds", "10", "--drive", f"{self.speed},0", "--pose", poses, "--cache",
                              cache, "--of", "surface", *arguments)
        return report, read_poses(poses)[0], PointCache(cache)

    def feet(self):
        """Section and bone of each leg's foot."""
        names = set(self.json_of("run", self.file, "--seconds", "0")["steps_taken"])
        return [section for section in self.sections if section.bone in names]

    def test_every_foot_steps_without_slipping(self):
        report, poses, cache = self.walk()
        self.assertTrue(report["valid"])
        self.assertGreaterEqual(report["distance"], self.least_distance)
        self.assertEqual(len(report["steps_taken"]), 4)
        self.assertGreaterEqual(min(report["steps_taken"].values()), STEPS)
        self.assertLessEqual(report["stance_slip"], SLIP_M)
        self.assertLessEqual(report["penetration"], SLIP_M)
        feet = self.feet()
        self.assertEqual(len(feet), 4)
        for foot in feet:
            lift = 0.1 * foot.size
            self.assertGreaterEqual(steps_of(foot.bone, poses, lift), STEPS, foot.name)
            self.assertLessEqual(slip_of(foot, cache), SLIP_M, foot.name)

    def test_the_body_keeps_its_volume(self):
        report = self.json_of("run", self.file, "--seconds", "10", "--drive", f"{self.speed},0")
        self.assertGreaterEqual(report["volume_ratio"], self.least_volume)
        self.assertGreaterEqual(report["volume_ratio_least"], self.least_volume)

    def test_the_body_follows_the_drive(self):
        root = self.json_of("info", self.file)["bones"][0]["name"]
        for drive, axis, sign in (("0.4,0", 2, 1), ("-0.3,0", 2, -1)):
            out = self.path("p.csv")
            report = self.json_of("run", self.file, "--seconds", "5", "--drive", drive, "--pose", out)
            poses = read_poses(out)[0]
            way = poses[300][root][axis] - poses[0][root][axis]
            self.assertGreater(sign * way, 0.7 * 5 * abs(float(drive.split(",")[0])))
            self.assertTrue(report["valid"])
            self.assertLessEqual(report["stance_slip"], SLIP_M)

    def test_it_rotates_on_the_spot(self):
        report = self.json_of("run", self.file, "--seconds", "6", "--drive", "0,0.5")
        self.assertTrue(report["valid"])
        self.assertLess(report["distance"], 0.1)
        self.assertGreaterEqual(min(report["steps_taken"].values()), 2)
        self.assertLessEqual(report["stance_slip"], SLIP_M)

    def test_it_walks_over_uneven_ground(self):
        report = self.json_of("run", self.file, "--seconds", "10", "--drive", f"{self.speed},0.1", "--ground",
                              "noise:0.05,3")
        self.assertTrue(report["valid"])
        self.assertGreaterEqual(min(report["steps_taken"].values()), STEPS)
        self.assertLessEqual(report["stance_slip"], SLIP_M)
        self.assertLessEqual(report["penetration"], 2 * SLIP_M)

    def test_it_stands_still(self):
        out = self.path("s.pc2")
        report = self.json_of("run", self.file, "--seconds", "5", "--cache", out, "--of", "surface")
        self.assertEqual(report["distance"], 0)
        self.assertEqual(set(report["steps_taken"].values()), {0})
        cache = PointCache(out)
        for section in self.sections:
            for i in section.used[::7]:
                moved = max(abs(a - b) for a, b in zip(cache.place(240, section.first + i),
                                                       cache.place(300, section.first + i)))
                self.assertLess(moved, 1e-3, section.name)

    def test_the_skin_overshoots_at_start_and_stop_and_comes_to_rest(self):
        poses_out, cache_out = self.path("p.csv"), self.path("s.pc2")
        script = write_bytes(self.path("s.txt"), START_AND_STOP)
        self.json_of("run", self.file, "--seconds", END / 60, "--script", script, "--pose", poses_out, "--cache",
                     cache_out, "--of", "surface")
        poses, cache = read_poses(poses_out)[0], PointCache(cache_out)
        moving, stopping = [], []
        for section in self.sections:
            def departures(first, last, every=2, section=section):
                return [section.departure(cache, s, poses[s]) for s in range(first, last, every)]
            still = section.departure(cache, STILL, poses[STILL])
            moving.append(max(departures(*MOVING)))
            stopping.append(max(departures(*STOPPED)))
            settled = departures(SETTLED, END, 10)
            self.assertLess(max(settled) - min(settled), 0.002, section.name)
            self.assertAlmostEqual(settled[-1], still, delta=0.01, msg=section.name)
        if self.departs:
            self.assertGreaterEqual(max(moving), DEPARTURE)
            self.assertGreaterEqual(max(stopping), DEPARTURE)
            self.assertGreaterEqual(statistics.median(moving), DEPARTURE / 2)

    def yaws(self, bone, *arguments):
        """How far a bone has turned about +Y since rest, radians, frame by frame."""
        out = self.path("p.csv")
        report = self.json_of("run", self.file, *arguments, "--pose", out)
        self.assertTrue(report["valid"])
        poses = read_poses(out)[0]
        rest = Bundle(self.file).bones
        q = next(tuple(map(float, b.get("rotation", "0 0 0 1").split())) for b in rest if b.get("name") == bone)
        back = rotated((-q[0], -q[1], -q[2], q[3]), (0, 0, 1))
        return [math.atan2(x, z) for x, _, z in (rotated(poses[i][bone][3:], back) for i in sorted(poses))]

    def named(self, *path):
        """Name of the bone that an attribute of the gait names."""
        bundle = Bundle(self.file)
        element = next(bundle.root.iter("gait"))
        for name in path[:-1]:
            element = element.find(name)
        return bundle.bone_names()[bundle.bone_of_id[element.get(path[-1])]]

    def test_the_hips_rotate_with_the_feet(self):
        yaws = self.yaws(self.named("hips"), "--seconds", "6", "--drive", f"{0.5 * self.speed},0")[120:]
        self.assertGreater(max(yaws), math.radians(2))
        self.assertLess(min(yaws), math.radians(-2))
        self.assertAlmostEqual(statistics.mean(yaws), 0, delta=math.radians(2))

    def test_the_head_leads_a_rotation_and_returns(self):
        script = write_bytes(self.path("s.txt"), f"0.5 drive {0.3 * self.speed} 0.5\n4 drive 0 0\n".encode())
        arguments = ("--seconds", "8", "--script", script)
        head, body = (self.yaws(self.named(*path), *arguments) for path in (("head_turn", "bone"), ("body",)))
        ahead = [math.remainder(a - b, 2 * math.pi) for a, b in zip(head, body)]
        self.assertGreater(statistics.mean(ahead[60:240]), 0.1)
        self.assertLess(max(map(abs, ahead[:28])), 0.02)
        self.assertLess(abs(ahead[-1]), 0.05)


@needs_lizard
class ThesisLizard(Walk, ProgramTest):
    make = staticmethod(liz)


@needs_lizard
class ThesisLizardOfTriangles(Walk, ProgramTest):
    make = staticmethod(lizart)
    least_volume = 0.8  # its triangulated hands and feet, 2 dm^3 each, give by an eighth as they come down


class ExampleLizard(Walk, ProgramTest):
    make = staticmethod(example)
    speed, least_distance = 0.3, 2.7  # its legs are 0.2 m long
    departs = False

    def test_the_report_of_a_packed_file_is_the_same(self):
        packed = self.path("a.sbfz")
        self.assertEqual(call("pack", self.file, "-o", packed).status, 0)
        drive = ("--seconds", "2", "--drive", "0.3,0.3")
        self.assertEqual(self.json_of("run", packed, *drive)["state_hash"],
                         self.json_of("run", self.file, *drive)["state_hash"])


if __name__ == "__main__":
    unittest.TestCase.longMessage = True
    main()
