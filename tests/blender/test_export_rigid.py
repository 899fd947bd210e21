"""Rigid body objects, their constraints, IK constraints and force fields."""

import math

import bpy
import fixtures
from characters import closed_volume
from mathutils import Quaternion, Vector


class RigidObjects(fixtures.SceneTest):
    def active(self, made, **settings):
        bpy.context.view_layer.objects.active = made
        bpy.ops.rigidbody.object_add()
        for name, value in settings.items():
            setattr(made.rigid_body, name, value)
        return made

    def constraint(self, kind, one, other, **settings):
        made = fixtures.link(bpy.data.objects.new(f"joint {kind}", None))
        bpy.context.view_layer.objects.active = made
        bpy.ops.rigidbody.constraint_add(type=kind)
        made.rigid_body_constraint.object1, made.rigid_body_constraint.object2 = one, other
        for name, value in settings.items():
            setattr(made.rigid_body_constraint, name, value)
        return made

    def test_bodies(self):
        self.active(fixtures.box("crate", (1, 2, 3), (0, 0, 2)), mass=7, friction=0.4, restitution=0.25)
        ball = self.active(fixtures.ball("ball"), collision_shape="SPHERE", kinematic=True)
        ball.location = (0, 0, 5)
        bodies = {body.name: body for body in self.export(build=False).rigid_bodies}
        crate = bodies["crate"]
        self.assertEqual((crate.motion, bodies["ball"].motion), ("dynamic", "kinematic"))
        self.assert_near((crate.mass, crate.friction, crate.restitution), (7, 0.4, 0.25))
        self.assert_near(crate.center, (0, 2, 0))
        self.assert_near((max(crate.hull.positions[1::3]), max(crate.hull.positions[2::3])), (3.5, 1))
        self.assert_near((max(bodies["ball"].hull.positions[1::3]), ), (5.5, ))

    def test_every_shape_of_a_hull(self):
        """A part of 2 x 2 x 4 m; each hull has the volume of its shape, but for what its straight facets cut off."""
        volumes = {"BOX": 16, "SPHERE": 4 / 3 * math.pi * 8, "CAPSULE": 4 / 3 * math.pi + 2 * math.pi, "CYLINDER": 4 * math.pi,
                   "CONE": 4 / 3 * math.pi, "CONVEX_HULL": 16, "MESH": 16, "COMPOUND": 16}
        for number, shape in enumerate(volumes):
            made = self.active(fixtures.box(shape, (2, 2, 4)), collision_shape=shape)
            made.location = (10 * number, 0, 0)
        for body in self.export(build=False).rigid_bodies:
            hull = body.hull
            found = closed_volume(hull.positions, hull.polygon_sizes, hull.polygon_points)
            self.assertTrue(0.84 * volumes[body.name] < found < 1.001 * volumes[body.name], (body.name, found, volumes[body.name]))

    def test_layers_and_breaking(self):
        one, other = self.active(fixtures.box("a")), self.active(fixtures.box("b", center=(2, 0, 0)))
        one.rigid_body.collision_collections = [index in (0, 3) for index in range(20)]
        self.constraint("FIXED", one, other, use_breaking=True, breaking_threshold=5)
        self.scene.rigidbody_world.substeps_per_frame = 20
        asset = self.export(build=False)
        self.assertEqual(asset.rigid_bodies[0].layer, 9)
        self.assertAlmostEqual(asset.joints[0].break_force, 5 * 24 * 20, places=2)  # an impulse of a step by the step's time

    def test_every_kind_of_constraint(self):
        one, other = self.active(fixtures.box("a")), self.active(fixtures.box("b", center=(2, 0, 0)))
        wanted = {"FIXED": "fixed", "POINT": "spherical", "HINGE": "revolute", "SLIDER": "prismatic", "PISTON": "cylindrical",
                  "GENERIC": "six_dof", "GENERIC_SPRING": "six_dof", "MOTOR": "six_dof"}
        for kind in wanted:
            self.constraint(kind, one, other)
        joints = {joint.name: joint for joint in self.export(build=False).joints}
        self.assertEqual({name.split()[1]: joint.kind for name, joint in joints.items()}, wanted)

    def test_a_hinge_rotates_about_the_objects_z(self):
        hinge = self.constraint("HINGE", self.active(fixtures.box("a")), self.active(fixtures.box("b", center=(2, 0, 0))),
                                use_limit_ang_z=True, limit_ang_z_lower=-0.5, limit_ang_z_upper=1.0, disable_collisions=False)
        hinge.location, hinge.rotation_euler = (1, 0, 0), (math.pi / 2, 0, 0)  # Z now points along -Y
        joint = self.export(build=False).joints[0]
        x, y, z, w = joint.frame_b.rotation
        self.assert_near(Quaternion((w, x, y, z)) @ Vector((1, 0, 0)), (0, 0, 1), 1e-6)
        self.assertEqual([(limit.target, limit.min, limit.max) for limit in joint.limits], [("twist", -0.5, 1.0)])
        self.assertTrue(joint.collide)
        self.assert_near(joint.frame_a.position, (1, 0, 0))

    def test_a_constraint_without_objects_is_an_error(self):
        self.active(fixtures.box("a"))
        self.constraint("POINT", None, None)
        self.assertIn("names no object", self.refuse(build=False))


