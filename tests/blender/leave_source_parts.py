"""Exports every character without the compiled library, as source parts in plain XML, into the folder that the test keeps."""

import os

import bpy
import characters
import fixtures
from soft_body_format import finishing

KEPT = os.environ["SBFMT_KEPT"]


class SourceParts(fixtures.SceneTest):
    def test_every_character(self):
        self.assertFalse(finishing.has_library())
        for name, make in characters.ALL.items():
            with self.subTest(name):
                fixtures.fresh_scene()
                make()
                self.assertEqual(bpy.ops.export_scene.soft_body_format(filepath=os.path.join(KEPT, f"{name}.sbf")), {"FINISHED"})

    def test_the_message_names_the_command_that_finishes_it(self):
        fixtures.box("b")
        bpy.ops.sbfmt.check()
        reported = [one.message for one in bpy.context.scene.soft_body_format.findings]
        self.assertTrue(any("the compiled library is not there for " in one for one in reported))
        self.assertIn("sbfmt build", self.refuse("out.sbfz"))
        self.assertIn("-o FILE.glb", self.refuse("out.glb"))

    def test_exported_scenes_are_imported_equal(self):
        """Import too, in plain Python."""
        fixtures.ball("blob")
        one = self.export()
        fixtures.fresh_scene()
        self.assertEqual(bpy.ops.import_scene.soft_body_format(filepath=self.path("out.sbf")), {"FINISHED"})
        self.assertEqual(self.export("again.sbf"), one)
