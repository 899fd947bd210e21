"""Scene > Soft body format > Gait > Propose: legs, head and tail found by the rig's shape."""

import bpy

import characters
import fixtures


def forget_gait(scene):
    """As the panel is in a new scene."""
    gait = scene.soft_body_format.gait
    gait.use, gait.armature = False, None
    gait.body = gait.hips = gait.chest = gait.head = ""
    gait.legs.clear()
    gait.tails.clear()
    return gait


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

    def test_anew_over_what_was_filled_in_and_beside_ik_constraints(self):
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

    def test_what_has_no_legs_is_told_and_stays(self):
        self.assertFalse(bpy.ops.sbfmt.propose_gait.poll())
        rig = fixtures.armature("post", [("post", None, (0, 0, 0), (0, 0, 1), 0)])
        fixtures.hang(fixtures.box("block", (0.2, 0.2, 1), (0, 0, 0.5)), rig, "post")
        with self.assertRaises(RuntimeError) as raised:
            bpy.ops.sbfmt.propose_gait()
        self.assertIn("no legs are found", str(raised.exception))
        self.assertFalse(self.scene.soft_body_format.gait.use)