class Chains(fixtures.SceneTest):
    def test_an_ik_constraint_with_pole_and_stiffness(self):
        rig = fixtures.armature("rig", [("upper", None, (0, 0, 1), (0, -.1, .5), 0), ("lower", "upper", (0, -.1, .5), (0, 0, 0), 0),
                                        ("hand", "lower", (0, 0, 0), (0, -.2, 0), 0)])
        fixtures.hang(fixtures.box("b"), rig, "upper")
        pole = fixtures.link(bpy.data.objects.new("pole", None))
        pole.location = (0, -2, 0.5)
        one = rig.pose.bones["lower"].constraints.new("IK")
        one.target, one.pole_target, one.chain_count = pole, pole, 2
        rig.pose.bones["upper"].ik_stiffness_x = 0.5
        asset = self.export(build=False)
        chain, names = asset.ik_chains[0], {bone.id: bone.name for bone in asset.bones}
        self.assertEqual((names[chain.root], names[chain.end], chain.solver), ("upper", "hand", "two_bone"))
        self.assert_near(chain.pole, (0, 0.5, 2))
        self.assertEqual([(names[one.bone], one.weight, one.axes) for one in chain.comforts], [("upper", 0.5, (1, 0, 0))])

    def test_stiffness_by_axis_in_a_long_chain(self):
        rig = fixtures.armature("rig", [("one", None, (0, 0, 0), (0, 0, 1), 0), ("two", "one", (0, 0, 1), (0, 0.5, 2), 20),
                                        ("three", "two", (0, 0.5, 2), (0, 0, 3), 0)])
        fixtures.hang(fixtures.box("b"), rig, "one")
        rig.pose.bones["three"].constraints.new("IK").target = bpy.data.objects["b"]
        self.assertEqual(self.export(build=False).ik_chains[0].solver, "ccd")
        stiff = rig.pose.bones["two"]
        stiff.ik_stiffness_x, stiff.ik_stiffness_y, stiff.ik_stiffness_z = 0.25, 0.75, 0.5
        asset = self.export(build=False)
        chain, names = asset.ik_chains[0], {bone.id: bone.name for bone in asset.bones}
        self.assertEqual((chain.solver, names[chain.comforts[0].bone], chain.comforts[0].weight), ("damped_least_squares", "two", 0.75))
        self.assert_near(chain.comforts[0].axes, (1 / 3, 1, 2 / 3))


    def test_a_chain_whose_last_bone_has_nothing_at_its_tail_gets_a_tip(self):
        rig = fixtures.armature("rig", [("one", None, (0, 0, 0), (0, 0, 1), 0), ("two", "one", (0, 0, 1), (0, 0.5, 2), 20),
                                        ("three", "two", (0, 0.5, 2), (0, 0, 3), 0)])
        fixtures.hang(fixtures.box("b"), rig, "one")
        rig.pose.bones["three"].constraints.new("IK").target = bpy.data.objects["b"]
        asset = self.export(build=False)
        tip, chain = asset.bones[3], asset.ik_chains[0]
        self.assertEqual((tip.name, tip.parent, chain.end, chain.root, chain.solver),
                         ("three tip", asset.bones[2].id, tip.id, asset.bones[0].id, "ccd"))
        self.assert_near(tip.head, (0, 3, 0))

    def test_a_chain_by_the_head_of_its_bone(self):
        rig = fixtures.armature("rig", [("one", None, (0, 0, 0), (0, 0, 1), 0), ("two", "one", (0, 0, 1), (0, 0.5, 2), 20),
                                        ("three", "two", (0, 0.5, 2), (0, 0, 3), 0)])
        fixtures.hang(fixtures.box("b"), rig, "one")
        made = rig.pose.bones["three"].constraints.new("IK")
        made.target, made.use_tail, made.chain_count = bpy.data.objects["b"], False, 2
        asset = self.export(build=False)
        names = {bone.id: bone.name for bone in asset.bones}
        chain = asset.ik_chains[0]
        self.assertEqual((names[chain.root], names[chain.end], chain.solver, len(asset.bones)), ("one", "three", "two_bone", 3))


