"""Tests that `sbfmt run` reports bodies that lost their shape: recoveries and their number, inversion, overstretch, compression."""

import math
import os

from sbfmt_program import ROOT, ProgramTest, call, convert_once, main, write_bytes

EDGES = (-0.1, 0.1)
FACES = ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))
FALL = ("--free", "--raise", "1", "--seconds", "1")


class Recoveries(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        source, cls.file = f"{cls.class_folder.name}/cube.obj", f"{cls.class_folder.name}/cube.sbf"
        points = [f"v {x} {y} {z}\n" for x in EDGES for y in EDGES for z in EDGES]
        faces = ["f " + " ".join(map(str, face)) + "\n" for face in FACES]
        write_bytes(source, "".join(points + faces).encode())
        made = call("convert", source, "-o", cls.file, "--material", "rubber", "--no-calibration")
        assert made.status == 0, made.err

    def run_json(self, *arguments):
        return self.json_of("run", self.file, *FALL, *arguments)

    def test_a_run_without_any_is_valid(self):
        report = self.run_json()
        self.assertEqual((report["valid"], report["recoveries"]), (True, 0))
        self.assertNotIn("recovered", report)
        for key in ("inverted", "stretched", "crushed"):
            self.assertNotIn(key, report)

    def test_an_explosion_is_counted(self):
        report = self.run_json("--scheme", "explicit_euler", "--substeps", "1")
        self.assertFalse(report["valid"])
        self.assertGreater(report["recoveries"], 0)
        self.assertEqual(report["recovered"]["cube"]["recoveries"], report["recoveries"])
        self.assertLess(report["crushed"]["cube"]["min_element_ratio"], 0.2)
        self.assertGreater(report["crushed"]["cube"]["frames"], 0)
        self.assertGreater(report["inverted"]["cube"]["frames"], 0)
        self.assertGreater(report["stretched"]["cube"]["max_strain"], 9)

    def test_extreme_stretch_is_invalid(self):
        """Two bodies of one name, each one region of four points, fall onto a corner at a few frames a second."""
        source, file = self.path("two.obj"), self.path("two.sbf")
        corners = ((0, 0, 0), (.2, 0, 0), (0, .2, 0), (0, 0, .2))
        points = [f"v {x + at} {y} {z}\n" for at in (0, 5) for x, y, z in corners]
        faces = ((1, 3, 2), (1, 2, 4), (1, 4, 3), (2, 3, 4))
        objects = ["o twin\n" + "".join(f"f {a + at} {b + at} {c + at}\n" for a, b, c in faces) for at in (0, 4)]
        write_bytes(source, "".join(points + objects).encode())
        self.good("convert", source, "-o", file, "--material", "muscle", "--springs", "shape_matching")
        arguments = ("run", file, "--free", "--raise", 5, "--fps", 7, "--seconds", 3)
        report = self.json_of(*arguments)
        self.assertEqual((report["valid"], report["recoveries"]), (False, 0))
        self.assertEqual(len(report["stretched"]), 2)
        self.assertEqual(max(one["max_strain"] for one in report["stretched"].values()), report["max_strain"])

    def test_bodies_collapsed_by_springs_are_reported_as_crushed(self):
        """A ball of 7 mm strikes the ground at its speed of sound: its springs rest folded, and none is inside out."""
        source, file = self.path("ball.obj"), self.path("ball.sbf")
        rows, around, radius = 10, 16, 0.007
        angles = [(math.pi * i / rows, 2 * math.pi * k / around) for i in range(1, rows) for k in range(around)]
        points = [(0, 1, 0), *((math.sin(t) * math.cos(p), math.cos(t), math.sin(t) * math.sin(p)) for t, p in angles),
                  (0, -1, 0)]
        ring = [[2 + i * around + k % around for k in range(around + 1)] for i in range(rows - 1)]
        faces = [(1, b, a) for a, b in zip(ring[0], ring[0][1:])] + [(len(points), a, b) for a, b in zip(ring[-1], ring[-1][1:])]
        faces += [(a[k], a[k + 1], b[k + 1], b[k]) for a, b in zip(ring, ring[1:]) for k in range(around)]
        lines = ["v %.9g %.9g %.9g\n" % tuple(radius * x for x in point) for point in points]
        write_bytes(source, "".join(lines + ["f " + " ".join(map(str, face)) + "\n" for face in faces]).encode())
        self.good("convert", source, "-o", file, "--material", "flesh", "--springs", "centroid")
        arguments = ("run", file, "--free", "--raise", 1, "--fps", 20, "--seconds", 3)
        report = self.json_of(*arguments)
        self.assertLess(report["volume_ratio"], 0.5)
        self.assertEqual(report["crushed"]["ball"]["min_volume_ratio"], report["volume_ratio_least"])
        self.assertIn('soft body "ball" ends crushed', call(*arguments).err)

    def test_strain_of_a_walk_is_not_reset(self):
        """A calf of 7 m on stairs: the pins of its soft parts accelerate by more than gravity."""
        large = self.path("large.sbf")
        self.good("convert", os.path.join(ROOT, "examples", "calf", "calf.glb"), "--unit", 10, "-o", large)
        report = self.json_of("run", large, "--seconds", 6, "--drive", "7.42,0", "--ground", "stairs:1,3")
        self.assertGreater(report["max_strain"], 0.4)
        self.assertEqual((report["valid"], report["recoveries"]), (True, 0))

    def test_bodies_inverted_by_the_ground_are_reset(self):
        """A yeti on steps of one and a half metres: its bones hold a thigh in the ground, which pushes the skin out above it."""
        yeti = convert_once(self.class_folder.name, "yeti.sbf", os.path.join(ROOT, "examples", "yeti", "yeti.glb"))
        report = self.json_of("run", yeti, "--seconds", 2.5, "--drive", "0.5,0", "--ground", "stairs:1.5,0.2")
        self.assertFalse(report["valid"])
        self.assertGreater(report["recoveries"], 0)
        self.assertEqual(sum(one["recoveries"] for one in report["recovered"].values()), report["recoveries"])
        self.assertGreater(report["volume_ratio_least"], -0.4)  # for less than four ticks; it was -0.7 for longer

    def test_a_body_that_cannot_be_stepped_falls_as_a_rigid_one(self):
        """No frame of it is inverted, infinite or strained, and yet the run is not valid."""
        arguments = ("run", self.file, *FALL, "--scheme", "symplectic", "--substeps", "4")
        report = self.json_of(*arguments)
        self.assertAlmostEqual(report["volume_ratio_least"], 1, places=4)  # it turns: places are rounded
        self.assertLess(report["max_strain"], 0.01)
        self.assertFalse(report["valid"])
        self.assertGreaterEqual(report["recovered"]["cube"]["recoveries"], 3)
        self.assertGreaterEqual(report["recovered"]["cube"]["rigid_frames"], 30)
        printed = call(*arguments)
        self.assertRegex(printed.err, r'warning: soft body "cube" was reset to its rest shape \d+ times and moved as a rigid body')
        self.assertRegex(printed.out, r"(?m)^valid +false$")
        self.assertRegex(printed.out, r"(?m)^recoveries +[1-9][0-9]*$")
        self.assertRegex(printed.out, r"(?m)^  cube +recoveries \d+, frames_in_a_row \d+, rigid_frames \d+$")


if __name__ == "__main__":
    main()
