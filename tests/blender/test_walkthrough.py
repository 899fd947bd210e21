"""Follows docs/blender.md step by step and checks that the labels on the page are those on the screen. whole_way.py runs the page's
commands on the exported file."""

import os
import re
import shutil

import bpy
import fixtures
import numpy
from soft_body_format import settings
from soft_body_format.repairs import IN_SCENE
from soft_body_format.overlay import joints, structure
from soft_body_format.preview import baked, handlers
from soft_body_format.to_document.roles import shown_role

HERE = os.path.dirname(os.path.abspath(__file__))
PAGE = os.path.join(HERE, "page.md")
KEPT = os.environ["SBFMT_KEPT"]
BUNDLE = os.path.join(KEPT, "lizard.sbf")  # which the first step's command makes
# Names in the page's slanted type that are Blender's own, or of the lizard's parts.
OTHERS = {"Levels Viewport", "Render", "Location Z", "Head", "Chest", "head", "upper_arm.L", "Exported as: Soft"}


def steps(title):
    """The numbered steps below a heading."""
    with open(PAGE, encoding="utf-8") as file:
        part = file.read().split(f"## {title}\n", 1)[1].split("\n## ", 1)[0]
    return re.findall(r"(?ms)^(\d+)\. (.*?)(?=^\d+\. |^```|\Z)", part)


def labels():
    """What the add-on's panels and buttons say."""
    found = {"Soft body preview", "Soft body bake"}
    kinds = [getattr(bpy.types, name) for name in dir(bpy.types) if name.startswith(("SBFMT_PT_", "SBFMT_OT_"))]
    found |= {one.bl_label for one in kinds}
    for one in (*settings.CLASSES, *(kind for kind in kinds if issubclass(kind, bpy.types.Operator))):
        for field in one.bl_rna.properties:
            found.add(field.name)
            if field.type == "ENUM":
                found |= {item.name for item in field.enum_items}
    return found | {repair.label for repair in IN_SCENE.values()} | {"Drawn", "To the other side"}


def shown_points(name):
    mesh = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    found = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
    mesh.vertices.foreach_get("co", found)
    return found.reshape(-1, 3)


