"""Scene > Soft body format > Gait > Propose: legs, head and tail found by the rig's shape."""

import math

import bpy
from mathutils import Matrix, Vector

import characters
import fixtures
from soft_body_format.preview import handlers


def forget_gait(scene):
    """As the panel is in a new scene."""
    gait = scene.soft_body_format.gait
    gait.use, gait.armature = False, None
    gait.body = gait.hips = gait.chest = gait.head = ""
    gait.legs.clear()
    gait.tails.clear()
    return gait


def place(matrix):
    """Moves all of a character in the world."""
    for one in bpy.context.scene.objects:
        if one.parent is None:
            one.matrix_world = matrix @ one.matrix_world
    bpy.context.view_layer.update()


def stork():
    """A biped with a root, whose feet hang on that, to be moved by hand."""
    bones = [("root", None, (0, 0, 0), (0, 0.3, 0), 0), ("body", "root", (0, 0, 1), (0, 0, 1.4), 0)]
    for side, x in (("L", 0.2), ("R", -0.2)):
        bones += [(f"thigh.{side}", "body", (x, 0, 1), (x, -0.05, 0.55), 0), (f"shin.{side}", f"thigh.{side}", (x, -0.05, 0.55), (x, 0, 0.12), 0),
                  (f"foot.{side}", "root", (x, 0, 0.12), (x, -0.2, 0.05), 0)]
    rig = fixtures.armature("stork", bones)
    held = bones[1:]
    skin, of_bone = characters.limbs("skin", [(name, head, tail, 0.15 if name == "body" else 0.05) for name, _, head, tail, _ in held])
    fixtures.bind(skin, rig, {name: {vertex: 1.0 for vertex in vertices} for name, vertices in of_bone.items()})
    return rig


