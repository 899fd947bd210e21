"""Tests failing exports: Blender shows a clear report, no partial file is written, and the old file is kept."""

import os
from unittest import mock

import bpy
import fixtures
from soft_body_format.findings import Findings
from soft_body_format.to_document import Options, SceneWriter

NOBODY = 65534


def findings_of(**options):
    found = Findings()
    SceneWriter(bpy.context, Options(textures="EMBED", **options), found).write()
    return found


class Target(fixtures.SceneTest):
    """Where a file can't be written. Each time an older one stands there, or nothing may come to be."""

    def test_a_missing_folder(self):
        fixtures.box("b")
        self.assertIn("does not exist: make it", self.refuse("missing/out.sbf", build=False))

    def test_a_folder_at_the_output_path(self):
        fixtures.box("b")
        os.mkdir(self.path("out.sbf"))
        self.assertIn("is a folder", self.refuse(build=False))

    def test_a_write_protected_file(self):
        fixtures.box("b")
        with open(self.path("out.sbf"), "w", encoding="utf-8") as file:
            file.write("old")
        os.chmod(self.path("out.sbf"), 0o444)
        self.assertIn("write-protected", self.refuse(build=False))
        with open(self.path("out.sbf"), encoding="utf-8") as file:
            self.assertEqual(file.read(), "old")

    def test_a_write_protected_folder(self):
        fixtures.box("b")
        os.chmod(self.folder, 0o555)
        self.addCleanup(os.chmod, self.folder, 0o755)
        if os.geteuid() == 0:  # whom no folder refuses
            os.seteuid(NOBODY)
            self.addCleanup(os.seteuid, 0)
        self.assertIn("may not be written to", self.refuse(build=False))

    def test_an_error_keeps_the_old_file(self):
        fixtures.box("b")
        self.export(build=False)
        with open(self.path("out.sbf"), "rb") as file:
            old = file.read()
        bpy.data.objects["b"].soft_body_format.pins.add().group = "gone"
        self.refuse(build=False)
        with open(self.path("out.sbf"), "rb") as file:
            self.assertEqual(file.read(), old)

    def test_failed_exports_leave_no_images(self):
        material, shader = fixtures.shaded("skin")
        fixtures.textured(material, shader, self.path("hide.png"))
        made = fixtures.box("b")
        made.data.materials.append(material)
        made.soft_body_format.pins.add().group = "gone"
        os.mkdir(self.path("out"))
        self.refuse("out/out.sbf", build=False)
        self.assertEqual(os.listdir(self.path("out")), [])


    def test_an_exception_of_the_add_on_is_reported_with_its_location(self):
        fixtures.box("b")
        with mock.patch.object(SceneWriter, "write", side_effect=KeyError("x")):
            self.assertRegex(self.refuse(build=False), r"fault of the add-on.*KeyError.*line \d+")


class Scene(fixtures.SceneTest):
    def test_no_mesh(self):
        self.assertIn("nothing to export", self.refuse())
        fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0)])
        self.assertIn("nothing to export", self.refuse())

    def test_a_mesh_without_faces(self):
        fixtures.mesh_object("points", [(0, 0, 0), (1, 0, 0)], [])
        self.assertIn("no visible mesh with faces", self.refuse())
        self.assertIn("has no faces", findings_of()[0].message)

    def test_a_mirrored_mesh_is_reported_and_written(self):
        fixtures.box("twin").scale = (-1, 1, 1)
        found = [one for one in findings_of() if "negative" in one.message]
        self.assertEqual([(one.severity, one.object_name) for one in found], [("WARNING", "twin")])
        self.export(build=False)

    def test_a_mirrored_armature_is_refused(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0)])
        fixtures.hang(fixtures.box("b"), rig, "hip")
        rig.scale = (1, -1, 1)
        self.assertIn("bones can't be mirrored", self.refuse(build=False))

    def test_no_scale_at_all(self):
        fixtures.box("flat").scale = (1, 0, 1)
        self.assertIn("scale is zero", self.refuse(build=False))

    def test_a_vertex_nowhere(self):
        fixtures.box("b").data.vertices[3].co.x = float("nan")
        self.assertIn("coordinates that are not finite", self.refuse(build=False))
        self.assertEqual([one.vertices for one in findings_of().errors], [[3]])

    def test_polygons_that_can_have_no_stiff_quads(self):
        made = fixtures.mesh_object("pentagon", [(0, 0, 0), (2, 0, 0), (3, 1, 0), (1, 2, 0), (-1, 1, 0), (0, -1, 0), (2, -1, 0)],
                                    [(0, 1, 2, 3, 4), (0, 5, 6, 1)])
        made.modifiers.new("s", "SOFT_BODY")
        made.soft_body.use_stiff_quads, made.soft_body.use_goal = True, False
        found = [one for one in findings_of() if "four corners" in one.message]
        self.assertEqual([(one.object_name, one.vertices) for one in found], [("pentagon", [0, 1, 2, 3, 4])])

    def test_a_bone_without_a_section(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0), ("neck", "hip", (0, 0, 1), (0, 0, 2), 0),
                                        ("head", "neck", (0, 0, 2), (0, 0, 3), 0)])
        fixtures.hang(fixtures.box("belly"), rig, "head")
        self.assertEqual([one for one in findings_of() if "no section" in one.message], [])  # the message about the body above it only
        fixtures.hang(fixtures.box("seat"), rig, "hip")
        found = [one for one in findings_of() if "no section" in one.message]
        self.assertEqual([(one.object_name, one.bone_name) for one in found], [("rig", "neck")])
        rig.data.bones["hip"].use_deform = rig.data.bones["neck"].use_deform = False
        self.assertEqual([one for one in findings_of() if "no section" in one.message], [])

    def test_a_missing_image(self):
        material, shader = fixtures.shaded("skin")
        image = fixtures.textured(material, shader, self.path("hide.png"))
        fixtures.box("b").data.materials.append(material)
        os.unlink(self.path("hide.png"))
        image.buffers_free()
        self.assertIn("hide", self.refuse(build=False))

    def test_a_deleted_collection(self):
        fixtures.box("b")
        self.assertIn("no collection", self.refuse(collection="gone"))


class Libraries(fixtures.SceneTest):
    def linked(self):
        """A scene whose belly is linked from another file."""
        fixtures.box("belly")
        bpy.ops.wm.save_as_mainfile(filepath=self.path("library.blend"))
        scene = fixtures.fresh_scene()
        with bpy.data.libraries.load(self.path("library.blend"), link=True) as (there, here):
            here.objects = there.objects
        scene.collection.objects.link(here.objects[0])
        return here.objects[0]

    def test_a_linked_object_is_exported(self):
        self.linked().data.vertices  # it is read only, and is read
        self.assertEqual([one.name for one in self.export(build=False).render_meshes], ["belly"])

    def test_names_of_library_and_scene_may_be_the_same(self):
        self.linked()
        fixtures.box("belly", (2, 2, 2))
        meshes = self.export(build=False).render_meshes
        self.assertEqual(sorted(round(max(one.mesh.positions), 3) for one in meshes), [0.5, 1.0])
        self.assertEqual(len(bpy.data.objects), 2)

    def test_a_missing_library(self):
        self.linked()
        bpy.ops.wm.save_as_mainfile(filepath=self.path("scene.blend"))
        os.unlink(self.path("library.blend"))
        try:
            bpy.ops.wm.open_mainfile(filepath=self.path("scene.blend"))
        except RuntimeError:
            pass  # Blender says itself that a library is gone, and opens the rest
        self.assertIn("library.blend, which is not there", self.refuse(build=False))
