"""Scene > Soft body format > Gait: guesses from the rig which bones are legs, head and tail, and how far they step."""

import bpy

from .. import sbfmt
from ..findings import Findings
from ..finishing import has_library
from ..from_document.import_settings import fill_walk
from ..space import DIRECTIONS
from ..to_document import NOTHING, Options
from ..to_document.gaits import GROUND_TOLERANCE
from ..whole import write_whole
from .exception_reports import report_exceptions


def without_gait(context, findings):
    """The scene's document without gait settings."""
    gait = context.scene.soft_body_format.gait
    used, gait.use = gait.use, False
    try:
        whole = write_whole(context, Options(textures="COPY"), findings)
    finally:
        gait.use = used
    findings[:] = [one for one in findings if one.code != NOTHING]  # bones are enough
    for kind in ("gaits", "chains", "ik_chains"):
        getattr(whole.document, kind).clear()
    return whole


def armature_of(context, whole, body):
    """The armature that has the bone of this id, and a dict from bone ids to bone names."""
    for one in context.scene.objects:
        if one.type == "ARMATURE":
            names = {whole.writer.skeleton.id(one, bone.name): bone.name for bone in one.data.bones}
            if body in names:
                return one, names
    return None, {}


def placement(scene):
    """The settings outside the gait panel that a proposal changes, to restore them on failure."""
    settings = scene.soft_body_format
    hangs = [(one.data, bone.name, bone.soft_body_format.hangs_on) for one in scene.objects if one.type == "ARMATURE" for bone in one.data.bones]
    return settings.ahead, settings.ground, hangs


def put_back(scene, before):
    settings = scene.soft_body_format
    settings.ahead, settings.ground, hangs = before
    for data, name, hangs_on in hangs:
        data.bones[name].soft_body_format.hangs_on = hangs_on


def placed(context, findings):
    """The scene's document, and notes of what was changed. Sets bone parents, forward direction and ground as a gait needs them."""
    settings, notes = context.scene.soft_body_format, []
    whole = without_gait(context, findings)
    if findings.errors:
        return whole, notes
    stance = sbfmt.stand(whole.document)
    if stance.hangs_on:
        bones = {identity: (armature, name) for (armature, name), identity in whole.writer.skeleton.ids.items()}
        for identity, other in stance.hangs_on.items():
            armature, name = bones[identity]
            if context.scene.objects[armature].data.library is not None:
                findings.error(f"{name} holds the skin where a leg ends, and its parent is the root; a linked armature's bone can't be moved to its leg: "
                               "make it local (Object > Relations > Make Local)", object_name=armature, bone_name=name)
                return whole, notes
            context.scene.objects[armature].data.bones[name].soft_body_format.hangs_on = bones[other][1]
        notes.append(f"{len(stance.hangs_on)} bones hang on their limbs in the file, as Bone > Soft body format says")
        whole = without_gait(context, Findings())
        stance = sbfmt.stand(whole.document)
    turned = stance.quarter_turns != 0
    off = abs(stance.ground) > GROUND_TOLERANCE * stance.height
    if turned:
        settings.ahead = DIRECTIONS[(DIRECTIONS.index(settings.ahead) + stance.quarter_turns) % len(DIRECTIONS)]
        notes.append(f"looks along {settings.ahead}")
    if off:
        settings.ground += stance.ground / whole.writer.space.unit_m
        notes.append(f"stands at {settings.ground:.4g}")
    return without_gait(context, Findings()) if turned or off else whole, notes


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
            cls.poll_message_set(f"The compiled library {sbfmt.library_fault()}. Or fill in the legs by hand")
            return False
        return True

    @report_exceptions
    def execute(self, context):
        findings, before = Findings(), placement(context.scene)
        whole, notes = placed(context, findings)
        proposed = None if findings.errors else sbfmt.propose_gait(whole.document)
        wrong = self.refusal(context, whole, proposed) if proposed is not None else ""
        if findings.errors or wrong:
            put_back(context.scene, before)
            if wrong:
                self.report({"ERROR"}, wrong)
            else:
                findings.show(self)
            return {"CANCELLED"}
        armature, names = armature_of(context, whole, proposed.gaits[0].body)
        fill_walk(context.scene, proposed, armature, names, whole.writer.space)
        legs = context.scene.soft_body_format.gait.legs
        self.report({"INFO"}, "; ".join([f"{len(legs)} legs: {', '.join(leg.end for leg in legs)}", *notes]))
        return {"FINISHED"}

    @staticmethod
    def refusal(context, whole, proposed):
        """The reason why the panel is not filled, or None."""
        if not proposed.gaits:
            return "no legs are found: they come down to the ground on the left and the right of a character, each by bones of its own; " \
                "turn it upright, or fill in the legs by hand"
        armature, names = armature_of(context, whole, proposed.gaits[0].body)
        if armature is None or any(chain.root not in names for chain in proposed.ik_chains):
            return "the legs hang on different armatures: join them, or fill in the legs by hand"
        return ""


def register():
    bpy.utils.register_class(SBFMT_OT_propose_gait)


def unregister():
    bpy.utils.unregister_class(SBFMT_OT_propose_gait)
