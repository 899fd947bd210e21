"""Tests repair buttons: they repair faults in the scene or in files as they are written."""

import bpy
import fixtures
from soft_body_format.repairs import repair_of


class Mends(fixtures.SceneTest):
    def check(self):
        bpy.ops.sbfmt.check()
        return {one.code for one in self.scene.soft_body_format.findings}

    def repair(self, code):
        """Presses the button of the first message with that code; gives the codes that are left."""
        settings = self.scene.soft_body_format
        self.assertIn(code, self.check())
        index = next(i for i, one in enumerate(settings.findings) if one.code == code)
        self.assertIsNotNone(repair_of(settings.findings[index], settings.repairs_files))
        self.assertEqual(bpy.ops.sbfmt.repair(index=index), {"FINISHED"})
        return {one.code for one in settings.findings}

    def test_faces_are_turned_outwards(self):
        made = fixtures.ball("blob")
        made.data.flip_normals()
        self.assertNotIn("SURFACE_INSIDE_OUT", self.repair("SURFACE_INSIDE_OUT"))
        centre = made.data.polygons[0]
        self.assertGreater(centre.normal.dot(centre.center), 0)

    def test_one_face_is_turned(self):
        made = fixtures.ball("blob")
        made.data.polygons[5].flip()
        self.assertNotIn("SURFACE_WINDING", self.repair("SURFACE_WINDING"))

    def test_loose_vertices_are_removed_and_groups_kept(self):
        made = fixtures.box("b")
        made.data.vertices.add(1)
        made.vertex_groups.new(name="g").add([3], 0.5, "REPLACE")
        codes = self.check()
        code = "POINT_UNUSED" if "POINT_UNUSED" in codes else "MESH_POINT_UNUSED"
        self.assertEqual(self.repair(code) & {"POINT_UNUSED", "MESH_POINT_UNUSED"}, set())
        self.assertEqual(len(made.data.vertices), 8)
        self.assertAlmostEqual(made.vertex_groups["g"].weight(3), 0.5)

    def test_a_mirrored_mesh_gets_its_scale_applied(self):
        made = fixtures.ball("blob")
        made.scale, made.location = (-1, 1, 2), (1, 2, 3)
        other = fixtures.link(bpy.data.objects.new("twin", made.data))
        other.location = (5, 0, 0)
        below = fixtures.box("below", center=(0, 0, 1))
        below.parent = made
        bpy.context.view_layer.update()
        before, wanted, position = self.export("a.sbf", build=False), [tuple(v.co) for v in other.data.vertices], below.matrix_world.copy()
        self.assertIn("MESH_MIRRORED", self.check())
        self.assertEqual(bpy.ops.sbfmt.repair(index=-1), {"FINISHED"})
        self.assertNotIn("MESH_MIRRORED", {one.code for one in self.scene.soft_body_format.findings})
        self.assertEqual(tuple(made.scale), (1, 1, 1))
        self.assertEqual([tuple(v.co) for v in other.data.vertices], wanted)
        self.assert_near(below.matrix_world.translation, position.translation, 1e-5)
        after = self.export("b.sbf", build=False)
        for name in ("body.blob", "body.below"):
            self.assert_near(after.find("soft_bodies", name).surface.positions, before.find("soft_bodies", name).surface.positions, 1e-5)

    def test_limits_are_exchanged(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0), ("leg", "hip", (0, 0, 1), (0, 0, 2), 0)])
        fixtures.hang(fixtures.ball("belly"), rig, "hip")
        joint = rig.data.bones["leg"].soft_body_format.joint
        joint.kind, joint.use_twist, joint.twist_min, joint.twist_max = "revolute", True, 0.5, -0.25
        self.assertNotIn("LIMIT_ORDER", self.repair("LIMIT_ORDER"))
        self.assertAlmostEqual(joint.twist_min, -0.25)
        self.assertAlmostEqual(joint.twist_max, 0.5)

    def test_faults_in_the_file_are_repaired_in_the_file(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 0), (0, 0, 1), 0)])
        made = fixtures.ball("belly")
        fixtures.hang(made, rig, "hip")
        made.vertex_groups.new(name="g").add([0, 1, 2], 1.0, "REPLACE")
        for _ in range(2):
            pin = made.soft_body_format.pins.add()
            pin.group, pin.armature, pin.bone = "g", rig, "hip"
        self.repair("PIN_REPEATED")
        self.assertTrue(self.scene.soft_body_format.repairs_files)
        reported = [one.message for one in self.scene.soft_body_format.findings if one.code == "PIN_REPEATED"]
        self.assertTrue(reported and all(one.startswith("repaired in the file") for one in reported), reported)
        self.assertEqual(sum(len(pins.points) for pins in self.export(build=False).soft_bodies[0].pins), 3)
        self.assertEqual(bpy.ops.sbfmt.build(), {"FINISHED"})

    def test_all_at_once(self):
        for name in ("one", "two"):
            fixtures.ball(name, center=(0, 0, 0) if name == "one" else (3, 0, 0)).data.flip_normals()
        self.assertIn("SURFACE_INSIDE_OUT", self.check())
        self.assertEqual(bpy.ops.sbfmt.repair(index=-1), {"FINISHED"})
        self.assertNotIn("SURFACE_INSIDE_OUT", {one.code for one in self.scene.soft_body_format.findings})

    def test_ambiguous_faults_are_not_repaired(self):
        fixtures.sheet("open")
        settings = self.scene.soft_body_format
        bpy.ops.sbfmt.check()
        for finding in settings.findings:
            self.assertIsNone(repair_of(finding, False), finding.code)
        self.assertEqual(bpy.ops.sbfmt.repair(index=-1), {"CANCELLED"})


