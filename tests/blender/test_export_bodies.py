"""Compares exported soft bodies, cloth, pins, joints and gait with the scene, field by field."""

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
        soft.use_stiff_quads, soft.shear, soft.bend = True, 0.5, 5.0
        soft.vertex_group_goal, soft.goal_default, soft.goal_spring = "goal", 0.9, 0.9
        body = self.export(build=False).soft_bodies[0]
        self.assertAlmostEqual(body.attributes.mass, 0.5 * 9, places=5)
        level = body.levels[0]
        sets = {one.kind: one for one in level.springs}
        self.assertEqual({kind: len(one.ends) // 2 for kind, one in sets.items()}, {"structural": 12, "shear": 8, "flexion": 6})
        self.assert_near(set(sets["structural"].stiffness), {2000.0}, 1e-2)
        self.assert_near(set(sets["shear"].stiffness), {2000 / 2**0.5 / 4}, 1e-2)
        self.assert_near(set(sets["flexion"].stiffness), {5 * 1000.0}, 1e-2)
        self.assertEqual([list(one.compression_ratio) for one in level.springs], [[], [], []])
        self.assertEqual(level.simulation.scheme, "heun")
        goal = body.pins[0]
        self.assertEqual(list(goal.points), [0, 1])
        strength = 0.9**4 * 0.9
        self.assertAlmostEqual(goal.stiffness * goal.weights[0], 1000 * strength / (1 - strength), delta=1)

    def test_edges_whose_push_differs_from_their_pull(self):
        made = fixtures.sheet("b", 2)
        made.modifiers.new("s", "SOFT_BODY")
        soft = made.soft_body
        soft.use_goal, soft.pull, soft.push, soft.use_stiff_quads, soft.bend = False, 0.5, 0.75, True, 1
        for one in self.export(build=False).soft_bodies[0].levels[0].springs:
            self.assert_near(one.compression_ratio, [3], 1e-5)
        soft.push = 0
        self.assertEqual(list(self.export(build=False).soft_bodies[0].levels[0].springs[0].compression_ratio), [0])
        soft.pull, soft.push = 0, 0.5
        bpy.ops.sbfmt.check()
        self.assertIn("give them a little pull", " ".join(one.message for one in self.scene.soft_body_format.findings))

    def test_goals_pin_and_goal_friction_damps(self):
        made = fixtures.sheet("b", 2)
        made.vertex_groups.new(name="goal").add([0, 1, 2], 1.0, "REPLACE")
        made.vertex_groups["goal"].add([3], 0.5, "REPLACE")
        made.modifiers.new("s", "SOFT_BODY")
        soft = made.soft_body
        soft.vertex_group_goal, soft.goal_default, soft.goal_min, soft.goal_friction = "goal", 1.0, 0, 10
        pins = self.export(build=False).soft_bodies[0].pins
        self.assertEqual([(one.name, list(one.points), one.damping > 0) for one in pins],
                         [("Goal", [0, 1, 2], False), ("Goal", [3], False), ("Goal friction", [3, 4, 5, 6, 7, 8], True)])
        self.assertEqual(list(pins[0].weights), [])  # kinematic
        self.assertAlmostEqual(pins[2].damping * pins[2].weights[0], 0.01 * 10 / math.sqrt(0.001), delta=1e-3)

    def test_sliders_of_the_soft_body_modifier_one_by_one(self):
        made = fixtures.sheet("b", 2)
        made.modifiers.new("s", "SOFT_BODY")
        soft = made.soft_body
        made.vertex_groups.new(name="heavy").add([4], 0.25, "REPLACE")
        made.vertex_groups.new(name="stiff").add(list(range(9)), 0.5, "REPLACE")
        soft.use_goal, soft.mass, soft.vertex_group_mass, soft.vertex_group_spring = False, 2, "heavy", "stiff"
        soft.pull = soft.push = 0.75
        soft.spring_length, soft.plastic, soft.step_min, soft.aero, soft.aerodynamics_type = 50, 30, 7, 60, "SIMPLE"
        soft.use_self_collision, soft.ball_size, soft.ball_stiff = True, 0.4, 0.5
        asset = self.export(build=False)
        body = asset.soft_bodies[0]
        level = body.levels[0]
        self.assertAlmostEqual(list(level.masses)[4], 0.5)
        edges = level.springs[0]
        self.assert_near(set(edges.rest_lengths), {0.25})
        self.assert_near(set(edges.stiffness), {1000 * 3 / 0.25 * 0.5**4}, 1e-2)
        self.assertEqual((level.simulation.scheme, level.simulation.substeps), ("heun", 0))  # by error control
        bpy.ops.sbfmt.check()
        self.assertEqual(level.simulation.step_error, 0)  # Blender's default is nobody's wish
        soft.error_threshold, self.scene.unit_settings.scale_length = 0.02, 0.5
        self.assertAlmostEqual(self.export("finer.sbf", build=False).soft_bodies[0].levels[0].simulation.step_error, 0.01)
        soft.error_threshold, self.scene.unit_settings.scale_length = 0.1, 1
        self.assertEqual((level.simulation.substeps_least, level.simulation.substeps_most), (4, 0))  # of 1/60 s, 0.53 of Blender's frames
        soft.step_min, soft.step_max = 10, 40
        simulation = self.export("bounded.sbf", build=False).soft_bodies[0].levels[0].simulation
        self.assertEqual((simulation.substeps_least, simulation.substeps_most), (0, 22))
        self.assert_near((body.attributes.yield_strain, body.attributes.yield_flow), (0.05, 0.3))
        self.assertTrue(body.collision.self)
        self.assertAlmostEqual(body.collision.particle_radius, 0.4 * 0.5)
        self.assertIn("stiffness and dampening of its self collision", " ".join(one.message for one in self.scene.soft_body_format.findings))
        soft.collision_type, self.scene.unit_settings.scale_length = "MANUAL", 0.5
        self.assertAlmostEqual(self.export("manual.sbf", build=False).soft_bodies[0].collision.particle_radius, 0.4 * 0.5)
        self.assertAlmostEqual(asset.environment.media_density, 8e-4 * 60 * 12, places=5)

    def test_bounds_of_a_goal(self):
        made = fixtures.sheet("b", 2)
        made.vertex_groups.new(name="goal").add([0], 1.0, "REPLACE")
        made.vertex_groups["goal"].add([1], 0.5, "REPLACE")
        made.modifiers.new("s", "SOFT_BODY")
        soft = made.soft_body
        soft.vertex_group_goal, soft.goal_default, soft.goal_min, soft.goal_max = "goal", 0.8, 0.2, 0.9
        soft.goal_spring, soft.goal_friction = 0.5, 10
        goal, held_back = self.export(build=False).soft_bodies[0].pins
        finals = [weight * 0.8 * 0.7 + 0.2 for weight in (1, 0.5, 0)]
        wanted = [1000 * (1 / (1 - final**4 * 0.5) - 1) for final in finals]
        self.assert_near([goal.stiffness * goal.weights[index] for index in (0, 1, 2)], wanted, 1e-3)
        self.assertEqual((goal.damping, len(held_back.points)), (0, 9))
        self.assertAlmostEqual(held_back.damping, 0.01 * 10 / math.sqrt(0.001), places=4)

    def cloth(self, made, **settings):
        found = made.modifiers.new("c", "CLOTH")
        for name, value in settings.items():
            setattr(found.settings, name, value)
        return found

    def test_cloth_modifier(self):
        made = fixtures.sheet("cape", 4)
        made.vertex_groups.new(name="collar").add([0, 1, 2], 1.0, "REPLACE")
        found = self.cloth(made, mass=0.01, tension_stiffness=20, compression_stiffness=20, shear_stiffness=5, tension_damping=4,
                           bending_stiffness=0.5, air_damping=2, vertex_group_mass="collar", pin_stiffness=3)
        found.collision_settings.use_self_collision = True
        found.collision_settings.self_distance_min, found.collision_settings.distance_min = 0.02, 0.03
        found.collision_settings.friction = 8
        body = self.export(build=False).soft_bodies[0]
        numbers, edge = body.attributes, 0.25
        self.assertAlmostEqual(numbers.area_density, 0.01 * len(made.data.vertices), places=4)
        self.assertAlmostEqual(numbers.poisson_ratio, 0.2, places=6)
        self.assertAlmostEqual(numbers.young_modulus * numbers.thickness, 25000 / edge * (1 - 0.04), delta=1)
        self.assertAlmostEqual(numbers.bending_stiffness, 50 * 0.5 * edge**2, places=5)  # each quad's own
        self.assertEqual(len(body.levels), 0)
        self.assertAlmostEqual(numbers.media_friction, 0.02 / math.sqrt(0.001) / 0.01, delta=1e-3)
        self.assertAlmostEqual(numbers.stiffness_damping, 4 / math.sqrt(0.001) / (20000 / edge), places=8)
        self.assertAlmostEqual(numbers.friction, 0.8, places=6)
        self.assertTrue(body.collision.self)
        self.assert_near((body.collision.particle_radius, body.collision.outer_thickness), (0.02, 0.03))
        self.assertEqual(list(body.pins[0].points), [0, 1, 2])
        self.assertEqual(body.pins[0].stiffness, 3000)

    def test_pressure_of_cloth(self):
        made = fixtures.ball("balloon")
        made.vertex_groups.new(name="thin").add([5], 0.5, "REPLACE")
        self.cloth(made, use_pressure=True, uniform_pressure_force=2, vertex_group_pressure="thin")
        body = self.export(build=False).soft_bodies[0]
        self.assertEqual((body.attributes.pressure_mode, body.attributes.pressure), ("gas", 2000))
        self.assertEqual([(one.property, list(one.values)[4:7]) for one in body.weight_maps], [("pressure", [0, 0.5, 0])])
        made.modifiers["c"].settings.use_pressure_volume = True
        self.assertEqual(self.export(build=False).soft_bodies[0].attributes.pressure_mode, "volume")

    def test_painted_stiffness_of_cloth(self):
        made = fixtures.sheet("cape", 4)
        made.vertex_groups.new(name="hem").add([3], 0.5, "REPLACE")
        self.cloth(made, tension_stiffness=10, tension_stiffness_max=30, vertex_group_structural_stiffness="hem",
                   bending_stiffness=1, bending_stiffness_max=2, vertex_group_bending="hem")
        maps = {one.property: list(one.values)[2:5] for one in self.export(build=False).soft_bodies[0].weight_maps}
        self.assertEqual(maps, {"young_modulus": [1, 2, 1], "bending_stiffness": [1, 1.5, 1]})

    def test_internal_springs_of_cloth(self):
        made = fixtures.box("pillow", (1, 1, 0.5))
        self.cloth(made, use_internal_springs=True, internal_tension_stiffness=12, tension_stiffness=20, shear_stiffness=5)
        level = self.export(build=False).soft_bodies[0].levels[0]
        sets = {one.kind: one for one in level.springs}
        self.assertEqual({kind: len(one.ends) // 2 for kind, one in sets.items()}, {"structural": 12, "shear": 12, "internal": 4})
        edge = (8 * 1 + 4 * 0.5) / 12
        self.assert_near(set(sets["internal"].stiffness), {12000 / edge}, 0.1)
        made.modifiers["c"].settings.internal_spring_max_length = 0.4
        kinds = [one.kind for one in self.export(build=False).soft_bodies[0].levels[0].springs]
        self.assertEqual(kinds, ["structural", "shear"])

    def test_cloth_settings_without_a_counterpart_are_reported(self):
        made = fixtures.sheet("cape", 4)
        self.cloth(made, compression_damping=40, use_sewing_springs=True)
        bpy.ops.sbfmt.check()
        reported = " ".join(one.message for one in self.scene.soft_body_format.findings)
        self.assertRegex(reported, "damping of compression differs.*sewing")

    def test_cloth_with_its_own_compression_stiffness_becomes_springs(self):
        made = fixtures.sheet("cape", 4)
        made.vertex_groups.new(name="hem").add(list(range(len(made.data.vertices))), 0.5, "REPLACE")
        self.cloth(made, tension_stiffness=20, compression_stiffness=5, shear_stiffness=10, tension_damping=3, shear_damping=2,
                   shear_stiffness_max=30, vertex_group_shear_stiffness="hem")
        edges, diagonals = self.export(build=False).soft_bodies[0].levels[0].springs
        self.assertEqual((edges.kind, diagonals.kind), ("structural", "shear"))
        self.assert_near((*edges.compression_ratio, *diagonals.compression_ratio), (0.25, 0))
        self.assert_near(set(edges.stiffness), {20000 / 0.25}, 0.1)
        self.assert_near(set(diagonals.stiffness), {20000 / 0.25}, 0.1)
        self.assert_near((edges.damping[0], diagonals.damping[0]), (3 / math.sqrt(0.001), 2 / math.sqrt(0.001)), 1e-4)

    def test_bending_of_triangles(self):
        made = fixtures.mesh_object("flap", [(0, 0, 0), (0.5, 0, 0), (0, 0.5, 0), (0.5, 0.5, 0)], [(0, 1, 2), (1, 3, 2)])
        self.cloth(made, bending_stiffness=0.5)
        side = 0.5 * 2**0.5
        torque, turned = 100 * 0.5 * side * (side / 2 / 3), side**2 / 0.25  # of each about the one side; of a rigidity of 1
        self.assertAlmostEqual(self.export(build=False).soft_bodies[0].attributes.bending_stiffness, torque / turned, places=5)

    def test_thickness_of_collision_settings(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0)])
        part = fixtures.ball("belly")
        fixtures.hang(part, rig, "hip")
        part.modifiers.new("c", "COLLISION")
        part.collision.thickness_outer, part.collision.thickness_inner, part.collision.cloth_friction = 0.03, 0.1, 7
        body = self.export(build=False).soft_bodies[0]
        self.assert_near((body.collision.outer_thickness, body.collision.inner_thickness, body.attributes.friction), (0.03, 0.1, 0.7))

    def test_an_obstacle_is_a_rigid_part_and_a_floor_is_left_to_the_host(self):
        fixtures.ball("blob", center=(0, 0, 3))
        for made in (fixtures.box("post"), fixtures.sheet("floor")):
            made.modifiers.new("c", "COLLISION")
            made.collision.cloth_friction = 4
        asset = self.export(build=False)
        self.assertEqual([(one.name, one.motion, round(one.friction, 6)) for one in asset.rigid_bodies], [("post", "kinematic", 0.4)])
        self.assertEqual([one.name for one in asset.soft_bodies], ["blob"])


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
        positions = [tuple(a + b for a, b in zip(record.position, bodies[holder].center)) for record, holder in (
            (found.frame_a, found.body_a), (found.frame_b, found.body_b))]
        self.assert_near(positions[0], (0, 1.3, 0))
        self.assert_near(positions[1], (0, 1.3, 0))

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

    def limit_location(self, bone, rotation=(), **settings):
        one = self.rig.pose.bones[bone].constraints.new("LIMIT_LOCATION")
        one.owner_space = "LOCAL"
        for name, value in settings.items():
            setattr(one, f"use_{name}", True)
            setattr(one, name, value)
        if rotation:
            two = self.rig.pose.bones[bone].constraints.new("LIMIT_ROTATION")
            two.owner_space = "LOCAL"
            for axis in rotation:
                setattr(two, f"use_limit_{axis}", True)
        return self.joints()[1][bone]

    def bounds(self, joint):
        return [(limit.target, round(limit.min, 4), round(limit.max, 4)) for limit in joint.limits]

    def test_a_limit_location_constraint_makes_a_slider(self):
        self.scene.unit_settings.scale_length = 0.5
        held = dict(min_x=0, max_x=0, min_z=0, max_z=0)
        found = self.limit_location("head", "xyz", min_y=-0.1, max_y=0.2, **held)
        self.assertEqual((found.kind, self.bounds(found)), ("prismatic", [("linear_x", -0.05, 0.1)]))
        x, y, z, w = found.frame_b.rotation
        self.assert_near(Quaternion((w, x, y, z)) @ Vector((1, 0, 0)), (0, 1, 0), 1e-6)

    def test_limit_location_with_one_rotation_makes_a_cylinder(self):
        found = self.limit_location("head", "xz", min_x=0, max_x=0, min_z=0, max_z=0, min_y=-0.1, max_y=0.2)
        self.assertEqual((found.kind, self.bounds(found)), ("cylindrical", [("linear_x", -0.1, 0.2)]))

    def test_other_limits_of_location_bound_all_six(self):
        found = self.limit_location("head", "y", min_x=-0.1, max_x=0.1, max_z=0.3)
        self.assertEqual((found.kind, self.bounds(found)),
                         ("six_dof", [("linear_y", -1e4, 0.3), ("linear_z", -0.1, 0.1), ("twist", 0, 0)]))

    def test_no_sliding_axis_is_a_ball_joint(self):
        found = self.limit_location("head", min_x=0, max_x=0, min_y=0, max_y=0, min_z=0, max_z=0)
        self.assertEqual((found.kind, self.bounds(found)), ("spherical", []))

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

    def test_a_leg_of_unconnected_bones(self):
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
