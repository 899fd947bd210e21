"""Makes scenes by script, and exports and checks them for tests."""

import math
import os
import tempfile
import unittest

import bmesh
import bpy
from mathutils import Matrix


BUNDLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bundles")


def fresh_scene():
    """Nothing but an empty scene of the file."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    return bpy.context.scene


def link(made):
    bpy.context.scene.collection.objects.link(made)
    return made


def mesh_object(name, vertices, faces, edges=()):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, list(edges), faces)
    mesh.update()
    return link(bpy.data.objects.new(name, mesh))


def box(name, size=(1, 1, 1), center=(0, 0, 0)):
    made = bmesh.new()
    bmesh.ops.create_cube(made, size=1.0, matrix=Matrix.Translation(center) @ Matrix.Diagonal((*size, 1)))
    return finish(name, made)


def ball(name, radius=0.5, center=(0, 0, 0), segments=12, rings=8):
    made = bmesh.new()
    bmesh.ops.create_uvsphere(made, u_segments=segments, v_segments=rings, radius=radius, matrix=Matrix.Translation(center))
    return finish(name, made)


def sheet(name, cells=8, size=1.0):
    made = bmesh.new()
    bmesh.ops.create_grid(made, x_segments=cells, y_segments=cells, size=size / 2)
    return finish(name, made)


def finish(name, made):
    mesh = bpy.data.meshes.new(name)
    made.to_mesh(mesh)
    made.free()
    return link(bpy.data.objects.new(name, mesh))


def shaded(name):
    """A material and its principled shader."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    return material, next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")


def textured(material, shader, path, socket="Base Color", color=(1, 1, 1, 1)):
    """An image in a file, on a socket of the shader."""
    image = bpy.data.images.new(os.path.splitext(os.path.basename(path))[0], 4, 4)
    image.pixels[:] = color * 16
    image.filepath_raw, image.file_format = path, "PNG"
    image.save()
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.links.new(node.outputs["Color"], shader.inputs[socket])
    return image


def armature(name, bones):
    """`bones`: (name, parent or None, head, tail, roll in degrees)."""
    data = bpy.data.armatures.new(name)
    made = link(bpy.data.objects.new(name, data))
    bpy.context.view_layer.objects.active = made
    bpy.ops.object.mode_set(mode="EDIT")
    for bone_name, parent, head, tail, roll in bones:
        bone = data.edit_bones.new(bone_name)
        bone.head, bone.tail, bone.roll = head, tail, math.radians(roll)
        if parent:
            bone.parent = data.edit_bones[parent]
    bpy.ops.object.mode_set(mode="OBJECT")
    return made


def bind(mesh, rig, weights):
    """`weights`: {bone name: {vertex: weight}}; an armature modifier."""
    for name, of_vertex in weights.items():
        group = mesh.vertex_groups.new(name=name)
        for vertex, weight in of_vertex.items():
            group.add([vertex], weight, "REPLACE")
    mesh.parent = rig
    mesh.modifiers.new("Armature", "ARMATURE").object = rig


def hang(mesh, rig, bone):
    """Parents to a bone and keeps the place."""
    bpy.context.view_layer.update()
    world = mesh.matrix_world.copy()
    mesh.parent, mesh.parent_type, mesh.parent_bone = rig, "BONE", bone
    bpy.context.view_layer.update()
    mesh.matrix_world = world


class SceneTest(unittest.TestCase):
    def setUp(self):
        self.scene = fresh_scene()
        own = tempfile.TemporaryDirectory()
        self.addCleanup(own.cleanup)
        self.folder = own.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def export(self, name="out.sbf", **options):
        """Exports as the menu does; gives the document that was written."""
        from soft_body_format.sbfmt.document import from_xml
        done = bpy.ops.export_scene.soft_body_format(filepath=self.path(name), **options)
        self.assertEqual(done, {"FINISHED"})
        with open(self.path(name), "rb") as file:
            return from_xml(file.read())

    def refuse(self, name="out.sbf", **options):
        """What Blender says where an export must fail, and nothing may be written."""
        before = sorted(os.listdir(self.folder))
        with self.assertRaises(RuntimeError) as raised:
            bpy.ops.export_scene.soft_body_format(filepath=self.path(name), **options)
        self.assertEqual(sorted(os.listdir(self.folder)), before)
        return str(raised.exception)

    def assert_near(self, found, wanted, within=1e-6):
        found, wanted = list(found), list(wanted)
        self.assertEqual(len(found), len(wanted))
        for a, b in zip(found, wanted):
            self.assertAlmostEqual(a, b, delta=within)


class RoundTripTest(SceneTest):
    def import_(self, path):
        self.assertEqual(bpy.ops.import_scene.soft_body_format(filepath=path), {"FINISHED"})

    def comes_back_equal(self, path, ending=".sbf"):
        """Imports, and exports again: an equal asset."""
        from soft_body_format import sbfmt
        self.import_(path)
        again = self.path(f"again{ending}")
        self.assertEqual(bpy.ops.export_scene.soft_body_format(filepath=again, textures="EMBED"), {"FINISHED"})
        with sbfmt.load(path) as one, sbfmt.load(again) as other:
            self.assertIsNone(one.equals(other))
