"""Soft bodies, cloth, pins, joints and gait: field by field what the scene says."""

import math

import bpy
import fixtures
from mathutils import Quaternion, Vector


class Bodies(fixtures.SceneTest):
    def test_values_of_the_panel(self):
        made = fixtures.ball("blob")
        settings = made.soft_body_format
        settings.attributes.preset = "rubber"
        settings.attributes.tears, settings.attributes.tear_strain = True, 1.5
        settings.attributes.pressure_mode, settings.attributes.pressure = "gas", 300
        settings.self_collision, settings.particle_radius = True, 0.02
        body = self.export(build=False).soft_bodies[0]
        self.assertIsNone(body.bone)
        numbers = body.attributes
        self.assert_near((numbers.young_modulus, numbers.density, numbers.friction, numbers.tear_strain, numbers.pressure),
                         (1.2e6, 930, 0.9, 1.5, 300), 1e-3)
        self.assertEqual((numbers.pressure_mode, body.collision.self), ("gas", True))
        self.assertAlmostEqual(body.collision.particle_radius, 0.02, places=6)

    def test_pins_by_weight_and_bone(self):
        rig = fixtures.armature("rig", [("neck", None, (0, 0, 0), (0, 0, 1), 0)])
        cape = fixtures.sheet("cape", 4)
        group = cape.vertex_groups.new(name="collar")
        for vertex, weight in ((3, 1.0), (7, 0.5)):
            group.add([vertex], weight, "REPLACE")
        pin = cape.soft_body_format.pins.add()
        pin.group, pin.armature, pin.bone, pin.stiffness, pin.maximum = "collar", rig, "neck", 200, 0.8
        asset = self.export(build=False)
        found = asset.soft_bodies[0].pins[0]
        self.assertEqual((found.bone, list(found.points)), (asset.bones[0].id, [3, 7]))
        self.assert_near(found.weights, (1, 0.5))
        self.assert_near((found.stiffness, found.maximum), (200, 0.8))

    def test_a_pin_that_lost_its_group_is_an_error(self):
        made = fixtures.ball("blob")
        made.soft_body_format.pins.add().group = "gone"
        self.assertIn("gone", self.refuse(build=False))

    def test_painted_attributes(self):
        made = fixtures.box("b")
        made.vertex_groups.new(name="soft").add([2], 1.0, "REPLACE")
        entry = made.soft_body_format.weight_maps.add()
        entry.group, entry.attribute, entry.low, entry.high = "soft", "young_modulus", 1.0, 0.25
        found = self.export(build=False).soft_bodies[0].weight_maps[0]
        self.assertEqual(found.property, "young_modulus")
        self.assert_near(found.values, [1, 1, 0.25, 1, 1, 1, 1, 1])

    def test_soft_body_modifier(self):
        made = fixtures.sheet("b", 2)
        made.vertex_groups.new(name="goal").add([0, 1], 1.0, "REPLACE")
        made.modifiers.new("s", "SOFT_BODY")
        soft = made.soft_body
        soft.mass, soft.friction, soft.pull, soft.push, soft.damping = 0.5, 2, 0.5, 0.5, 1
        soft.use_stiff_quads, soft.shear, soft.bend = True, 1.0, 5.0
        soft.vertex_group_goal, soft.goal_default, soft.goal_spring = "goal", 1.0, 0.9
        body = self.export(build=False).soft_bodies[0]
        self.assertAlmostEqual(body.attributes.mass, 0.5 * 9, places=5)
        level = body.levels[0]
        sets = {one.kind: one for one in level.springs}
        self.assertEqual({kind: len(one.ends) // 2 for kind, one in sets.items()}, {"structural": 12, "shear": 8, "flexion": 6})
        self.assert_near(set(sets["structural"].stiffness), {2000.0}, 1e-2)
        self.assertEqual(level.simulation.scheme, "heun")
        goal = body.pins[0]
        self.assertEqual(list(goal.points), [0, 1])
        self.assertAlmostEqual(goal.stiffness * goal.weights[0], 9000, delta=1)

    def test_cloth_modifier(self):
        made = fixtures.sheet("cape", 4)
        made.vertex_groups.new(name="collar").add([0, 1, 2], 1.0, "REPLACE")
        cloth = made.modifiers.new("c", "CLOTH").settings
        cloth.mass, cloth.tension_stiffness, cloth.vertex_group_mass = 0.01, 20, "collar"
        body = self.export(build=False).soft_bodies[0]
        self.assertAlmostEqual(body.attributes.area_density, 0.01 * len(made.data.vertices), places=4)
        edge = 1 / math.sqrt(len(made.data.polygons))
        self.assertAlmostEqual(body.attributes.young_modulus * body.attributes.thickness, 20000 / edge, delta=1)
        self.assertEqual(list(body.pins[0].points), [0, 1, 2])


BIPED = [("hip", None, (0, 0, 1), (0, 0, 1.3), 0), ("head", "hip", (0, 0, 1.3), (0, 0, 1.6), 0)] + [
    bone for side, x in (("L", 0.1), ("R", -0.1)) for bone in (
        (f"thigh.{side}", "hip", (x, 0, 1), (x, -0.02, 0.5), 0), (f"shin.{side}", f"thigh.{side}", (x, -0.02, 0.5), (x, 0, 0.1), 0),
        (f"foot.{side}", f"shin.{side}", (x, 0, 0.1), (x, -0.15, 0), 0))]


class Rig(fixtures.SceneTest):
    def setUp(self):
        super().setUp()
        self.rig = fixtures.armature("rig", BIPED)
        fixtures.hang(fixtures.box("belly", (0.3, 0.2, 0.3), (0, 0, 1.1)), self.rig, "hip")

    def joints(self):
        asset = self.export(build=False)
        return asset, {joint.name: joint for joint in asset.joints}

    def test_a_ball_joint_of_the_panel(self):
        joint = self.rig.data.bones["head"].soft_body_format.joint
        joint.kind, joint.use_cone, joint.cone, joint.use_twist = "spherical", True, 0.6, True
        joint.twist_min, joint.twist_max, joint.use_mass, joint.mass = -0.3, 0.4, True, 4.5
        asset, joints = self.joints()
        found = joints["head"]
        self.assertEqual(found.kind, "spherical")
        self.assertEqual([(one.target, round(one.min, 4), round(one.max, 4)) for one in found.limits],
                         [("swing", 0, 0.6), ("twist", -0.3, 0.4)])
        bodies = {body.id: body for body in asset.rigid_bodies}
        self.assertEqual(bodies[found.body_b].name, "head")
        self.assertAlmostEqual(bodies[found.body_b].mass, 4.5)
        places = [tuple(a + b for a, b in zip(record.position, bodies[holder].center)) for record, holder in (
            (found.frame_a, found.body_a), (found.frame_b, found.body_b))]
        self.assert_near(places[0], (0, 1.3, 0))
        self.assert_near(places[1], (0, 1.3, 0))

    def test_limit_rotation_constraints_become_a_hinge(self):
        one = self.rig.pose.bones["shin.L"].constraints.new("LIMIT_ROTATION")
        one.owner_space = "LOCAL"
        one.use_limit_x = one.use_limit_y = one.use_limit_z = True
        one.min_x, one.max_x = -2.4, 0.1
        found = self.joints()[1]["shin.L"]
        self.assertEqual(found.kind, "revolute")
        self.assertEqual([(limit.target, round(limit.min, 4), round(limit.max, 4)) for limit in found.limits],
                         [("twist", -2.4, 0.1)])
        frame = self.rig.matrix_world @ self.rig.data.bones["shin.L"].matrix_local
        axis = frame.to_3x3() @ Vector((1, 0, 0))
        x, y, z, w = found.frame_b.rotation
        turned = Quaternion((w, x, y, z)) @ Vector((1, 0, 0))
        self.assert_near(turned, (axis.x, axis.z, -axis.y), 1e-5)

    def test_ik_limits_become_ranges(self):
        pose = self.rig.pose.bones["thigh.R"]
        pose.use_ik_limit_x, pose.ik_min_x, pose.ik_max_x = True, -1.0, 0.5
        pose.use_ik_limit_y, pose.ik_min_y, pose.ik_max_y = True, -0.2, 0.3
        found = self.joints()[1]["thigh.R"]
        self.assertEqual(found.kind, "spherical")
        self.assertEqual([(limit.target, round(limit.min, 4), round(limit.max, 4)) for limit in found.limits],
                         [("twist", -0.2, 0.3), ("swing_z", -1.0, 0.5)])

    def test_the_gait(self):
        gait = self.scene.soft_body_format.gait
        gait.use, gait.armature, gait.body, gait.hips, gait.head = True, self.rig, "hip", "hip", "head"
        gait.step_height = 0.12
        for number, side in enumerate("LR"):
            leg = gait.legs.add()
            leg.root, leg.end, leg.group = f"thigh.{side}", f"foot.{side}", number
        gait.legs[0].use_pole, gait.legs[0].pole = True, (0.1, -2, 0.5)
        asset = self.export(build=False)
        found = asset.gaits[0]
        self.assertEqual([(leg.name, leg.group) for leg in found.legs], [("foot.L", 0), ("foot.R", 1)])
        self.assert_near(found.legs[0].home, (0.1, 0.1, 0))
        self.assertAlmostEqual(found.legs[0].sole, 0.1, places=6)
        self.assertAlmostEqual(found.step_height, 0.12, places=6)
        self.assert_near(asset.ik_chains[0].pole, (0.1, 0.5, 2))
        self.assertEqual(found.head.bone, asset.bones[1].id)

    def test_a_leg_of_bones_that_do_not_hang_together(self):
        gait = self.scene.soft_body_format.gait
        gait.use, gait.armature = True, self.rig
        leg = gait.legs.add()
        leg.root, leg.end = "thigh.L", "foot.R"
        self.assertIn("thigh.L", self.refuse(build=False))

    def test_settings_survive_saving(self):
        self.rig.data.bones["head"].soft_body_format.joint.kind = "revolute"
        bpy.data.objects["belly"].soft_body_format.attributes.preset = "flesh"
        bpy.ops.wm.save_as_mainfile(filepath=self.path("scene.blend"))
        bpy.ops.wm.open_mainfile(filepath=self.path("scene.blend"))
        self.assertEqual(bpy.data.objects["rig"].data.bones["head"].soft_body_format.joint.kind, "revolute")
        self.assertAlmostEqual(bpy.data.objects["belly"].soft_body_format.attributes.young_modulus, 20000)
