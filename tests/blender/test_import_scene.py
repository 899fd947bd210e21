"""Tests that an import makes complete Blender objects: an export without the stored document writes nearly the same file."""

import bpy
import fixtures
from soft_body_format import memory
from soft_body_format.findings import Findings
from soft_body_format.to_document import Options, SceneWriter
from soft_body_format.to_document.shader_nodes import Nodes


class Scene(fixtures.SceneTest):
    def again(self, first="one.sbf", **options):
        """Exports, imports into an empty scene, forgets the file, exports: both documents."""
        one = self.export(first, build=False, **options)
        fixtures.fresh_scene()
        self.assertEqual(bpy.ops.import_scene.soft_body_format(filepath=self.path(first)), {"FINISHED"})
        self.scene = bpy.context.scene
        for collection in bpy.data.collections:
            for name in (memory.READ, memory.UNCHANGED):
                if name in collection:
                    del collection[name]
        found = Findings()
        two = SceneWriter(bpy.context, Options(**options), found).write()
        self.assertEqual([str(one) for one in found.errors], [])
        return one, two

    def active(self, made, **settings):
        bpy.context.view_layer.objects.active = made
        bpy.ops.rigidbody.object_add()
        for name, value in settings.items():
            setattr(made.rigid_body, name, value)
        return made

    def test_materials_and_images(self):
        material, _ = fixtures.shaded("skin")
        nodes = Nodes(material)
        images = [fixtures.textured(*fixtures.shaded("other"), self.path(f"{name}.png"), color=color)
                  for name, color in (("hide", (1, 0, 0, 1)), ("rough", (0, 1, 0, 1)), ("bumps", (0, 0, 1, 1)))]
        nodes.link(nodes.color_times(nodes.image(images[0]).outputs["Color"], (0.5, 0.25, 1.0)), nodes.input("Base Color"))
        nodes.link(nodes.by(nodes.image(images[0]).outputs["Alpha"], 0.3, "GREATER_THAN"), nodes.input("Alpha"))
        channels = nodes.new("ShaderNodeSeparateColor")
        nodes.link(nodes.image(images[1], False).outputs["Color"], channels.inputs[0])
        nodes.link(nodes.times(channels.outputs[1], 0.75), nodes.input("Roughness"))
        nodes.link(nodes.times(channels.outputs[2], 0.5), nodes.input("Metallic"))
        bumps = nodes.new("ShaderNodeNormalMap")
        nodes.link(nodes.image(images[2], False).outputs["Color"], bumps.inputs["Color"])
        nodes.link(bumps.outputs["Normal"], nodes.input("Normal"))
        nodes.input("Emission Color", "Emission").default_value = (0.1, 0.2, 0.3, 1)
        nodes.input("Emission Strength").default_value = 1
        glass, shader = fixtures.shaded("glass")
        shader.inputs["Alpha"].default_value, shader.inputs["Roughness"].default_value = 0.25, 0.125
        glass.use_backface_culling = True
        made = fixtures.box("b")
        made.data.materials.append(material)
        made.data.materials.append(glass)
        made.data.polygons[2].material_index = 1
        made.data.uv_layers.new(name="map")
        for textures in ("COPY", "EMBED"):
            with self.subTest(textures):
                one, two = self.again(textures=textures)
                self.assertEqual(two.materials, one.materials)
                self.assertEqual(two.textures, one.textures)
                self.assertEqual(two.render_meshes[0].polygon_materials, one.render_meshes[0].polygon_materials)

    def test_rigid_bodies_and_every_kind_of_constraint(self):
        one = self.active(fixtures.box("a"), mass=3, friction=0.25, restitution=0.5)
        other = self.active(fixtures.ball("b", center=(2, 0, 0)), kinematic=True, collision_shape="SPHERE")
        for number, kind in enumerate(("FIXED", "POINT", "HINGE", "SLIDER", "PISTON", "GENERIC", "GENERIC_SPRING", "MOTOR")):
            made = fixtures.link(bpy.data.objects.new(f"joint {kind}", None))
            made.location, made.rotation_euler = (1, 0, number), (0.1 * number, 0.2, 0.3)
            bpy.context.view_layer.objects.active = made
            bpy.ops.rigidbody.constraint_add(type=kind)
            joint = made.rigid_body_constraint
            joint.object1, joint.object2, joint.disable_collisions = one, other if number else None, number % 2 == 0
            joint.use_breaking, joint.breaking_threshold = number == 1, 5
            for name in ("ang_z", "lin_x", "ang_x", "lin_y"):
                setattr(joint, f"use_limit_{name}", True)
                setattr(joint, f"limit_{name}_lower", -0.25)
                setattr(joint, f"limit_{name}_upper", 0.5)
            joint.use_spring_x, joint.spring_stiffness_x, joint.spring_damping_x = True, 30, 0.5
            joint.use_spring_ang_y, joint.spring_stiffness_ang_y = True, 20
            joint.use_motor_ang, joint.motor_ang_target_velocity, joint.motor_ang_max_impulse = True, 2, 0.5
        first, again = self.again()
        self.assertEqual({body.id for body in again.rigid_bodies}, {body.id for body in first.rigid_bodies})
        for body in first.rigid_bodies:
            found = again.find("rigid_bodies", body.id)
            self.assertEqual(found.name.split(".")[0], body.name)  # "b.001" if "b" is its visible object
            for name in ("motion", "mass", "friction", "restitution", "layer"):
                self.assertEqual(getattr(found, name), getattr(body, name), name)
            self.assert_near(sorted(found.hull.positions), sorted(body.hull.positions), 1e-6)
        self.assertEqual([joint.id for joint in again.joints], [joint.id for joint in first.joints])
        for joint, found in zip(first.joints, again.joints):
            self.assertEqual((found.kind, found.body_a, found.body_b, found.collide), (joint.kind, joint.body_a, joint.body_b, joint.collide))
            self.assert_near((found.frame_b.position, found.frame_b.rotation)[0], joint.frame_b.position, 1e-5)
            self.assertGreater(abs(sum(a * b for a, b in zip(found.frame_b.rotation, joint.frame_b.rotation))), 1 - 1e-6)
            self.assertEqual([one.target for one in found.limits], [one.target for one in joint.limits])
            self.assert_near([value for one in found.limits for value in (one.min, one.max)],
                             [value for one in joint.limits for value in (one.min, one.max)])
            self.assertEqual([one.target for one in found.drives], [one.target for one in joint.drives])
            self.assert_near([value for one in found.drives for value in (one.stiffness, one.damping, one.velocity, one.maximum)],
                             [value for one in joint.drives for value in (one.stiffness, one.damping, one.velocity, one.maximum)], 1e-3)
            self.assertAlmostEqual(found.break_force, joint.break_force, places=2)

    def test_chains_of_inverse_kinematics(self):
        rig = fixtures.armature("rig", [("upper", None, (0, 0, 1), (0, -.1, .5), 0), ("lower", "upper", (0, -.1, .5), (0, 0, 0), 0),
                                        ("hand", "lower", (0, 0, 0), (0, -.2, 0), 0)])
        fixtures.hang(fixtures.box("b"), rig, "upper")
        target, pole = (fixtures.link(bpy.data.objects.new(name, None)) for name in ("target", "pole"))
        pole.location = (0, -2, 0.5)
        made = rig.pose.bones["lower"].constraints.new("IK")
        made.target, made.pole_target, made.chain_count, made.iterations, made.use_rotation = target, pole, 2, 50, True
        rig.pose.bones["upper"].ik_stiffness_y = 0.5
        one, two = self.again()
        self.assertEqual(two.ik_chains, one.ik_chains)
        rig = next(found for found in bpy.data.objects if found.type == "ARMATURE")
        upper = rig.pose.bones["upper"]
        bpy.context.view_layer.update()
        self.assertLess(upper.matrix.to_quaternion().rotation_difference(upper.bone.matrix_local.to_quaternion()).angle, 0.02)

    def test_gravity_and_every_kind_of_force_field(self):
        fixtures.box("b")
        self.scene.gravity = (1, 0, -1.625)
        for number, kind in enumerate(("WIND", "FORCE", "VORTEX", "DRAG")):
            bpy.ops.object.effector_add(type=kind, location=(number, 2, 3), rotation=(0.5 * number, 0, 0))
            field = bpy.context.object.field
            field.strength, field.use_max_distance, field.distance_max = 2 + number, number % 2 == 0, 4
            field.falloff_power = 2
        one, two = self.again()
        self.assert_near(two.environment.gravity, one.environment.gravity)
        self.assertEqual([field.id for field in two.environment.fields], [field.id for field in one.environment.fields])
        for field, found in zip(one.environment.fields, two.environment.fields):
            self.assertEqual((found.kind, found.strength, found.radius, found.falloff),
                             (field.kind, field.strength, field.radius, field.falloff))
            self.assert_near((*found.position, *found.direction), (*field.position, *field.direction), 1e-5)

    def test_bones_meshes_normals_uvs_keys_and_weights(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0.1, 1), 35), ("head", "hip", (0, 0.1, 1), (0, 0, 2), -60)])
        rig.data.bones["head"].use_inherit_rotation, rig.data.bones["head"].inherit_scale = False, "NONE"
        made = fixtures.ball("body", 1.0, (0, 0, 1))
        made.data.polygons.foreach_set("use_smooth", [index % 2 == 0 for index in range(len(made.data.polygons))])
        for name in ("one", "two"):
            layer = made.data.uv_layers.new(name=name)
            for index, item in enumerate(layer.data):
                item.uv = (index / 500, 0.25 if name == "one" else index / 250)
        fixtures.bind(made, rig, {"hip": {i: 1 - i / 100 for i in range(80)}, "head": {i: i / 100 for i in range(len(made.data.vertices))}})
        made.shape_key_add(name="Basis")
        made.shape_key_add(name="up").data[3].co.z += 0.5
        one, two = self.again()
        self.assertEqual([(bone.id, bone.parent, bone.inherit_rotation, bone.inherit_scale) for bone in two.bones],
                         [(bone.id, bone.parent, bone.inherit_rotation, bone.inherit_scale) for bone in one.bones])
        for bone, found in zip(one.bones, two.bones):
            self.assert_near((*found.head, found.length, *found.rotation), (*bone.head, bone.length, *bone.rotation), 1e-5)
        mesh, found = one.render_meshes[0], two.render_meshes[0]
        self.assert_near(found.mesh.positions, mesh.mesh.positions, 1e-6)
        self.assertEqual((found.mesh.polygon_sizes, found.mesh.polygon_points), (mesh.mesh.polygon_sizes, mesh.mesh.polygon_points))
        self.assert_near(by_corner(found.normals, found.normal_corners, found.mesh, 3),
                         by_corner(mesh.normals, mesh.normal_corners, mesh.mesh, 3), 2e-3)
        self.assertEqual([one.name for one in found.uv_sets], ["one", "two"])
        for layer, again in zip(mesh.uv_sets, found.uv_sets):
            self.assertEqual(by_corner(again.coordinates, again.corners, found.mesh, 2), by_corner(layer.coordinates, layer.corners, mesh.mesh, 2))
        self.assertEqual((found.skin.influence_counts, found.skin.bones), (mesh.skin.influence_counts, mesh.skin.bones))
        self.assert_near(found.skin.weights, mesh.skin.weights)
        self.assertEqual([(key.name, list(key.points)) for key in found.shape_keys], [("up", [3])])
        self.assert_near(found.shape_keys[0].offsets, mesh.shape_keys[0].offsets, 1e-6)


def by_corner(values, corners, mesh, width):
    """One value for each corner, whether they are told by corners or by points."""
    numbers = list(corners) or list(mesh.polygon_points)
    return [values[width * number + axis] for number in numbers for axis in range(width)]