class ProposedGait(fixtures.SceneTest):
    def test_four_legs_a_head_and_a_tail(self):
        characters.quadruped()
        rig = bpy.data.objects["quadruped"]
        gait = forget_gait(self.scene)
        gait.followers.add().bone = "skull"
        self.assertEqual(bpy.ops.sbfmt.propose_gait(), {"FINISHED"})
        self.assertEqual((gait.use, gait.armature), (True, rig))
        self.assertEqual((gait.body, gait.hips, gait.chest, gait.head), ("pelvis", "pelvis", "back", "skull"))
        group = {leg.end: leg.group for leg in gait.legs}
        self.assertEqual(set(group), {"hind3.L", "hind3.R", "fore3.L", "fore3.R"})
        self.assertEqual(group["hind3.L"], group["fore3.R"])
        self.assertNotEqual(group["hind3.L"], group["hind3.R"])
        self.assertEqual([tail.root for tail in gait.tails], ["tail1"])
        self.assertEqual([follower.bone for follower in gait.followers], ["skull"])  # the artist's own stay
        written = self.export(build=False)
        self.assertEqual({leg.name for leg in written.gaits[0].legs}, set(group))
        self.assertGreater(written.gaits[0].step_height, 0.02)

    def test_a_second_proposal_replaces_entries_and_keeps_ik_constraints(self):
        characters.biped()
        rig, gait = bpy.data.objects["biped"], self.scene.soft_body_format.gait
        target = fixtures.link(bpy.data.objects.new("target", None))
        reach = rig.pose.bones["hand.L"].constraints.new("IK")
        reach.target, reach.chain_count = target, 2
        gait.legs.clear()
        self.assertEqual(bpy.ops.sbfmt.propose_gait(), {"FINISHED"})
        self.assertEqual({leg.end: leg.root for leg in gait.legs}, {"foot.L": "thigh.L", "foot.R": "thigh.R"})
        self.assertEqual(len(gait.followers), 2)
        self.assertEqual(len(self.export(build=False).gaits[0].legs), 2)

    def test_a_rig_without_legs_is_reported_and_unchanged(self):
        self.assertFalse(bpy.ops.sbfmt.propose_gait.poll())
        rig = fixtures.armature("post", [("post", None, (0, 0, 0), (0, 0, 1), 0)])
        fixtures.hang(fixtures.box("block", (0.2, 0.2, 1), (0, 0, 0.5)), rig, "post")
        with self.assertRaises(RuntimeError) as raised:
            bpy.ops.sbfmt.propose_gait()
        self.assertIn("no legs are found", str(raised.exception))
        self.assertFalse(self.scene.soft_body_format.gait.use)

    def test_any_facing_direction_and_ground_height(self):
        characters.quadruped()
        forget_gait(self.scene)
        bpy.ops.sbfmt.propose_gait()
        stood = self.export(build=False)
        self.assertEqual((self.scene.soft_body_format.ahead, self.scene.soft_body_format.ground), ("-Y", 0.0))
        for quarters, way in ((1, "X"), (2, "Y"), (3, "-X")):
            fixtures.fresh_scene()
            self.scene = bpy.context.scene
            characters.quadruped()
            place(Matrix.Translation((0, 0, -0.75)) @ Matrix.Rotation(math.radians(90) * quarters, 4, "Z"))
            gait = forget_gait(self.scene)
            self.assertEqual(bpy.ops.sbfmt.propose_gait(), {"FINISHED"})
            settings = self.scene.soft_body_format
            self.assertEqual(settings.ahead, way)
            self.assertAlmostEqual(settings.ground, -0.75, delta=0.02)
            self.assertEqual({leg.end for leg in gait.legs}, {leg.name for leg in stood.gaits[0].legs})
            turned = self.export(build=False)
            lift = turned.bones[0].head[1] - stood.bones[0].head[1]
            self.assertLess(abs(lift), 0.02)  # of feet a little off the ground before
            for one, other in zip(turned.bones, stood.bones):
                self.assert_near(one.head, (other.head[0], other.head[1] + lift, other.head[2]), 1e-5)
                self.assert_near([abs(part) for part in one.rotation], [abs(part) for part in other.rotation], 1e-5)
            for one, other in zip(turned.render_meshes, stood.render_meshes):
                self.assert_near(one.mesh.positions[::3], other.mesh.positions[::3], 1e-5)
                self.assert_near(one.normals, other.normals, 1e-4)
            for one, other in zip(turned.gaits[0].legs, stood.gaits[0].legs):
                self.assert_near((one.home[0], one.home[2]), (other.home[0], other.home[2]), 1e-5)
                self.assertAlmostEqual(one.sole, other.sole, delta=1e-5)
            self.assert_near(turned.environment.gravity, (0, -9.81, 0), 1e-5)

    def test_feet_animated_by_hand_are_attached_to_their_legs(self):
        rig = stork()
        self.assertEqual(bpy.ops.sbfmt.propose_gait(), {"FINISHED"})
        gait = self.scene.soft_body_format.gait
        self.assertEqual({leg.end: leg.root for leg in gait.legs}, {"foot.L": "thigh.L", "foot.R": "thigh.R"})
        self.assertEqual({bone.name: bone.soft_body_format.hangs_on for bone in rig.data.bones if bone.soft_body_format.hangs_on},
                         {"foot.L": "shin.L", "foot.R": "shin.R"})
        self.assertEqual(rig.data.bones["foot.L"].parent.name, "root")  # the rig itself stays
        written = self.export(build=False)
        names = {bone.id: bone.name for bone in written.bones}
        self.assertEqual({bone.name: names.get(bone.parent) for bone in written.bones if bone.name.startswith("foot")},
                         {"foot.L": "shin.L", "foot.R": "shin.R"})
        for leg in written.gaits[0].legs:  # as low as the skin is, not the bones
            self.assertAlmostEqual(leg.home[1] - leg.sole, min(written.render_meshes[0].mesh.positions[1::3]), delta=1e-6)
        rig.data.bones["shin.L"].soft_body_format.hangs_on = "foot.L"  # a circle
        rig.data.bones["foot.R"].soft_body_format.hangs_on = "gone"
        bpy.ops.sbfmt.check()
        reported = [one.bone_name for one in self.scene.soft_body_format.findings if "under Hangs on" in one.message]
        self.assertEqual(reported, ["shin.L", "foot.L", "foot.R"])

    def test_bones_are_enough(self):
        characters.biped()
        forget_gait(self.scene)
        bpy.data.objects.remove(bpy.data.objects["skin"])
        self.assertEqual(bpy.ops.sbfmt.propose_gait(), {"FINISHED"})
        self.assertEqual(len(self.scene.soft_body_format.gait.legs), 2)

    def test_missing_legs_change_nothing(self):
        rig = stork()
        place(Matrix.Rotation(math.radians(180), 4, "X"))
        settings = self.scene.soft_body_format
        settings.ahead, settings.ground = "X", 0.25
        with self.assertRaises(RuntimeError):
            bpy.ops.sbfmt.propose_gait()
        self.assertEqual((settings.ahead, settings.ground), ("X", 0.25))
        self.assertFalse(any(bone.soft_body_format.hangs_on for bone in rig.data.bones))

    def test_feet_off_the_ground_are_reported_and_repaired(self):
        characters.biped()
        place(Matrix.Translation((0, 0, 0.5)))
        bpy.ops.sbfmt.check()
        settings = self.scene.soft_body_format
        index, found = next((index, one) for index, one in enumerate(settings.findings) if one.code == "GAIT_GROUND")
        self.assertIn("above the ground", found.message)
        self.assertEqual(bpy.ops.sbfmt.repair(index=index), {"FINISHED"})
        self.assertFalse(any(one.code == "GAIT_GROUND" for one in settings.findings))
        written = self.export(build=False)
        self.assertAlmostEqual(min(leg.home[1] - leg.sole for leg in written.gaits[0].legs), 0, delta=1e-5)
        # What an import finds where a scene says so comes where its character was.
        head = bpy.data.objects["biped"].matrix_world @ bpy.data.objects["biped"].data.bones["head"].head_local
        bpy.ops.import_scene.soft_body_format(filepath=self.path("out.sbf"))
        made = next(one for one in bpy.context.scene.objects if one.type == "ARMATURE" and one.name != "biped")
        self.assert_near(made.matrix_world @ made.data.bones["head"].head_local, head, 1e-5)

    def test_it_walks_forward_in_the_preview(self):
        stork()
        place(Matrix.Translation((0.5, 0, -0.75)) @ Matrix.Rotation(math.radians(90), 4, "Z"))
        bpy.ops.sbfmt.propose_gait()
        self.addCleanup(handlers.stop)
        settings = self.scene.soft_body_format.preview
        settings.drive, settings.speed = "WALK", 0.5
        self.scene.frame_set(1)
        own = bpy.data.objects["skin"]
        rest = sum((own.matrix_world @ vertex.co for vertex in own.data.vertices), Vector()) / len(own.data.vertices)
        self.assertEqual(bpy.ops.sbfmt.preview_start(), {"FINISHED"})

        def middle():
            vertices = bpy.data.objects["skin (preview)"].data.vertices
            return sum((vertex.co for vertex in vertices), Vector()) / len(vertices)
        self.assert_near(middle(), rest, 0.1)  # the weight goes over the feet
        for frame in range(2, 42):
            self.scene.frame_set(frame)
        way = middle() - rest
        self.assertGreater(way.x, 0.5)
        self.assertLess(abs(way.y), 0.15)
        self.assertLess(abs(way.z), 0.15)
        foot = bpy.data.objects["stork (preview)"].pose.bones["foot.L"]
        shin = bpy.data.objects["stork (preview)"].pose.bones["shin.L"]
        self.assertLess((foot.head - shin.tail).length, 0.02)

    def test_linked_bones_cannot_be_attached_elsewhere(self):
        stork()
        bpy.ops.wm.save_as_mainfile(filepath=self.path("library.blend"))
        fixtures.fresh_scene()
        with bpy.data.libraries.load(self.path("library.blend"), link=True) as (there, here):
            here.objects = list(there.objects)
        for one in here.objects:
            fixtures.link(one)
        with self.assertRaises(RuntimeError) as raised:
            bpy.ops.sbfmt.propose_gait()
        self.assertIn("Make Local", str(raised.exception))
        self.assertFalse(bpy.context.scene.soft_body_format.gait.use)
