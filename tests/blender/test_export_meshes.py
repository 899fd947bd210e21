"""Compares exported meshes, materials and bones with the scene."""

import math
import os

import bpy
import fixtures
from characters import closed_volume
from soft_body_format.to_document.shader_nodes import Nodes


def points(numbers):
    return [tuple(numbers[i:i + 3]) for i in range(0, len(numbers), 3)]


class Meshes(fixtures.SceneTest):
    def test_positions_are_metres_y_up_in_vertex_order(self):
        self.scene.unit_settings.scale_length = 0.01
        made = fixtures.mesh_object("L", [(0, 0, 0), (100, 0, 0), (100, 200, 0), (0, 200, 300)], [(0, 1, 2, 3)])
        made.location = (0, 0, 50)
        mesh = self.export(build=False).render_meshes[0]
        self.assertEqual(mesh.name, "L")
        self.assert_near(mesh.mesh.positions, [0, .5, 0, 1, .5, 0, 1, .5, -2, 0, 3.5, -2])
        self.assertEqual(list(mesh.mesh.polygon_points), [0, 1, 2, 3])

    def test_quads_and_polygons_are_not_split(self):
        fixtures.mesh_object("pentagon", [(math.cos(i * 1.2566), math.sin(i * 1.2566), 0) for i in range(5)] + [(3, 0, 0)],
                             [(0, 1, 2, 3, 4), (0, 5, 1)])
        mesh = self.export(build=False).render_meshes[0].mesh
        self.assertEqual(list(mesh.polygon_sizes), [5, 3])

    def test_modifiers_are_evaluated_or_not(self):
        made = fixtures.box("b")
        made.modifiers.new("s", "SUBSURF").levels = 1
        self.assertEqual(len(self.export(build=False).render_meshes[0].mesh.polygon_sizes), 24)
        self.assertEqual(len(self.export(build=False, apply_modifiers=False).render_meshes[0].mesh.polygon_sizes), 6)

    def test_a_mirrored_object_is_turned_round(self):
        made = fixtures.box("b")
        made.scale = (-1, 1, 1)
        mesh = self.export(build=False).render_meshes[0].mesh
        self.assertGreater(closed_volume(mesh.positions, mesh.polygon_sizes, mesh.polygon_points), 0.99)

    def test_several_uv_layers(self):
        made = fixtures.box("b")
        for name in ("one", "two"):
            layer = made.data.uv_layers.new(name=name)
            for i, item in enumerate(layer.data):
                item.uv = (i / 24, 0.25 if name == "one" else 0.75)
        sets = self.export(build=False).render_meshes[0].uv_sets
        self.assertEqual([one.name for one in sets], ["one", "two"])
        self.assertEqual(len(sets[0].corners), 24)
        self.assert_near([sets[1].coordinates[2 * sets[1].corners[3] + k] for k in (0, 1)], (3 / 24, 0.75))

    def test_normals_as_shown(self):
        fixtures.box("flat")
        smooth = fixtures.ball("smooth")
        smooth.data.polygons.foreach_set("use_smooth", [True] * len(smooth.data.polygons))
        flat, round_ = self.export(build=False).render_meshes
        self.assertEqual((len(flat.normals), len(flat.normal_corners)), (18, 24))
        self.assertEqual((len(round_.normals), len(round_.normal_corners)), (len(round_.mesh.positions), 0))
        for position, normal in zip(points(round_.mesh.positions), points(round_.normals)):
            self.assertGreater(sum(a * b for a, b in zip(position, normal)) / 0.5, 0.98)

    def test_normals_of_an_artist(self):
        """Custom ones, also of a mirrored object, where they point the other way across the mirror."""
        made = fixtures.box("b")
        wanted = [(0.6, 0.0, 0.8)] * len(made.data.loops)
        if hasattr(made.data, "use_auto_smooth"):
            made.data.use_auto_smooth = True
        made.data.polygons.foreach_set("use_smooth", [True] * 6)
        made.data.normals_split_custom_set(wanted)
        for scale, x in ((1, 0.6), (-1, -0.6)):
            made.scale = (scale, 1, 1)
            mesh = self.export(build=False).render_meshes[0]
            for normal in points(mesh.normals):
                self.assert_near(normal, (x, 0.8, 0), 2e-3)

    def test_sharp_edges_part_normals(self):
        made = fixtures.box("b")
        made.data.polygons.foreach_set("use_smooth", [True] * 6)
        for edge in made.data.edges:
            edge.use_edge_sharp = True
        if hasattr(made.data, "use_auto_smooth"):
            made.data.use_auto_smooth, made.data.auto_smooth_angle = True, math.pi
        mesh = self.export(build=False).render_meshes[0]
        self.assertEqual((len(mesh.normals), len(mesh.normal_corners)), (18, 24))

    def test_shape_keys(self):
        made = fixtures.box("b")
        made.shape_key_add(name="Basis")
        key = made.shape_key_add(name="up")
        key.data[3].co.z += 0.5
        key.value = 1.0
        mesh = self.export(build=False).render_meshes[0]
        self.assertEqual([(one.name, list(one.points)) for one in mesh.shape_keys], [("up", [3])])
        self.assert_near(mesh.shape_keys[0].offsets, (0, 0.5, 0))
        self.assertAlmostEqual(max(mesh.mesh.positions), 0.5)

    def test_names_beyond_ascii_and_linked_duplicates(self):
        made = fixtures.box("Löwe 猫 <&>")
        twin = fixtures.link(bpy.data.objects.new("twin", made.data))
        twin.location = (3, 0, 0)
        asset = self.export(build=False)
        self.assertEqual([one.name for one in asset.render_meshes], ["Löwe 猫 <&>", "twin"])
        self.assertEqual(len({one.id for one in asset.render_meshes}), 2)