class Copies(fixtures.SceneTest):
    def test_settings_are_copied_to_selected_objects(self):
        one, other, third = (fixtures.box(name) for name in ("one", "other", "third"))
        one.soft_body_format.attributes.preset = "rubber"
        one.soft_body_format.attributes.young_modulus = 5e5
        one.soft_body_format.pins.add().group = "g"
        one.soft_body_format.role, other.soft_body_format.body_identity = "SOFT", "mine"
        for source in (one, other):
            source.select_set(True)
        third.select_set(False)
        bpy.context.view_layer.objects.active = one
        self.assertEqual(bpy.ops.sbfmt.copy_object(parts={"MATERIAL", "PINS"}), {"FINISHED"})
        settings = other.soft_body_format
        self.assertEqual((settings.attributes.preset, settings.attributes.young_modulus), ("rubber", 5e5))
        self.assertEqual([pin.group for pin in settings.pins], ["g"])
        self.assertEqual((settings.role, settings.body_identity), ("AUTO", "mine"))
        self.assertEqual(third.soft_body_format.attributes.preset, "CUSTOM")
        other.select_set(False)
        self.assertFalse(bpy.ops.sbfmt.copy_object.poll())

    def test_a_joint_is_mirrored_to_the_other_side(self):
        rig = fixtures.armature("rig", [("hip", None, (0, 0, 2), (0, 0, 3), 0), ("leg.L", "hip", (1, 0, 2), (1, 0, 1), 0),
                                        ("leg.R", "hip", (-1, 0, 2), (-1, 0, 1), 0)])
        bpy.context.view_layer.objects.active = rig
        rig.data.bones.active = rig.data.bones["leg.L"]
        joint = rig.data.bones["leg.L"].soft_body_format.joint
        joint.kind, joint.use_twist, joint.twist_min, joint.twist_max = "spherical", True, -0.1, 0.4
        joint.use_swing_z, joint.swing_z_min, joint.swing_z_max = True, -0.2, 0.8
        with bpy.context.temp_override(bone=rig.data.bones["leg.L"], object=rig):
            self.assertEqual(bpy.ops.sbfmt.copy_bone(other_side=True), {"FINISHED"})
        other = rig.data.bones["leg.R"].soft_body_format.joint
        self.assertEqual(other.kind, "spherical")
        self.assert_near((other.twist_min, other.twist_max, other.swing_z_min, other.swing_z_max), (-0.4, 0.1, -0.2, 0.8))
        with bpy.context.temp_override(bone=rig.data.bones["hip"], object=rig):
            self.assertEqual(bpy.ops.sbfmt.copy_bone(other_side=True), {"CANCELLED"})

    def test_values_undo_and_animate(self):
        made = fixtures.box("b")
        bpy.ops.ed.undo_push(message="before")
        made.soft_body_format.attributes.density = 123
        bpy.ops.ed.undo_push(message="after")
        bpy.ops.ed.undo()
        attributes = bpy.data.objects["b"].soft_body_format.attributes
        self.assertEqual(attributes.density, 1000)
        for frame, value in ((1, 0.0), (11, 1.0)):
            attributes.pressure = value
            self.assertTrue(bpy.data.objects["b"].keyframe_insert("soft_body_format.attributes.pressure", frame=frame))
        bpy.context.scene.frame_set(6)
        self.assertAlmostEqual(attributes.pressure, 0.5, places=5)
