"""Inputs whose limbs stand otherwise than those of the rig's mesh: the rig is turned limb by limb to meet them."""

import re

import obj_variants as variants
import posed_inputs
from bundle_file import Bundle
from rigged_weights import Original
from sbfmt_program import SOURCE_PARTS, ProgramTest, main

POSES = dict(posed_inputs.POSES)


class PosedInputs(ProgramTest):
    def pose(self, name, change=lambda obj: obj):
        """The example in its pose as an OBJ of other unit and axes, the truth, and what is said of the conversion."""
        original = Original(posed_inputs.path_of(name), self.folder)
        obj, motions = posed_inputs.pose_of(original, POSES[name])
        obj = change(obj)
        variants.write(variants.moved(obj, 0.01, ("x", "-z", "y")), self.path("in.obj"), 6)
        done = self.good("convert", self.path("in.obj"), "--rig", original.path, *SOURCE_PARTS, "-o", self.path("out.sbf"))
        return original, obj, motions, done.err

    def assert_right(self, name, change=lambda obj: obj, skin=0.002, joints=0.005):
        original, obj, motions, said = self.pose(name, change)
        compared = posed_inputs.motions_to_compare(original, POSES[name])
        errors = posed_inputs.skin_errors(original, obj, self.path("out.sbf"), compared)
        self.assertLess(errors[int(0.99 * (len(errors) - 1))], skin)
        self.assertLess(posed_inputs.joint_error(original, self.path("out.sbf"), motions), joints)
        self.assertNotIn("RIG_OTHER_MESH", said)
        return obj, said

    def turns_in(self, said):
        return {bone: int(degrees) for bone, degrees in re.findall(r"'([^']+)' by (\d+) degrees", said)}

    def test_arms_raised_by_45_degrees(self):
        obj, said = self.assert_right("examples/yeti/yeti.glb")
        turns = self.turns_in(said)
        self.assertEqual(set(turns), {"upper_arm.L", "upper_arm.R"})
        for degrees in turns.values():
            self.assertAlmostEqual(degrees, 45, delta=2)
        heights = [p[1] for mesh in Bundle(self.path("out.sbf")).meshes for p in Bundle(self.path("out.sbf")).positions(mesh)]
        self.assertAlmostEqual(max(heights) - min(heights), max(p[1] for p in obj.points) - min(p[1] for p in obj.points),
                               delta=1e-3)  # the shape is the input's

    def test_legs_in_mid_stride_of_half_the_points(self):
        said = self.assert_right("examples/calf/calf.glb", variants.simplified, 0.005, 0.015)[1]
        self.assertLessEqual({"fore_upper.L", "fore_upper.R", "hind_upper.L", "hind_upper.R"}, set(self.turns_in(said)))

    def test_bent_legs_of_an_edited_mesh(self):
        self.assert_right("examples/pup/pup.glb", variants.jiggled, 0.015, 0.005)

    def test_bones_alone_that_may_lie_in_wrong_limbs_are_reported(self):
        for name, wanted in (("examples/yeti/yeti.glb", r"only \d+ % of the bones' length lies inside the mesh; outside lie '"),
                             ("examples/calf/calf.glb", r"with its limbs turned, \d+ % of the length of the rig's bones")):
            original = Original(posed_inputs.path_of(name), self.folder)
            posed_inputs.write_bones(original.path, self.path("bones.glb"))
            for obj in (posed_inputs.pose_of(original, POSES[name])[0], original.obj):
                variants.write(obj, self.path("in.obj"), 6)
                said = self.good("convert", self.path("in.obj"), "--rig", self.path("bones.glb"), *SOURCE_PARTS, "-o",
                                 self.path("out.sbf")).err
                self.assertEqual("RIG_OTHER_MESH" in said, obj is not original.obj, said)
                if obj is not original.obj:
                    self.assertRegex(said, "warning: .* " + wanted)

    def test_an_input_in_the_pose_of_the_rig_turns_nothing(self):
        original = Original(posed_inputs.path_of("examples/yeti/yeti.glb"), self.folder)
        for change in (variants.jiggled, variants.simplified):
            variants.write(change(original.obj), self.path("in.obj"))
            done = self.good("convert", self.path("in.obj"), "--rig", original.path, *SOURCE_PARTS, "-o", self.path("out.sbf"))
            self.assertNotIn("stands otherwise", done.err)


if __name__ == "__main__":
    main()