class Appearance(fixtures.SceneTest):
    def test_principled_values(self):
        material, shader = fixtures.shaded("skin")
        shader.inputs["Base Color"].default_value = (0.2, 0.4, 0.6, 1)
        shader.inputs["Metallic"].default_value = 0.3
        shader.inputs["Roughness"].default_value = 0.7
        made = fixtures.box("b")
        made.data.materials.append(material)
        made.data.materials.append(fixtures.shaded("other")[0])
        made.data.polygons[2].material_index = 1
        asset = self.export(build=False)
        self.assertEqual([one.name for one in asset.materials], ["skin", "other"])
        self.assert_near(asset.materials[0].base_color, (0.2, 0.4, 0.6, 1))
        self.assert_near((asset.materials[0].metallic, asset.materials[0].roughness), (0.3, 0.7))
        self.assertEqual(list(asset.render_meshes[0].polygon_materials), [0, 0, 1, 0, 0, 0])

    def test_images_are_copied_or_embedded(self):
        material, shader = fixtures.shaded("skin")
        fixtures.textured(material, shader, self.path("hide.png"))
        fixtures.box("b").data.materials.append(material)
        texture = self.export(build=False).textures[0]
        self.assertEqual((texture.path, texture.media_type), ("textures/hide.png", "image/png"))
        with open(self.path("hide.png"), "rb") as file:
            own = file.read()
        with open(self.path("textures/hide.png"), "rb") as file:
            self.assertEqual(file.read(), own)
        self.assertEqual(self.export(build=False, textures="EMBED").textures[0].bytes, own)

    def test_images_of_one_name_get_separate_files(self):
        material, shader = fixtures.shaded("skin")
        one = fixtures.textured(material, shader, self.path("hide.png"), color=(1, 0, 0, 1))
        other = fixtures.textured(material, shader, self.path("other.png"), "Roughness", (0, 1, 0, 1))
        one.name, other.name = "skin/hide.png", "skin hide"
        fixtures.box("b").data.materials.append(material)
        textures = self.export(build=False).textures
        self.assertEqual([one.path for one in textures], ["textures/skin_hide.png", "textures/skin_hide.2.png"])
        stored = [open(self.path(one.path), "rb").read() for one in textures]
        self.assertNotEqual(*stored)

    def test_a_painted_image_is_written_as_it_is_seen(self):
        material, shader = fixtures.shaded("skin")
        image = fixtures.textured(material, shader, self.path("hide.png"))
        image.pixels[:] = (0, 0, 1, 1) * 16
        fixtures.box("b").data.materials.append(material)
        self.export(build=False)
        again = bpy.data.images.load(self.path("textures/hide.png"))
        self.assert_near(again.pixels[:4], (0, 0, 1, 1), 0.01)
        self.assertEqual(image.filepath_raw, self.path("hide.png"))

    def test_every_image_of_a_principled_shader_and_its_factors(self):
        material, _ = fixtures.shaded("skin")
        nodes = Nodes(material)
        images = [bpy.data.images.new(name, 4, 4) for name in ("color", "rough", "bumps")]
        nodes.link(nodes.color_times(nodes.image(images[0]).outputs["Color"], (0.5, 0.25, 1.0)), nodes.input("Base Color"))
        nodes.link(nodes.by(nodes.image(images[0]).outputs["Alpha"], 0.3, "GREATER_THAN"), nodes.input("Alpha"))
        channels = nodes.new("ShaderNodeSeparateColor")
        nodes.link(nodes.image(images[1], False).outputs["Color"], channels.inputs[0])
        nodes.link(nodes.times(channels.outputs[1], 0.75), nodes.input("Roughness"))
        nodes.link(channels.outputs[2], nodes.input("Metallic"))
        bumps = nodes.new("ShaderNodeNormalMap")
        nodes.link(nodes.image(images[2], False).outputs["Color"], bumps.inputs["Color"])
        nodes.link(bumps.outputs["Normal"], nodes.input("Normal"))
        fixtures.box("b").data.materials.append(material)
        asset = self.export(build=False)
        found, names = asset.materials[0], {texture.id: texture.name for texture in asset.textures}
        self.assertEqual([names[one] for one in (found.base_color_texture, found.metallic_roughness_texture, found.normal_texture)],
                         ["color", "rough", "bumps"])
        self.assert_near(found.base_color, (0.5, 0.25, 1, 1))
        self.assert_near((found.roughness, found.metallic, found.alpha_cutoff), (0.75, 1, 0.3))
        self.assertEqual(found.alpha_mode, "mask")

    def test_opacity_and_emission(self):
        material, shader = fixtures.shaded("glass")
        shader.inputs["Alpha"].default_value = 0.25
        shader.inputs["Emission Color" if "Emission Color" in shader.inputs else "Emission"].default_value = (1, 0.5, 0, 1)
        shader.inputs["Emission Strength"].default_value = 2
        material.use_backface_culling = True
        fixtures.box("b").data.materials.append(material)
        found = self.export(build=False).materials[0]
        self.assertEqual((found.alpha_mode, found.double_sided), ("blend", False))
        self.assert_near((found.base_color[3], *found.emissive), (0.25, 2, 1, 0))


