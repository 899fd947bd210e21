"""Tests the list of the check and its selection, and the build and its overlay."""

import bpy
import fixtures
from soft_body_format.operators import live_check
from soft_body_format.overlay import structure


class Check(fixtures.SceneTest):
    def messages(self):
        bpy.ops.sbfmt.check()
        return list(self.scene.soft_body_format.findings)

    def test_a_sound_scene(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0)])
        fixtures.hang(fixtures.ball("belly"), rig, "hip")
        self.assertEqual([one.message for one in self.messages() if one.severity == "ERROR"], [])

    def test_a_message_selects_its_object(self):
        loose = fixtures.mesh_object("flipped", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1),
                                                 (0, 1, 1)],
                                     [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)])
        index = next(i for i, one in enumerate(self.messages()) if one.object_name == loose.name)
        self.assertEqual(bpy.ops.sbfmt.select_finding(index=index), {"FINISHED"})
        self.assertEqual(bpy.context.view_layer.objects.active, loose)

    def test_a_bone_is_made_active(self):
        one = fixtures.armature("one", [("root", None, (0, 0, 0), (0, 0, 1), 0)])
        two = fixtures.armature("two", [("root", None, (3, 0, 0), (3, 0, 1), 0)])
        fixtures.hang(fixtures.box("a"), one, "root")
        fixtures.hang(fixtures.box("b", center=(3, 0, 0.5)), two, "root")
        index = next(i for i, found in enumerate(self.messages()) if found.bone_name == "root")
        bpy.ops.sbfmt.select_finding(index=index)
        self.assertEqual(bpy.context.view_layer.objects.active.data.bones.active.name, "root")

    def test_an_empty_scene_is_reported(self):
        self.assertIn("nothing to export", self.messages()[0].message)


class Live(fixtures.SceneTest):
    def setUp(self):
        super().setUp()
        self.box = fixtures.box("b")

    def change(self, act):
        """What Blender's main loop does after a change: tells of it, and calls the timer when its time has come."""
        act()
        bpy.context.view_layer.update()
        waits = bpy.app.timers.is_registered(live_check.check_when_idle)
        if waits:
            self.assertGreater(live_check.check_when_idle(), 0)  # not while things change
            live_check.Live.changed_at -= live_check.IDLE_S
            self.assertIsNone(live_check.check_when_idle())
            bpy.app.timers.unregister(live_check.check_when_idle)
        live_check.Live.ignored_until = 0
        return waits, [one.code for one in self.scene.soft_body_format.findings]

    def flip(self):
        self.box.data.polygons[2].flip()
        self.box.data.update()

    def test_the_list_follows_the_scene(self):
        self.assertEqual(self.change(self.flip), (False, []))  # nobody has asked yet
        self.flip()
        bpy.ops.sbfmt.check()
        self.assertTrue(self.change(self.flip)[1].count("SURFACE_WINDING"))
        self.assertFalse(self.change(self.flip)[1].count("SURFACE_WINDING"))
        self.assertFalse(self.change(lambda: None)[0])  # a check is no change

    def test_it_can_be_disabled_and_skips_large_scenes(self):
        bpy.ops.sbfmt.check()
        settings = self.scene.soft_body_format
        settings.checks_live = False
        self.assertFalse(self.change(self.flip)[0])
        settings.checks_live, settings.check_time = True, 2 * live_check.MAX_CHECK_S
        self.assertFalse(self.change(self.flip)[0])


class Build(fixtures.SceneTest):
    def test_springs_of_a_section(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0)])
        fixtures.hang(fixtures.ball("belly"), rig, "hip")
        self.assertEqual(bpy.ops.sbfmt.build(), {"FINISHED"})
        self.assertRegex(structure.summary(self.scene), r"built: \d+ structural")

    def test_tetrahedra_of_a_blob_are_at_the_model(self):
        self.scene.unit_settings.scale_length = 0.1
        fixtures.ball("blob", 2.0, (5, 0, 0))
        bpy.ops.sbfmt.build()
        places = structure._shown[self.scene.name].positions("lattice")
        self.assertAlmostEqual(float(places[:, 0].mean()), 5, delta=0.1)
        self.assertAlmostEqual(float(places[:, 2].max()), 2, delta=0.3)
