"""Scene > Soft body format > Gait: which bones are legs, head and tail, and how far they step, guessed from the rig."""

import bpy

from .. import sbfmt
from ..findings import Findings
from ..finishing import has_library
from ..from_document.import_settings import fill_walk
from ..to_document import Options
from ..whole import write_whole
from .own_faults import told


def without_gait(context, findings):
    """The scene's document as if nobody had said how it walks."""
    gait = context.scene.soft_body_format.gait
    used, gait.use = gait.use, False
    try:
        whole = write_whole(context, Options(textures="COPY"), findings)
    finally:
        gait.use = used
    for kind in ("gaits", "chains", "ik_chains"):
        getattr(whole.document, kind).clear()
    return whole


def armature_of(context, whole, body):
    """The armature that has the bone of this id, and its bones' names by their ids."""
    for one in context.scene.objects:
        if one.type == "ARMATURE":
            names = {whole.writer.skeleton.id(one, bone.name): bone.name for bone in one.data.bones}
            if body in names:
                return one, names
    return None, {}


class SBFMT_OT_propose_gait(bpy.types.Operator):
    """Find legs, head and tail by the rig's shape, and fill the panel with a walk for them, to be changed as you like"""

    bl_idname = "sbfmt.propose_gait"
    bl_label = "Propose"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not any(one.type == "ARMATURE" for one in context.scene.objects):
            cls.poll_message_set("There is no armature: a character walks on its bones")
            return False
        if not has_library():
            cls.poll_message_set("The compiled library is not found: fill in the legs by hand")
            return False
        return True

    @told
    def execute(self, context):
        findings, said = Findings(), []
        whole = without_gait(context, findings)
        if findings.errors:
            findings.show(self)
            return {"CANCELLED"}
        proposed = sbfmt.propose_gait(whole.document, said.append)
        if not proposed.gaits:
            self.report({"ERROR"}, "no legs are found: the character is taken to look along -Y, as seen in front view, with legs that come down "
                        "to the ground on its left and its right; turn it so, or fill in the legs by hand")
            return {"CANCELLED"}
        armature, names = armature_of(context, whole, proposed.gaits[0].body)
        if armature is None or any(chain.root not in names for chain in proposed.ik_chains):
            self.report({"ERROR"}, "the legs hang on different armatures: join them, or fill in the legs by hand")
            return {"CANCELLED"}
        fill_walk(context.scene, proposed, armature, names, whole.writer.space)
        legs = context.scene.soft_body_format.gait.legs
        self.report({"INFO"}, f"{len(legs)} legs: {', '.join(leg.end for leg in legs)}")
        return {"FINISHED"}


def register():
    bpy.utils.register_class(SBFMT_OT_propose_gait)


def unregister():
    bpy.utils.unregister_class(SBFMT_OT_propose_gait)
