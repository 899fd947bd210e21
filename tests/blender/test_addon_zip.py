"""Tests that the zip installs through Blender's preferences, uninstalls, and leaves nothing registered."""

import glob
import os
import subprocess
import zipfile

import addon_utils
import bpy
import fixtures

HERE = os.path.dirname(os.path.abspath(__file__))
ZIP = os.path.join(HERE, os.pardir, "soft_body_format.zip")


class Zip(fixtures.SceneTest):
    def test_turned_off_and_on_again(self):
        addon_utils.disable("soft_body_format", default_set=True)
        self.assertFalse(hasattr(bpy.types.Object, "soft_body_format"))
        self.assertFalse(hasattr(bpy.types, "EXPORT_SCENE_OT_soft_body_format"))
        self.assertIsNotNone(addon_utils.enable("soft_body_format", default_set=True))
        fixtures.box("b")
        self.export(build=False)

    def test_it_is_a_valid_extension(self):
        if bpy.app.version >= (4, 2, 0):  # since which Blender has an opinion
            printed = subprocess.run([bpy.app.binary_path, "--factory-startup", "--command", "extension", "validate", ZIP],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(printed.returncode, 0, printed.stdout + printed.stderr)
        with zipfile.ZipFile(ZIP) as archive:
            manifest = archive.read("soft_body_format/blender_manifest.toml").decode()
            has_library = any("/lib/" in name for name in archive.namelist())
        self.assertEqual("platforms = [" in manifest, has_library)

    def test_installs_through_the_preferences(self):
        """Over the running one with its library loaded: its files are replaced."""
        fixtures.box("before")
        self.export(build=False)
        addon_utils.disable("soft_body_format", default_set=True)
        if bpy.app.version >= (4, 2, 0):
            module = "bl_ext.user_default.soft_body_format"
            self.assertEqual(bpy.ops.extensions.package_install_files(filepath=ZIP, repo="user_default", enable_on_install=True),
                             {"FINISHED"})
        else:
            module = "soft_body_format"
            self.assertEqual(bpy.ops.preferences.addon_install(filepath=ZIP, overwrite=True), {"FINISHED"})
            bpy.ops.preferences.addon_enable(module=module)
        self.assertIn(module, bpy.context.preferences.addons)
        fixtures.box("b")
        self.assertEqual(bpy.ops.export_scene.soft_body_format(filepath=self.path("out.sbf"), build=False), {"FINISHED"})
        self.assertTrue(glob.glob(self.path("out.sbf")))
        bpy.ops.preferences.addon_disable(module=module)
        addon_utils.enable("soft_body_format", default_set=True)
