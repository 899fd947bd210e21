"""Tests inputs whose limbs are posed differently than the rig's mesh: the rig's limbs are rotated to match."""

import math
import re
import unittest

import obj_variants as variants
import posed_inputs
from bundle_file import Bundle, matrix_of
from rigged_weights import Original, add_clip, save_in_a_pose
from sbfmt_program import SOURCE_PARTS, ProgramTest, main

POSES = dict(posed_inputs.POSES)


class PosedInputs(ProgramTest):
    def pose(self, name, change=lambda obj: obj, path=None):
        """The example in its pose as an OBJ of other unit and axes, the expected result, and the messages of the conversion. `path`:
        a changed file of the example."""
        original = Original(path or posed_inputs.path_of(name), self.folder)
        obj, motions = posed_inputs.pose_of(original, POSES[name])
        obj = change(obj)
        variants.write(variants.moved(obj, 0.01, ("x", "-z", "y")), self.path("in.obj"), 6)
        done = self.good("convert", self.path("in.obj"), "--rig", original.path, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        return original, obj, motions, done.err

    def assert_right(self, name, change=lambda obj: obj, skin=0.002, joints=0.005):
        original, obj, motions, printed = self.pose(name, change)
        compared = posed_inputs.motions_to_compare(original, POSES[name])
        errors = posed_inputs.skin_errors(original, obj, self.path("out.sbf"), compared)
        self.assertLess(errors[int(0.99 * (len(errors) - 1))], skin)
        self.assertLess(posed_inputs.joint_error(original, self.path("out.sbf"), motions), joints)
        self.assertNotIn("RIG_OTHER_MESH", printed)
        return obj, printed

    def turns_in(self, printed):
        return {bone: int(degrees) for bone, degrees in re.findall(r"'([^']+)' by (\d+) degrees", printed)}

    def test_arms_raised_by_45_degrees(self):
        obj, printed = self.assert_right("examples/yeti/yeti.glb")
        turns = self.turns_in(printed)
        self.assertEqual(set(turns), {"upper_arm.L", "upper_arm.R"})
        for degrees in turns.values():
            self.assertAlmostEqual(degrees, 45, delta=2)
        heights = [p[1] for mesh in Bundle(self.path("out.sbf")).meshes for p in Bundle(self.path("out.sbf")).positions(mesh)]
        self.assertAlmostEqual(max(heights) - min(heights), max(p[1] for p in obj.points) - min(p[1] for p in obj.points),
                               delta=1e-3)  # the shape is the input's

    def test_clips_of_turned_arms_play_as_before(self):
        """A clip has complete rotations, so its poses are those of the original rig."""
        name, turn = "examples/yeti/yeti.glb", (0, 0, math.sin(0.2), math.cos(0.2))
        add_clip(posed_inputs.path_of(name), self.path("wave.glb"), "wave", {"upper_arm.L": turn, "upper_arm.R": turn}, 0.6)
        original = self.pose(name, path=self.path("wave.glb"))[0]
        before, after = Bundle(original.bundle), Bundle(self.path("out.sbf"))
        names = after.bone_names()
        self.assertEqual(before.bone_names(), names)
        self.assertEqual([len(bundle.clips) for bundle in (before, after)], [1, 1])
        turned = [i for i, bone in enumerate(names) if bone.startswith("upper_arm")]
        for time in (0, 0.3, 0.6):
            one, other = (bundle.pose(bundle.tracks(bundle.clips[0]), time) for bundle in (before, after))
            for i in turned:
                off = max(abs(one[i][k][j] - other[i][k][j]) for k in range(3) for j in range(4))
                self.assertLess(off, 0.03, f"{names[i]} at {time} s")

    def test_legs_in_mid_stride_of_half_the_points(self):
        printed = self.assert_right("examples/calf/calf.glb", variants.simplified, 0.005, 0.015)[1]
        self.assertLessEqual({"fore_upper.L", "fore_upper.R", "hind_upper.L", "hind_upper.R"}, set(self.turns_in(printed)))

    def test_bent_legs_of_an_edited_mesh(self):
        self.assert_right("examples/pup/pup.glb", variants.jiggled, 0.015, 0.005)

    def convert_bones(self, name, turns, change=lambda obj: obj, *options):
        """The posed example with its bones alone: the call, the truth, its OBJ and how its bones moved."""
        original = Original(posed_inputs.path_of(name), self.folder)
        posed_inputs.write_bones(original.path, self.path("bones.glb"))
        obj, motions = posed_inputs.pose_of(original, turns)
        variants.write(change(obj), self.path("in.obj"), 6)
        call = ("convert", self.path("in.obj"), "--rig", self.path("bones.glb"), *SOURCE_PARTS, *options, "-o", self.path("out.sbf"))
        return call, original, obj, motions

    def test_bones_alone_take_the_pose_of_the_input(self):
        for name in ("examples/yeti/yeti.glb", "examples/calf/calf.glb", "examples/pup/pup.glb", "examples/spider/spider.glb"):
            for change in (lambda obj: obj, lambda obj: variants.moved(variants.simplified(obj), 0.01, ("x", "-z", "y"))):
                call, original, _, motions = self.convert_bones(name, POSES[name], change)
                printed = self.good(*call).err
                self.assertIn("limbs were rotated with their children to fit inside it", printed)
                self.assertNotIn("RIG_OTHER_MESH", printed)
                self.assertLess(posed_inputs.joint_error(original, self.path("out.sbf"), motions), 0.022, name)

    def test_bones_saved_in_mid_stride_fit_a_symmetric_input_on_both_sides(self):
        original = Original(posed_inputs.path_of("examples/calf/calf.glb"), self.folder)
        turns = {name + side: (sign * math.sin(0.2), 0, 0, math.cos(0.2)) for side, sign in ((".L", 1), (".R", -1))
                 for name in ("fore_upper", "hind_upper")}
        save_in_a_pose(original.path, self.path("saved.glb"), turns)
        posed_inputs.write_bones(self.path("saved.glb"), self.path("bones.glb"))
        self.good("convert", original.obj_path, "--rig", self.path("bones.glb"), *SOURCE_PARTS, "-o", self.path("out.sbf"))
        bundle = Bundle(self.path("out.sbf"))
        places = {name: [row[3] for row in rest] for name, rest in zip(bundle.bone_names(), bundle.rest)}
        for name, (x, y, z) in places.items():
            if name.endswith(".L"):
                self.assertLess(math.dist(places[name[:-1] + "R"], (-x, y, z)), 1e-4, name)
        still = dict.fromkeys(places, matrix_of())
        self.assertLess(posed_inputs.joint_error(original, self.path("out.sbf"), still), 0.012)

    def test_bones_alone_in_the_pose_of_the_input_are_unchanged(self):
        for name in ("examples/yeti/yeti.glb", "examples/calf/calf.glb"):
            call, original, _, motions = self.convert_bones(name, {})
            self.assertNotIn("has another pose", self.good(*call).err)
            self.assertLess(posed_inputs.joint_error(original, self.path("out.sbf"), motions), 1e-4)

    def test_bones_alone_are_found_inside_an_input_elsewhere(self):
        """Neither the middle of the bones nor the lowest one says where the body is: only the shape does."""
        for name, unit, axes in (("examples/calf/calf.glb", 1, ("x", "y", "z")), ("examples/pup/pup.glb", 0.0254, ("z", "y", "-x"))):
            offset = [x / unit for x in (1.5, 0.125, -2.2)]
            call, original, _, _ = self.convert_bones(name, {}, lambda o, u=unit, a=axes, by=offset: variants.moved(o, u, a, by))
            printed = self.good(*call).err
            self.assertIn("in inches" if unit != 1 else "aligned with the rig: moved by", printed)
            self.assertNotIn("scaled by" if unit == 1 else "RIG_OTHER_MESH", printed)
            found = Bundle(self.path("out.sbf"))
            places = [p for mesh in found.meshes for p in found.positions(mesh)]
            shift = [places[0][k] - original.places[0][k] for k in range(3)]  # the asset stands elsewhere
            joints = dict(zip(found.bone_names(), found.rest))
            before = Bundle(original.bundle)
            for bone, rest in zip(before.bone_names(), before.rest):
                off = math.dist([joints[bone][k][3] - shift[k] for k in range(3)], [row[3] for row in rest])
                self.assertLess(off / posed_inputs.longest_side(original), 0.06, bone)

    def test_bones_alone_whose_limbs_are_not_found_are_refused(self):
        turns = {"fore_upper": ("x", 90), "hind_upper": ("x", -80)}
        call, *_ = self.convert_bones("examples/calf/calf.glb", turns)
        printed = self.fails(1, *call)
        self.assertRegex(printed, r"not all limbs were found: after '.*' were rotated, \d+ % of the bones' length is inside; "
                               r"outside are '.*' by .* m.*give both the same pose, or use --weights compute.*IMPORT_RIG_OUTSIDE")
        self.assertNotIn("this character's rig", printed)
        call, *_ = self.convert_bones("examples/calf/calf.glb", turns, lambda obj: obj, "--weights", "compute")
        self.assertIn("after its limbs were rotated", self.good(*call).err)

    def test_bones_of_another_body_report_parts_without_a_near_bone(self):
        """Two legs and arms turned into a pup lie inside, and its head and trunk have no bones."""
        original = Original(posed_inputs.path_of("examples/pup/pup.glb"), self.folder)
        printed = self.fails(1, "convert", original.obj_path, "--rig", posed_inputs.path_of("examples/yeti/yeti.glb"), "-o", self.path("out.sbf"))
        self.assertRegex(printed, r"another pose or body than the mesh.* few bones, but \d\d % of the mesh has none near; "
                               r"use this character's rig, or use --weights compute \[IMPORT_RIG_OUTSIDE\]")

    def test_an_input_in_the_pose_of_the_rig_rotates_no_bone(self):
        original = Original(posed_inputs.path_of("examples/yeti/yeti.glb"), self.folder)
        for change in (variants.jiggled, variants.simplified):
            variants.write(change(original.obj), self.path("in.obj"))
            done = self.good("convert", self.path("in.obj"), "--rig", original.path, *SOURCE_PARTS, "-o", self.path("out.sbf"))
            self.assertNotIn("has another pose", done.err)


if __name__ == "__main__":
    main()
