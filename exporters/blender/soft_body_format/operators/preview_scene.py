"""Scene > Soft body format > Preview: start and stop."""

import bpy

from ..preview import animation, handlers
from ..preview.session import Session
from ..preview.stage import Stage, actors_of
from .build_scene import built_scene
from .working import WithLibrary


def previewed_scene(operator, context):
    """A generator like `build_in_steps` that returns (Session, Stage) at the scene's current frame."""
    clip = []

    def change(whole):
        if context.scene.soft_body_format.preview.follow_animation:
            clip.append(animation.add_clip(context, whole))

    handlers.stop()
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    built, whole = yield from built_scene(operator, context, change)
    session = Session(context, built, whole, context.scene.frame_current, clip[0] if clip else None)
    if context.scene.soft_body_format.preview.drive != "STAND" and session.body is None:
        operator.report({"WARNING"}, "it has no gait, so it stays where it is: tick Scene > Soft body format > Gait")
    elif context.scene.soft_body_format.preview.drive == "CURVE" and session.walker is None:
        operator.report({"WARNING"}, "there is no curve to walk along, so it stays where it is: choose one below Drive")
    return session, Stage(context.scene, actors_of(whole, built.document), [one.name for one in whole.writer.of_type("ARMATURE")],
                          built.document)


class SBFMT_OT_preview_start(WithLibrary, bpy.types.Operator):
    """Build the character and play it with the frames of the scene. Escape cancels"""

    bl_idname = "sbfmt.preview_start"
    bl_label = "Start"
    bl_options = {"REGISTER", "UNDO"}
    instead = "sbfmt run"

    def work(self, context):
        session, stage = yield from previewed_scene(self, context)
        handlers.start(context, session, stage)
        self.report({"INFO"}, f"frame {session.frame}; play the animation, or step through it")


class SBFMT_OT_preview_stop(bpy.types.Operator):
    """End the preview and show your own objects again"""

    bl_idname = "sbfmt.preview_stop"
    bl_label = "Stop"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, _context):
        return handlers.running() is not None

    def execute(self, _context):
        handlers.stop()
        return {"FINISHED"}


CLASSES = (SBFMT_OT_preview_start, SBFMT_OT_preview_stop)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
