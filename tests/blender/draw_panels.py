"""Runs in a Blender with a window: imports a bundle, checks and builds it, shows the panels and saves a picture of the window.

    blender --python draw_panels.py -- BUNDLE OBJECT BONE OUT.png
"""

import os
import sys
import traceback

import addon_utils
import bpy

BUNDLE, OBJECT, BONE, OUT = sys.argv[sys.argv.index("--") + 1:]


def lay_out(window):
    """Properties beside the view, twice: of the object or bone, and of the scene."""
    for area in window.screen.areas:
        if area.type == "OUTLINER":
            area.type = "PROPERTIES"


def view(window):
    area = next(one for one in window.screen.areas if one.type == "VIEW_3D")
    region = next(one for one in area.regions if one.type == "WINDOW")
    area.spaces[0].shading.color_type = "MATERIAL"
    area.spaces[0].overlay.show_relationship_lines = False
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.view3d.view_all(center=False)


def choose_tabs(window):
    """Blender knows which there are when it has drawn them."""
    bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=2)
    beside = [one for one in window.screen.areas if one.type == "PROPERTIES"]
    for one, context in zip(beside, ("BONE" if BONE else "OBJECT", "SCENE")):
        one.spaces[0].context = context


def prepare():
    bpy.ops.import_scene.soft_body_format(filepath=BUNDLE)
    for name in ("Cube", "Light", "Camera"):
        if name in bpy.data.objects:
            bpy.data.objects.remove(bpy.data.objects[name])
    bpy.ops.object.select_all(action="DESELECT")
    chosen = bpy.data.objects[OBJECT]
    chosen.select_set(True)
    bpy.context.view_layer.objects.active = chosen
    if BONE:
        chosen.data.bones.active = chosen.data.bones[BONE]
    bpy.ops.sbfmt.check()
    bpy.ops.sbfmt.build("EXEC_DEFAULT")


def shoot():
    bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=2)
    bpy.ops.screen.screenshot(filepath=OUT)
    bpy.ops.wm.quit_blender()


def step(work, *arguments):
    """A timer's call; what goes wrong ends Blender with a status."""
    def call():
        try:
            with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
                work(*arguments)
        except Exception:  # pylint: disable=broad-except
            traceback.print_exc()
            sys.stdout.flush()
            os._exit(3)
    return call


bpy.context.preferences.view.show_splash = False
addon_utils.enable("soft_body_format")
main = bpy.context.window_manager.windows[0]
for delay, work in enumerate((lambda: lay_out(main), prepare, lambda: view(main), lambda: choose_tabs(main), shoot)):
    bpy.app.timers.register(step(work), first_interval=1.5 * (delay + 1))
