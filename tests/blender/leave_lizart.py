"""The thesis's lizard from its FBX: Blender imports it, the panels' properties give it limits and a gait, and it is exported."""

import math
import os

import bpy
import fixtures

KEPT = os.environ["SBFMT_KEPT"]
FBX = os.path.join(KEPT, "lizart.fbx")
LEGS = {"Leg": "hind", "Arm": "fore"}


class Lizart(fixtures.SceneTest):
    def import_fbx(self):
        """By whichever importer this Blender has."""
        if "fbx_import" in dir(bpy.ops.wm):
            bpy.ops.wm.fbx_import(filepath=FBX)
        else:
            import addon_utils
            addon_utils.enable("io_scene_fbx")
            bpy.ops.import_scene.fbx(filepath=FBX, ignore_leaf_bones=False)
        return next(one for one in bpy.data.objects if one.type == "ARMATURE")

    def test_limits_and_gait_through_the_panels(self):
        rig = self.import_fbx()
        for name in ("Body",):  # the torso as one mesh hangs on no bone
            found = bpy.data.objects.get(name)
            if found is not None and found.parent_type != "BONE":
                found.soft_body_format.role = "IGNORE"
        parts = [one for one in bpy.data.objects if one.type == "MESH" and one.parent_type == "BONE"]
        self.assertGreater(len(parts), 15)
        for part in parts:
            part.soft_body_format.attributes.preset = "flesh"
        for limb in LEGS:
            for side in "LR":
                for number, (kind, cone) in {1: ("spherical", 0.9), 2: ("revolute", 0), 3: ("spherical", 0.8)}.items():
                    joint = rig.data.bones[f"{limb}.00{number}.{side}"].soft_body_format.joint
                    joint.kind, joint.use_cone, joint.cone = kind, kind == "spherical", cone
                    joint.use_twist, joint.twist_min, joint.twist_max = True, math.radians(-75), math.radians(75)
        gait = self.scene.soft_body_format.gait
        gait.use, gait.armature, gait.body, gait.hips, gait.chest, gait.head = True, rig, "Bone", "Body", "Body.002", "Head"
        for name, group in (("Leg.003.L", 0), ("Leg.003.R", 1), ("Arm.003.L", 1), ("Arm.003.R", 0)):
            leg = gait.legs.add()
            leg.end, leg.root, leg.group = name, name.replace("003", "001"), group
        tail = gait.tails.add()
        tail.root, tail.end = "Tail.001", "Tail.003"
        self.assertEqual(bpy.ops.export_scene.soft_body_format(filepath=os.path.join(KEPT, "lizart.sbfz")), {"FINISHED"})
        bpy.ops.sbfmt.check()
        self.assertEqual([one.message for one in self.scene.soft_body_format.findings if one.severity == "ERROR"], [])
