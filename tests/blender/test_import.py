"""Tests import followed by export: the model is equal, except for changes made in between."""

import glob
import math
import os

import bpy
import fixtures
from soft_body_format import sbfmt
from soft_body_format.operators.import_bundle import read_document
from soft_body_format.sbfmt.document import Record, to_xml


class RoundTrip(fixtures.RoundTripTest):
    def bundle(self, name):
        path = os.path.join(fixtures.BUNDLES, name)
        if not os.path.exists(path):
            self.skipTest(f"{name} is not there")
        return path

    def test_every_bundle_round_trips(self):
        paths = sorted(glob.glob(os.path.join(fixtures.BUNDLES, "*.sbf*")))
        self.assertGreater(len(paths), 10)
        for path in paths:
            with self.subTest(os.path.basename(path)):
                fixtures.fresh_scene()
                self.comes_back_equal(path)

    def test_a_saved_scene_exports_the_imported_parts(self):
        path = self.bundle("lizard.sbf")
        self.import_(path)
        bpy.ops.wm.save_as_mainfile(filepath=self.path("scene.blend"))
        bpy.ops.wm.open_mainfile(filepath=self.path("scene.blend"))
        self.export("again.sbf")
        with sbfmt.load(path) as one, sbfmt.load(self.path("again.sbf")) as other:
            self.assertIsNone(one.equals(other))

    def test_export_changes_only_edited_parts(self):
        path = self.bundle("lizard.sbf")
        before = read_document(path)
        self.import_(path)
        head = bpy.data.objects["Head"]
        head.data.vertices[5].co.z += 0.25
        head.soft_body_format.attributes.young_modulus = 12345
        bpy.data.objects["Chest"].name = "thorax"
        gait = self.scene.soft_body_format.gait
        gait.step_height = 0.0625
        after = self.export("again.sbf", build=False)
        moved = [i for i, (a, b) in enumerate(zip(before.find("soft_bodies", "body.Head").surface.positions,
                                                  after.find("soft_bodies", "body.Head").surface.positions)) if abs(a - b) > 1e-6]
        self.assertEqual(moved, [16])
        self.assertAlmostEqual(after.find("soft_bodies", "body.Head").attributes.young_modulus, 12345)
        self.assertEqual(after.find("soft_bodies", "body.Chest").name, "thorax")
        self.assertAlmostEqual(after.gaits[0].step_height, 0.0625)
        self.assertEqual(after.bones, before.bones)
        self.assertEqual(after.find("soft_bodies", "body.Pelvis"), before.find("soft_bodies", "body.Pelvis"))

    def test_removed_parts_are_absent(self):
        self.import_(self.bundle("lizard.sbf"))
        bpy.data.objects.remove(bpy.data.objects["Tail5"])
        after = self.export("again.sbf", build=False)
        self.assertIsNone(after.find("soft_bodies", "body.Tail5"))
        self.assertIsNotNone(after.find("soft_bodies", "body.Tail4"))

    def test_objects_are_there(self):
        self.import_(self.bundle("lizard.sbf"))
        rig = next(one for one in bpy.data.objects if one.type == "ARMATURE")
        self.assertEqual(bpy.data.objects["Head"].parent_bone, "head")
        self.assertAlmostEqual(rig.data.bones["head"].length, 0.229264, places=5)
        self.assertEqual(len(self.scene.soft_body_format.gait.legs), 4)
        self.assertEqual(rig.data.bones["spine"].soft_body_format.joint.kind, "spherical")

    def test_a_polygon_around_a_hole_comes_in_as_triangles(self):
        """It comes to two points twice, which no face of Blender's may do."""
        document, count = Record("asset"), 40
        mesh = document.add("render_meshes", id="mesh.washer", name="washer")
        shape = mesh.mesh
        turns = [2 * math.pi * one / count for one in range(count)]
        rims = [(radius * math.cos(turn), 0.0, radius * math.sin(turn)) for radius in (2, 1) for turn in turns]
        rim, hole = list(range(count)), list(range(count, 2 * count))
        shape.positions = [value for point in rims + [(5, 0, 0), (5, 0, 1), (6, 0, 0)] for value in point]
        shape.polygon_points = [*rim, 0, count, *reversed(hole), 2 * count, 2 * count + 1, 2 * count + 2]
        shape.polygon_sizes = [2 * count + 2, 3]
        mesh.normals, mesh.normal_corners = [0, -1, 0], [0] * (2 * count + 5)
        sheet = mesh.add("uv_sets", name="plan")
        sheet.coordinates = [value for x, _, z in rims + [(5, 0, 0), (5, 0, 1), (6, 0, 0)] for value in (x, z)]
        with open(self.path("washer.sbf"), "wb") as file:
            file.write(to_xml(document))
        self.comes_back_equal(self.path("washer.sbf"))
        made = bpy.data.objects["washer"].data
        self.assertEqual({len(face.vertices) for face in made.polygons}, {3})
        area = count / 2 * math.sin(2 * math.pi / count) * (4 - 1)
        self.assertAlmostEqual(sum(face.area for face in made.polygons), area + 0.5, places=4)
        for corner, position in zip(made.loops, made.uv_layers["plan"].data):
            at = made.vertices[corner.vertex_index].co
            self.assert_near(position.uv, (at.x, -at.y), 1e-5)

    def test_a_broken_file_raises_a_runtime_error(self):
        with open(self.path("bad.sbf"), "w", encoding="utf-8") as file:
            file.write("<sbf version='1.0'><bone/></sbf>")
        objects = len(bpy.data.objects)
        with self.assertRaisesRegex(RuntimeError, "bad.sbf"):
            bpy.ops.import_scene.soft_body_format(filepath=self.path("bad.sbf"))
        with self.assertRaisesRegex(RuntimeError, "can't be read|cannot"):
            bpy.ops.import_scene.soft_body_format(filepath=self.path("missing.sbf"))
        self.assertEqual(len(bpy.data.objects), objects)
