"""Options that change what a call does: pins of a conversion, the strength of a ragdoll."""

import csv
import os
import xml.etree.ElementTree as ElementTree

import joint_files
from sbfmt_program import ROOT, ProgramTest, convert_once, main, read_bytes, read_text, write_bytes

CALF = os.path.join(ROOT, "examples", "calf", "calf.glb")


class Pins(ProgramTest):
    def pins(self, *options):
        """The attributes and the number of points of each pin set, by name."""
        self.good("convert", CALF, "--no-build", *options, "-o", self.path("a.sbf"))
        root = ElementTree.fromstring(read_text(self.path("a.sbf")))
        self.bones = {bone.get("id"): bone.get("name") for bone in root.iter("bone")}
        return {pins.get("name"): (pins.attrib, len(pins.find("points").text.split())) for pins in root.iter("pin_set")}

    def test_groups_are_pinned_to_bones_and_the_world(self):
        self.assertEqual(self.pins(), {})
        found = self.pins("--pin", "head", "--pin", "tail3=tail2", "--pin", "tail2=world")
        self.assertEqual(set(found), {"head", "tail3", "tail2"})
        self.assertEqual(self.bones[found["head"][0]["bone"]], "head")
        self.assertEqual(self.bones[found["tail3"][0]["bone"]], "tail2")
        self.assertNotIn("bone", found["tail2"][0])
        for attributes, count in found.values():
            self.assertGreater(count, 10)
            self.assertNotIn("stiffness", attributes)

    def test_goals_have_a_stiffness_and_bounds(self):
        attributes, _ = self.pins("--pin", "head", "--goal", "0.2,0.7", "--goal-stiffness", "123")["head"]
        self.assertEqual(float(attributes["stiffness"]), 123)
        self.assertLess(0, float(attributes["minimum"]))
        self.assertLess(float(attributes["minimum"]), float(attributes["maximum"]))
        self.assertLess(float(attributes["maximum"]), 1)
        softer, _ = self.pins("--pin", "head", "--goal", "0.2,0.7", "--goal-stiffness", "61.5")["head"]
        self.assertEqual(float(softer["stiffness"]), 61.5)

    def test_wrong_values_are_refused(self):
        for options in (("--goal", "0.7,0.2"), ("--goal", "0.2"), ("--goal", "0.2,1.5"), ("--goal", "a,b"), ("--goal-stiffness", "-1"),
                        ("--goal-stiffness", "stiff")):
            printed = self.fails(2, "convert", CALF, "--no-build", "--pin", "head", *options, "-o", self.path("none.sbf"))
            self.assertIn(options[0], printed)
        self.assert_empty_folder()


class Soles(ProgramTest):
    """What a run says of the soles, where feet are put into the ground or aside."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.pup = convert_once(cls.class_folder.name, "pup.sbf", os.path.join(ROOT, "examples", "pup", "pup.glb"))

    def test_feet_in_the_ground(self):
        standing = self.json_of("run", self.pup, "--seconds", "0.5")
        self.assertLess(standing["penetration"], 1e-4)
        sunk = self.json_of("run", self.pup, "--seconds", "0.5", "--raise", "-0.05")
        self.assertAlmostEqual(sunk["penetration"], 0.05, delta=1e-3)

    def test_feet_that_slide(self):
        write_bytes(self.path("aside.txt"), b"0.2 teleport 0.06 0 0 0\n")
        slid = self.json_of("run", self.pup, "--seconds", "0.6", "--script", self.path("aside.txt"))
        self.assertAlmostEqual(slid["stance_slip"], 0.06, delta=0.01)

    def test_exported_motion_is_where_the_character_is(self):
        how = ("--seconds", "0.2", "--fps", "30", "--raise", "0.5")
        self.good("run", self.pup, *how, "--cache", self.path("run.pc2"))
        self.good("export", self.pup, *how, "-o", self.path("export.pc2"))
        self.assertEqual(read_bytes(self.path("run.pc2")), read_bytes(self.path("export.pc2")))


class Strength(ProgramTest):
    def sag(self, *options):
        """How far the arm of the case `hinge` goes from its height in two seconds at most, m."""
        heights = self.heights(*options)
        return max(abs(height - heights[0]) for height in heights)

    def heights(self, *options):
        """Those of the arm, which no drive and no limit holds, frame by frame."""
        text = joint_files.document().replace('gravity="0 0 0"', 'gravity="0 -9.81 0"')
        root = ElementTree.fromstring(text)
        root.find("rigid_bodies/rigid_body[@id='base']").set("mass", "0")  # stays where it is
        for joint in root.find("joints"):
            for part in joint.findall("drive") + joint.findall("limits"):
                joint.remove(part)
        write_bytes(self.path("a.sbf"), ElementTree.tostring(root))
        self.good("run", self.path("a.sbf"), "--seconds", "2", "--pose", self.path("a.csv"), *options)
        with open(self.path("a.csv"), encoding="utf-8") as stream:
            return [float(row["py"]) for row in csv.DictReader(stream) if row["bone"] == "hinge"]

    def test_gravity_is_downward(self):
        for gravity, sign in (("5", -1), ("-5", 1)):
            heights = self.heights("--ragdoll", "--gravity", gravity)
            self.assertGreater(sign * (heights[12] - heights[0]), 1e-3, gravity)

    def test_stronger_drives_follow_the_pose_better(self):
        """From 1 on, and without a bound, a limb stays level by definition; the weaker the drive, the more the limb sinks."""
        limp, weak, enough, unbounded = (self.sag(*options) for options in (
            ("--ragdoll",), ("--strength", "0.3"), ("--strength", "4"), ("--strength", "0")))
        self.assertGreater(limp, 0.05)
        self.assertGreater(weak, 2 * enough)
        self.assertGreater(limp, 2 * enough)
        self.assertLess(enough, 0.02)
        self.assertLess(unbounded, 0.02)

    def test_negative_numbers_are_refused(self):
        write_bytes(self.path("a.sbf"), joint_files.document().encode())
        for value in ("-1", "strong"):
            self.assertIn("--strength", self.fails(2, "run", self.path("a.sbf"), "--strength", value))
        plain = os.path.join(ROOT, "spec", "samples", "valid", "minimal.sbf")
        self.assertIn("--strength", self.fails(2, "run", plain, "--strength", "1"))


if __name__ == "__main__":
    main()