class Surroundings(fixtures.SceneTest):
    def test_gravity_and_wind(self):
        fixtures.box("b")
        self.scene.gravity = (0, 0, -1.62)
        bpy.ops.object.effector_add(type="WIND", location=(1, 2, 3))
        bpy.context.object.field.strength = 4
        environment = self.export(build=False).environment
        self.assert_near(environment.gravity, (0, -1.62, 0))
        self.assertEqual([(field.kind, field.strength) for field in environment.fields], [("uniform", 4.0)])
        self.assert_near(environment.fields[0].position, (1, 3, -2))
        self.assert_near(environment.fields[0].direction, (0, 1, 0))

    def test_force_fields_act_as_in_blender(self):
        cape = fixtures.sheet("cape", 4)
        cape.modifiers.new("c", "CLOTH").settings.mass = 0.02
        bpy.ops.object.effector_add(type="WIND")
        bpy.context.object.field.strength = 300
        self.scene.render.fps = 30
        wind, flow = self.export(build=False).environment.fields
        self.assertAlmostEqual(wind.strength, 300 * 20 / (30 * 0.02 * 25), places=3)
        self.assertEqual((flow.kind, flow.name), ("drag", "Wind flow" if wind.name == "Wind" else f"{wind.name} flow"))
        self.assertAlmostEqual(flow.strength, 20 * 0.001**0.5 / (0.02 * 25), places=4)  # new winds of Blender's have a flow of 1
        jelly = fixtures.box("jelly")
        jelly.modifiers.new("s", "SOFT_BODY")
        bpy.ops.sbfmt.check()
        self.assertIn("and jelly otherwise", " ".join(one.message for one in self.scene.soft_body_format.findings))
        cape.modifiers.clear()
        jelly.soft_body.mass = 0.5
        self.assertAlmostEqual(self.export(build=False).environment.fields[0].strength, -300 * 10 / (30 * 0.5), places=3)

    def test_drag_follows_blenders_quadratic_setting(self):
        fixtures.sheet("cape", 4).modifiers.new("c", "CLOTH").settings.mass = 0.02
        bpy.ops.object.effector_add(type="DRAG")
        field = bpy.context.object.field
        field.linear_drag, field.quadratic_drag, field.falloff_power = 0, 3, 1.5
        found = self.export(build=False).environment.fields[0]
        self.assertEqual((found.kind, found.falloff), ("drag", 1.5))
        self.assertAlmostEqual(found.strength, 3 * 20 * 0.001**0.5 / (0.02 * 25), places=4)

    def test_omitted_settings_of_a_field_are_reported(self):
        fixtures.box("b")
        for kind, settings, expected_text in (("FORCE", {"noise": 2, "shape": "LINE"}, "noise; the shape Line"),
                                     ("WIND", {"use_max_distance": True, "z_direction": "POSITIVE"}, "one side alone; the shape Plane"),
                                     ("FORCE", {"use_min_distance": True, "falloff_type": "TUBE"}, "minimum distance; falloff as a tube"),
                                     ("DRAG", {"linear_drag": 1}, "square of the speed"), ("VORTEX", {}, "its growth with distance"),
                                     ("WIND", {}, None)):
            bpy.ops.object.effector_add(type=kind)
            made = bpy.context.object
            for name, value in settings.items():
                setattr(made.field, name, value)
            bpy.ops.sbfmt.check()
            reported = [one.message for one in self.scene.soft_body_format.findings if one.object_name == made.name]
            self.assertIn(expected_text, " ".join(reported)) if expected_text else self.assertEqual(reported, [])
            bpy.data.objects.remove(made)
