"""Tests cones and arcs of joints: their shapes, their position in the scene, and when they turn red."""

import math

import bpy
import fixtures
import numpy
from mathutils import Euler, Matrix, Quaternion, Vector
from soft_body_format.overlay import joint_shapes, joints


class Shapes(fixtures.SceneTest):
    def rim(self, bounds):
        shape = joint_shapes.shape_of("spherical", bounds)
        return shape.triangles["cone"].reshape(-1, 3, 3)[:, 1]

    def test_a_cone_opens_by_its_angle(self):
        rim = self.rim({"swing": (0, math.radians(40))})
        numpy.testing.assert_allclose(numpy.degrees(numpy.arccos(rim[:, 0])), 40, atol=1e-4)
        turned = numpy.unwrap(numpy.arctan2(rim[:, 2], rim[:, 1]))
        self.assertAlmostEqual(abs(turned[-1] - turned[0]), 2 * math.pi, delta=0.3)

    def test_a_cone_is_cut_by_ranges(self):
        rim = self.rim({"swing": (0, 1.0), "swing_y": (-0.2, 0.5)})
        maximum = {sign: max(sign * math.atan2(-z, x) for x, y, z in rim if abs(y) < 0.05) for sign in (1, -1)}
        self.assertAlmostEqual(maximum[1], 0.5, delta=1e-3)
        self.assertAlmostEqual(maximum[-1], 0.2, delta=1e-3)

    def test_a_range_that_excludes_rest_is_drawn_as_stated(self):
        rim = self.rim({"swing_y": (0.5, 1.0), "swing_z": (-0.1, 0.1), "swing": (0, 0.3)})
        self.assertGreater(min(math.acos(x) for x, _, _ in rim), 0.49)

    def test_swings_agree_with_the_measure_of_the_runtime(self):
        for y, z in ((0.3, -0.7), (1.2, 0.4), (-2.0, 1.5), (0, 0)):
            turn = Quaternion((0, y, z), math.hypot(y, z)) if y or z else Quaternion()
            self.assert_near(joint_shapes.swing_direction(y, z), turn @ Vector((1, 0, 0)), 1e-6)
            full = turn @ Quaternion((1, 0, 0), 0.6)
            found = joint_shapes.measure(full.w, full.x, full.y, full.z)
            self.assert_near((found["swing_y"], found["swing_z"], found["twist"]), (y, z, 0.6), 1e-5)

    def test_a_hinge_shows_the_range_of_the_bone(self):
        shape = joint_shapes.shape_of("revolute", {"twist": (0, math.pi / 2)}, (0, 1, 0))
        ends = shape.lines["twist"]
        self.assert_near(ends[0], (0, 0.8, 0))
        self.assertTrue(any(numpy.allclose(one, (0, 0, 0.8), atol=1e-6) for one in ends))
        self.assertLess(float(abs(ends[:, 0]).max()), 1e-9)

    def test_a_slider_shows_its_range_in_bone_lengths(self):
        ends = joint_shapes.shape_of("prismatic", {"linear_x": (-0.1, 0.2)}, slide_scale=2).lines["slide"]
        self.assertAlmostEqual(float(ends[:, 0].min()), -0.2)
        self.assertAlmostEqual(float(ends[:, 0].max()), 0.4)

    def test_no_limits_no_shape(self):
        self.assertEqual(joint_shapes.shape_of("spherical", {}).lines, {})


class Scene(fixtures.SceneTest):
    def setUp(self):
        super().setUp()
        self.rig = fixtures.armature("rig", [("upper", None, (1, 2, 3), (1, 2, 5), 0), ("lower", "upper", (1, 2, 5), (1, 2, 6), 0)])
        self.scene.soft_body_format.show_joints = "ALL"

    def joint(self, **settings):
        joint = self.rig.data.bones["lower"].soft_body_format.joint
        for name, value in settings.items():
            setattr(joint, name, value)
        return joint

    def test_a_cone_starts_at_the_bones_head_and_follows_the_parent(self):
        self.joint(kind="spherical", use_cone=True, cone=0.5)
        points = joints.collect(bpy.context)["cone"][1].reshape(-1, 3, 3)
        self.assert_near(points[0, 0], (1, 2, 5), 1e-5)
        numpy.testing.assert_allclose(points[:, 1, 2], 5 + math.cos(0.5), atol=1e-5)
        upper = self.rig.pose.bones["upper"]
        upper.rotation_mode, upper.rotation_euler = "XYZ", (math.pi / 2, 0, 0)
        bpy.context.view_layer.update()
        points = joints.collect(bpy.context)["cone"][1].reshape(-1, 3, 3)
        position = Matrix.Translation((1, 2, 3)) @ (self.rig.data.bones["upper"].matrix_local.to_quaternion().to_matrix() @
                                                 Euler((math.pi / 2, 0, 0)).to_matrix()).to_4x4() @ Vector((0, 2, 0))
        self.assert_near(points[0, 0], position, 1e-5)

    def test_a_pose_beyond_its_limits_is_red(self):
        self.joint(kind="spherical", use_cone=True, cone=0.5, use_twist=True, twist_min=-0.2, twist_max=0.2)
        lower = self.rig.pose.bones["lower"]
        lower.rotation_mode = "XYZ"
        for turn, broken in (((0, 0, 0), False), ((0.4, 0, 0), False), ((0.6, 0, 0), True), ((0, 0.15, 0), False), ((0, 0.3, 0), True)):
            lower.rotation_euler = turn
            bpy.context.view_layer.update()
            self.assertEqual("broken" in joints.collect(bpy.context), broken, turn)

    def test_limit_constraints_are_drawn_too(self):
        one = self.rig.pose.bones["lower"].constraints.new("LIMIT_ROTATION")
        one.owner_space, one.use_limit_x, one.min_x, one.max_x = "LOCAL", True, -0.3, 0.6
        self.assertIn("swing_z", joints.collect(bpy.context))

    def test_only_selected_objects(self):
        self.joint(kind="revolute", axis="X", use_twist=True)
        self.scene.soft_body_format.show_joints = "SELECTED"
        bpy.context.view_layer.objects.active = self.rig
        for bone in self.rig.data.bones:
            if hasattr(bone, "select"):
                bone.select = False
        if hasattr(self.rig.pose.bones[0], "select"):
            for pose in self.rig.pose.bones:
                pose.select = False
        self.rig.data.bones.active = self.rig.data.bones["upper"]
        self.assertEqual(joints.collect(bpy.context), {})
        self.rig.data.bones.active = self.rig.data.bones["lower"]
        self.assertIn("twist", joints.collect(bpy.context))

    def test_colours_are_of_the_theme(self):
        for part in joints.COLORS:
            self.assertEqual(len(joints.color_of(part, 0.5)), 4)
        theme = bpy.context.preferences.themes[0].user_interface
        self.assert_near(joints.color_of("twist", 1.0)[:3], tuple(theme.axis_y)[:3], 1e-6)