class Walkthrough(fixtures.SceneTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(handlers.stop)

    def test_documented_labels_match_the_screen(self):
        known = labels() | OTHERS
        for title, count in (("Step by step: a ball of jelly", 8), ("Step by step: a lizard takes a walk", 10)):
            found = steps(title)
            self.assertEqual([int(number) for number, _ in found], list(range(1, count + 1)))
            for number, text in found:
                for word in re.findall(r"(?<![!\w])\*([^*\n]+)\*", text):
                    self.assertIn(word, known, f"{title}, step {number}")

    def test_a_ball_of_jelly(self):
        bpy.ops.wm.read_homefile(use_factory_startup=True)  # 1
        scene, cube = bpy.context.scene, bpy.data.objects["Cube"]
        modifier = cube.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = modifier.render_levels = 3
        matter = cube.soft_body_format.attributes  # 2
        self.assertEqual(shown_role(cube).capitalize(), "Soft")
        matter.preset = "jelly"
        cube.location.z = 2  # 3
        bpy.context.view_layer.update()
        bpy.ops.sbfmt.check()  # 4
        self.assertEqual([one.message for one in scene.soft_body_format.findings], [])
        bpy.ops.sbfmt.build()  # 5
        self.assertRegex(structure.summary(scene), r"\d+ lattice")
        scene.frame_set(1)  # 6
        bpy.ops.sbfmt.preview_start()
        for frame in range(2, 40):
            scene.frame_set(frame)
        low = float(shown_points("Cube (preview)")[:, 2].min())
        self.assertTrue(-0.02 < low < 0.2, low)
        preview = scene.soft_body_format.preview  # 7
        preview.bake_to, preview.bake_start, preview.bake_end = "SHAPE_KEYS", 1, 60
        self.assertEqual(bpy.ops.sbfmt.bake(), {"FINISHED"})
        keys = bpy.data.objects["Cube (baked)"].data.shape_keys.key_blocks
        self.assertEqual(len(keys) - 1, 60)
        bpy.ops.sbfmt.bake_cut(start=10, end=60)
        self.assertEqual(len(keys) - 1, 51)
        bpy.ops.sbfmt.bake_free()
        self.assertEqual(bpy.ops.export_scene.soft_body_format(filepath=self.path("jelly.sbfz")), {"FINISHED"})  # 8
        shutil.copy(self.path("jelly.sbfz"), KEPT)

    def test_the_example_lizard_walks(self):
        if not os.path.exists(BUNDLE):
            self.skipTest("the program has made no bundle of the lizard")
        bpy.ops.import_scene.soft_body_format(filepath=BUNDLE)  # 2
        scene = bpy.context.scene
        rig = next(one for one in bpy.data.objects if one.type == "ARMATURE")
        self.assertEqual(len([one for one in bpy.data.objects if one.type == "MESH"]), 22)
        head, chest = bpy.data.objects["Head"], bpy.data.objects["Chest"]  # 3
        bpy.ops.object.select_all(action="DESELECT")
        for one in (head, chest):
            one.select_set(True)
        bpy.context.view_layer.objects.active = chest
        chest.soft_body_format.attributes.preset = "rubber"
        bpy.ops.sbfmt.copy_object()
        self.assertEqual(head.soft_body_format.attributes.young_modulus, chest.soft_body_format.attributes.young_modulus)
        bpy.context.view_layer.objects.active = rig  # 4
        bpy.ops.object.mode_set(mode="POSE")
        scene.soft_body_format.show_joints = "ALL"
        self.assertNotIn(joints.BROKEN, joints.collect(bpy.context))
        pose = rig.pose.bones["head"]
        pose.rotation_mode, pose.rotation_euler = "XYZ", (0.2, 1.3, 0.2)
        bpy.context.view_layer.update()
        self.assertIn(joints.BROKEN, joints.collect(bpy.context))
        rig.data.bones["head"].soft_body_format.joint.swing_z_max = 1.047
        pose.rotation_euler = (0, 0, 0)
        with bpy.context.temp_override(bone=rig.data.bones["upper_arm.L"], object=rig):
            self.assertEqual(bpy.ops.sbfmt.copy_bone(other_side=True), {"FINISHED"})
        bpy.ops.object.mode_set(mode="OBJECT")
        scene.soft_body_format.gait.step_height = 0.04  # 5
        scene.soft_body_format.build.levels = 2  # 6
        self.assertEqual(bpy.ops.sbfmt.build(), {"FINISHED"})
        head.data.polygons[3].flip()  # 7
        head.data.update()
        bpy.ops.sbfmt.check()
        findings = scene.soft_body_format.findings
        index = next(i for i, one in enumerate(findings) if one.code == "SURFACE_WINDING")
        self.assertEqual(bpy.ops.sbfmt.repair(index=index), {"FINISHED"})
        self.assertNotIn("SURFACE_WINDING", [one.code for one in findings])
        bpy.ops.curve.primitive_bezier_curve_add(location=(1, 0, 0))  # 8
        preview = scene.soft_body_format.preview
        preview.drive, preview.curve, preview.speed = "CURVE", bpy.context.object, 0.4
        scene.frame_set(1)
        bpy.ops.sbfmt.preview_start()
        for frame in range(2, 73):
            scene.frame_set(frame)
        self.assertGreater(handlers.running().character.distance, 0.6)
        bpy.ops.sbfmt.preview_stop()
        preview.bake_to, preview.bake_folder, preview.bake_end = "PC2", self.path("cache"), 60  # 9
        self.assertEqual(bpy.ops.sbfmt.bake(), {"FINISHED"})
        self.assertEqual(len(os.listdir(self.path("cache"))), 22)
        self.assertEqual(len(baked.modifiers()), 22)
        bpy.ops.sbfmt.bake_free()
        asset = self.export("walker.sbf")  # 10
        self.assertAlmostEqual(asset.gaits[0].step_height, 0.04, places=6)
        self.assertEqual(len(asset.find("soft_bodies", "body.Head").levels), 2)
        shutil.copy(self.path("walker.sbf"), KEPT)
