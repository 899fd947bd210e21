"""Scene > Soft body format > Check > As I work: after the first check, updates the list when the scene has not changed for a moment."""

import time

import bpy
from bpy.app.handlers import persistent

from ..preview import handlers
from .check_scene import find, show

IDLE_S = 0.8
MAX_CHECK_S = 0.5  # slower scenes are checked by the button only


class Live:
    """State kept between two checks; `count` is the number of checks."""

    changed_at, checking, ignored_until, count = 0.0, False, 0.0, 0


@persistent
def on_change(scene, depsgraph):
    """Stores the time of the change. The check waits until the changes stop."""
    settings = scene.soft_body_format
    if Live.checking or time.monotonic() < Live.ignored_until or not settings.checks_live or not settings.is_checked or \
            settings.check_time > MAX_CHECK_S or handlers.running() is not None or not len(depsgraph.updates):
        return
    Live.changed_at = time.monotonic()
    if not bpy.app.timers.is_registered(check_when_idle):
        bpy.app.timers.register(check_when_idle, first_interval=IDLE_S)


def check_when_idle():
    """A timer's call: checks the scene, or returns how many seconds to wait."""
    left = Live.changed_at + IDLE_S - time.monotonic()
    if left > 0:
        return left
    context = bpy.context
    if context.mode not in ("OBJECT", "POSE", "EDIT_MESH", "EDIT_ARMATURE"):  # a stroke may be under way
        return IDLE_S
    Live.checking, Live.count = True, Live.count + 1
    try:
        show(context.scene, lambda: find(context))
        context.view_layer.update()  # changes that the check itself makes do not count
    finally:
        Live.checking, Live.ignored_until = False, time.monotonic() + 0.1
    return None


def register():
    bpy.app.handlers.depsgraph_update_post.append(on_change)


def unregister():
    if bpy.app.timers.is_registered(check_when_idle):
        bpy.app.timers.unregister(check_when_idle)
    if on_change in bpy.app.handlers.depsgraph_update_post:
        bpy.app.handlers.depsgraph_update_post.remove(on_change)
