"""Scene > Soft body format > Check > As I work: after the first check the list follows the scene, whenever it is left alone for a moment."""

import time

import bpy
from bpy.app.handlers import persistent

from ..preview import handlers
from .check_scene import find, show

QUIET_S = 0.8
MOST_S = 0.5  # of a check that is made unasked: a scene that takes longer is checked by the button alone


class Live:
    """What is known between two looks, and how many there were."""

    changed_at, checking, deaf_until, count = 0.0, False, 0.0, 0


@persistent
def on_change(scene, depsgraph):
    """Notes when it was; the check waits until nothing happens any more."""
    settings = scene.soft_body_format
    if Live.checking or time.monotonic() < Live.deaf_until or not settings.checks_live or not settings.is_checked or \
            settings.check_time > MOST_S or handlers.running() is not None or not len(depsgraph.updates):
        return
    Live.changed_at = time.monotonic()
    if not bpy.app.timers.is_registered(look):
        bpy.app.timers.register(look, first_interval=QUIET_S)


def look():
    """A timer's call: checks, or says how much longer to wait."""
    left = Live.changed_at + QUIET_S - time.monotonic()
    if left > 0:
        return left
    context = bpy.context
    if context.mode not in ("OBJECT", "POSE", "EDIT_MESH", "EDIT_ARMATURE"):  # a stroke may be under way
        return QUIET_S
    Live.checking, Live.count = True, Live.count + 1
    try:
        show(context.scene, lambda: find(context))
        context.view_layer.update()  # what the check itself touched is no change
    finally:
        Live.checking, Live.deaf_until = False, time.monotonic() + 0.1
    return None


def register():
    bpy.app.handlers.depsgraph_update_post.append(on_change)


def unregister():
    if bpy.app.timers.is_registered(look):
        bpy.app.timers.unregister(look)
    if on_change in bpy.app.handlers.depsgraph_update_post:
        bpy.app.handlers.depsgraph_update_post.remove(on_change)