class Bones(fixtures.SceneTest):
    def test_rest_frames_in_any_pose(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 1), (0, 0, 1.5), 0), ("leg", "hip", (0.2, 0, 1), (0.2, -0.5, 0.5), 30)])
        rig.location = (0, 0, 1)
        rig.data.bones["leg"].use_inherit_rotation = False
        rig.pose.bones["leg"].rotation_mode = "XYZ"
        rig.pose.bones["leg"].rotation_euler = (1, 0, 0)
        fixtures.hang(fixtures.box("b"), rig, "hip")
        hip, leg = self.export(build=False).bones
        self.assertEqual((hip.name, leg.name, leg.parent), ("hip", "leg", hip.id))
        self.assert_near(hip.head, (0, 2, 0))
        self.assert_near(leg.head, (0.2, 2, 0))
        self.assertAlmostEqual(leg.length, math.sqrt(0.5), places=6)
        self.assert_near(turned((0, 1, 0), leg.rotation), (0, -math.sqrt(0.5), math.sqrt(0.5)))
        self.assertEqual((hip.inherit_rotation, leg.inherit_rotation), (True, False))

    def test_every_mode_of_inherited_scale(self):
        ways = {"FULL": True, "FIX_SHEAR": True, "ALIGNED": True, "AVERAGE": True, "NONE": False, "NONE_LEGACY": False}
        rig = fixtures.armature("rig", [(way, None, (0, 0, 0), (0, 0, 1), 0) for way in ways])
        for way in ways:
            rig.data.bones[way].inherit_scale = way
        fixtures.hang(fixtures.box("b"), rig, "FULL")
        self.assertEqual({bone.name: bone.inherit_scale for bone in self.export(build=False).bones}, ways)

    def test_weights_of_any_count_sum_to_one(self):
        rig = fixtures.armature("rig", [(f"b{i}", None, (i, 0, 0), (i, 0, 1), 0) for i in range(6)])
        made = fixtures.box("b")
        fixtures.bind(made, rig, {f"b{i}": {0: 0.5, 1: 0.1 * i} for i in range(6)})
        skin = self.export(build=False).render_meshes[0].skin
        self.assertEqual(list(skin.influence_counts)[:3], [6, 5, 0])
        self.assertAlmostEqual(sum(list(skin.weights)[:6]), 1, places=6)
        self.assertEqual(list(skin.bones)[6:11], [1, 2, 3, 4, 5])

    def test_a_mesh_on_a_bone_is_a_section(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0)])
        fixtures.hang(fixtures.box("belly", center=(0, 0, 2)), rig, "hip")
        asset = self.export(build=False)
        self.assertEqual((asset.soft_bodies[0].name, asset.soft_bodies[0].bone), ("belly", asset.bones[0].id))
        self.assert_near((min(asset.soft_bodies[0].surface.positions[1::3]), ), (1.5, ))

    def test_two_armatures(self):
        one = fixtures.armature("one", [("root", None, (0, 0, 0), (0, 0, 1), 0)])
        two = fixtures.armature("two", [("root", None, (3, 0, 0), (3, 0, 1), 0)])
        fixtures.hang(fixtures.box("a"), one, "root")
        fixtures.hang(fixtures.box("b"), two, "root")
        asset = self.export(build=False)
        self.assertEqual([body.bone for body in asset.soft_bodies], [asset.bones[0].id, asset.bones[1].id])
        self.assertEqual(len({bone.id for bone in asset.bones}), 2)


