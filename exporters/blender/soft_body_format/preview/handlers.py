"""Holds the running preview, and reacts when Blender changes frames, undoes, loads, saves or renders."""

import bpy
from bpy.app.handlers import persistent

from ..building import LastBuild
from . import stage as stages


class Running:
    """The session and the stage of the running preview, or None."""

    session = stage = None
    rendering = baking = False


def running():
    """The session, or None."""
    return Running.session


def start(context, session, stage):
    """Starts a preview; ends one that is running."""
    stop()
    stage.set(context)
    Running.session, Running.stage = session, stage
    show()


def stop():
    """Frees the runtime and restores the scene. Returns whether there was anything to restore."""
    session, Running.session, Running.stage = Running.session, None, None
    if session is not None:
        session.close()
    return stages.strike()


def show():
    """Updates the copies from the session."""
    session, stage = Running.session, Running.stage
    for actor in stage.actors:
        if actor.copy:
            stage.show_points(actor, session.points(actor))
    for name in stage.armatures:
        stage.show_bones(name, session.bone_frames(name))


@persistent
def on_frame(scene, _depsgraph=None):
    session = Running.session
    if session is None or Running.rendering or Running.baking or scene.name != session.scene_name:
        return
    if not Running.stage.is_complete():
        stop()
        return
    session.go_to(scene, scene.frame_current)
    show()


@persistent
def on_history(*_):
    """Undo and redo restore an earlier scene, with copies or without."""
    if Running.session is None:
        stages.strike()
    elif Running.stage.is_complete():
        show()
    else:
        stop()


@persistent
def on_load_pre(*_):
    """Ends the preview and drops the last build, because another file replaces the scene."""
    if Running.session is not None:
        Running.session.close()
    Running.session = Running.stage = None
    LastBuild.forget()


@persistent
def on_load_post(*_):
    stages.strike()


@persistent
def on_save_pre(*_):
    """Removes the copies before a save."""
    if Running.session is not None:
        stages.strike()


@persistent
def on_save_post(*_):
    if Running.session is not None and bpy.context.scene.name == Running.session.scene_name:
        Running.stage.set(bpy.context)
        show()
    elif Running.session is not None:
        stop()


@persistent
def on_render_begin(*_):
    Running.rendering = True


@persistent
def on_render_end(*_):
    Running.rendering = False


HANDLERS = (("frame_change_post", on_frame), ("undo_post", on_history), ("redo_post", on_history), ("load_pre", on_load_pre),
            ("load_post", on_load_post), ("save_pre", on_save_pre), ("save_post", on_save_post), ("render_init", on_render_begin),
            ("render_complete", on_render_end), ("render_cancel", on_render_end))


def register():
    for name, function in HANDLERS:
        getattr(bpy.app.handlers, name).append(function)


def unregister():
    for name, function in reversed(HANDLERS):
        if function in getattr(bpy.app.handlers, name):
            getattr(bpy.app.handlers, name).remove(function)
    stop()
    LastBuild.forget()