class Chosen(fixtures.SceneTest):
    def names(self, **options):
        return sorted(one.name for one in self.export(build=False, **options).render_meshes)

    def collection(self, name, parent, *objects):
        made = bpy.data.collections.new(name)
        parent.children.link(made)
        for one in objects:
            self.scene.collection.objects.unlink(one)
            made.objects.link(one)
        return made

    def test_collections(self):
        body = self.collection("body", self.scene.collection, fixtures.box("chest"))
        self.collection("arms", body, fixtures.box("arm"))
        clothes = self.collection("clothes", self.scene.collection, fixtures.box("coat"))
        fixtures.box("ground").select_set(True)
        self.assertEqual(self.names(), ["arm", "chest", "coat", "ground"])
        self.assertEqual(self.names(collection="body"), ["arm", "chest"])
        self.assertEqual(self.names(selected_only=True), ["ground"])
        clothes.hide_render = True
        self.assertEqual(self.names(), ["arm", "chest", "ground"])
        bpy.context.view_layer.layer_collection.children["body"].exclude = True
        self.assertEqual(self.names(), ["ground"])

    def herd(self):
        """A rigged part in a collection that two empties show, one of them turned and larger."""
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0)])
        part = fixtures.box("part", center=(0, 0, 0.5))
        fixtures.hang(part, rig, "hip")
        herd = self.collection("herd", self.scene.collection, rig, part)
        herd.instance_offset = (0, 0, 0.25)
        for name, position, scale in (("one", (5, 0, 0), 1), ("two", (-5, 0, 0), 2)):
            empty = fixtures.link(bpy.data.objects.new(name, None))
            empty.instance_type, empty.instance_collection, empty.location, empty.scale = "COLLECTION", herd, position, (scale, ) * 3
        bpy.context.view_layer.layer_collection.children["herd"].exclude = True
        return herd

    def test_collection_instances_are_whole_characters(self):
        self.herd()
        asset = self.export(build=False)
        self.assertEqual([mesh.name for mesh in asset.render_meshes], ["one/part", "two/part"])
        self.assertEqual([body.bone for body in asset.soft_bodies], [bone.id for bone in asset.bones])
        self.assert_near(asset.bones[1].head, (-5, -0.5, 0))
        self.assertAlmostEqual(asset.bones[1].length, 2, places=6)
        self.assert_near((min(asset.render_meshes[1].mesh.positions[1::3]), max(asset.render_meshes[1].mesh.positions[1::3])),
                         (-0.5, 1.5))
        self.assertEqual(sorted(one.name for one in bpy.data.objects), ["one", "part", "rig", "two"])
        self.assertEqual([one.name for one in bpy.data.collections], ["herd"])

    def test_instances_of_instances(self):
        self.herd()
        pair = self.collection("pair", self.scene.collection, bpy.data.objects["one"], bpy.data.objects["two"])
        bpy.context.view_layer.layer_collection.children["pair"].exclude = True
        empty = fixtures.link(bpy.data.objects.new("all", None))
        empty.instance_type, empty.instance_collection, empty.location = "COLLECTION", pair, (0, 10, 0)
        meshes = self.export(build=False).render_meshes
        self.assertEqual([mesh.name for mesh in meshes], ["all/one/part", "all/two/part"])
        self.assert_near([max(mesh.mesh.positions[2::3]) for mesh in meshes], (-9.5, -9))
        self.assertEqual(len(bpy.data.objects), 5)


def turned(vector, xyzw):
    from mathutils import Quaternion, Vector
    x, y, z, w = xyzw
    return Quaternion((w, x, y, z)) @ Vector(vector)
