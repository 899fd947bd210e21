"""Runs in Blender with a window: opens a bundle, follows docs/blender.md, and takes a picture of every panel and of every overlay in
the viewport.

    blender --python draw_panels.py -- LIZARD.sbf SCREEN FOLDER [smooth]

SCREEN is the file that Xvfb keeps its screen in: some Blenders can't read back what software drew in their window. Smoothed lines and
edges are for who looks at the pictures: with a screen that software draws they take most of the time.
"""

import os
import sys
import time
import traceback

import addon_utils
import bpy
from mathutils import Vector

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import pictures  # noqa: E402

BUNDLE, SCREEN, FOLDER, *SMOOTH = sys.argv[sys.argv.index("--") + 1:]
WINDOW = bpy.context.window_manager.windows[0]
OWN_PANELS = []
WORK, CHECKS = [], []


# ---- The window ----

def area_of(kind):
    return next(one for one in WINDOW.screen.areas if one.type == kind)


def region_of(area, kind="WINDOW"):
    return next(one for one in area.regions if one.type == kind)


def within(area):
    return bpy.context.temp_override(window=WINDOW, area=area, region=region_of(area))


def lay_out():
    """The view, a properties editor beside it, the timeline below, and nothing else."""
    for kind in ("OUTLINER", "PROPERTIES"):
        with within(area_of(kind)):
            bpy.ops.screen.area_close()


def split():
    with within(area_of("VIEW_3D")):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.62)


def place_properties():
    views = sorted((one for one in WINDOW.screen.areas if one.type == "VIEW_3D"), key=lambda one: one.x)
    views[-1].type = "PROPERTIES"
    space = area_of("VIEW_3D").spaces[0]
    space.shading.color_type = "MATERIAL"
    space.overlay.show_relationship_lines = space.overlay.show_extras = False
    space.overlay.show_cursor = space.show_gizmo = False
    space.show_region_toolbar = False


def panels_below(one):
    for below in one.__subclasses__():
        yield below
        yield from panels_below(below)


def prepare_panels():
    """Blender's own panels make room; ours are open."""
    for one in list(panels_below(bpy.types.Panel)):
        if getattr(one, "bl_space_type", "") != "PROPERTIES" or one.bl_region_type != "WINDOW":
            continue
        if one.__name__.startswith("SBFMT_"):
            OWN_PANELS.append(one)
        else:
            try:
                bpy.utils.unregister_class(one)
            except RuntimeError:  # a base of others, never registered itself
                pass
    from soft_body_format import panels
    OWN_PANELS.sort(key=panels.CLASSES.index)


def only(*names):
    """Registers those panels, opened, and their parents."""
    for one in reversed(OWN_PANELS):
        if hasattr(bpy.types, one.__name__):
            bpy.utils.unregister_class(one)
    for one in OWN_PANELS:
        if one.__name__[len("SBFMT_PT_"):] in (*names, "object", "bone", "scene"):
            one.bl_options = set(getattr(one, "bl_options", ())) - {"DEFAULT_CLOSED"}
            bpy.utils.register_class(one)


def tab(name):
    area_of("PROPERTIES").spaces[0].context = name


def look(names, angles, near=1.0):
    """At those objects, which fill the view where `near` is 1."""
    corners = [source.matrix_world @ Vector(corner) for source in map(bpy.data.objects.get, names) for corner in source.bound_box]
    low, high = (Vector([pick(one[axis] for one in corners) for axis in range(3)]) for pick in (min, max))
    view = area_of("VIEW_3D").spaces[0].region_3d
    view.view_rotation, view.view_location = angles, (low + high) / 2
    # From afar by a long lens: this Blender's software renderer loses objects nearer than two metres.
    area_of("VIEW_3D").spaces[0].lens = 200
    view.view_distance = (high - low).length * 6 / near


def sections():
    return [one.name for one in bpy.data.objects if one.type == "MESH" and "preview" not in one.name]


def choose(name, bone=""):
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="DESELECT")
    chosen = bpy.data.objects[name]
    chosen.hide_set(False)
    chosen.select_set(True)
    bpy.context.view_layer.objects.active = chosen
    if bone:
        chosen.data.bones.active = chosen.data.bones[bone]


def rig():
    return next(one for one in bpy.data.objects if one.type == "ARMATURE")


# ---- The steps of docs/blender.md ----

def open_bundle():
    for source in list(bpy.data.objects):
        bpy.data.objects.remove(source)
    bpy.ops.import_scene.soft_body_format(filepath=BUNDLE)
    pin = bpy.data.objects["Chest"].soft_body_format.pins.add()
    bpy.data.objects["Chest"].vertex_groups.new(name="collar").add([0, 1, 2], 1.0, "REPLACE")
    pin.group, pin.armature, pin.bone = "collar", rig(), bpy.data.objects["Chest"].parent_bone


def press(operator):
    """As a button is, which leaves Blender its window: `until` waits for the end. Nothing is calibrated, which no picture shows."""
    bpy.context.scene.soft_body_format.build.calibration = False
    operator("INVOKE_DEFAULT")


def press_build():
    press(bpy.ops.sbfmt.build)


def until(is_done):
    """A step that is repeated until the operator's work is over, which must have come to that."""
    def wait():
        if not WORK:
            return False
        bpy.context.scene.soft_body_format.build.calibration = True
        if WORK.pop() != {"FINISHED"} or not is_done():
            raise RuntimeError("the work ended without what it was for: its message stands above")
        return True
    return wait


def watch_work():
    """WORK gets how the work of an operator ended."""
    from soft_body_format.operators.working import Working
    go_on, modal = Working.go_on, Working.modal

    def escaped(self, context, event):
        done = modal(self, context, event)
        if event.type == "ESC":
            WORK.append(done)
        return done
    Working.modal = escaped

    def watched(self, context, seconds):
        done = go_on(self, context, seconds)
        if done != {"RUNNING_MODAL"}:
            WORK.append(done)
        return done
    Working.go_on = watched


def press_escape():
    """As the key is, while a build works."""
    bpy.ops.sbfmt.build("INVOKE_DEFAULT")
    for value in ("PRESS", "RELEASE"):
        WINDOW.event_simulate(type="ESC", value=value, x=WINDOW.width // 3, y=WINDOW.height // 2)


def expect_nothing():
    """The build has ended at once, and left nothing behind."""
    if not WORK:
        return False
    from soft_body_format.building import LastBuild
    if WORK.pop() != {"CANCELLED"} or LastBuild.built is not None or is_built():
        raise RuntimeError("Escape is to end a build, which then leaves nothing")
    return True


def is_built():
    from soft_body_format.overlay import structure
    return structure.summary(bpy.context.scene) != "built: nothing is soft"


def is_playing():
    from soft_body_format.preview import handlers
    return handlers.running() is not None


def break_something():
    head = bpy.data.objects["Head"].data
    head.polygons[3].flip()
    head.update()
    pins = bpy.data.objects["Chest"].soft_body_format.pins
    pin = pins.add()
    pin.group, pin.armature, pin.bone = pins[0].group, pins[0].armature, pins[0].bone
    bpy.ops.sbfmt.check()
    findings = bpy.context.scene.soft_body_format.findings
    bpy.context.scene.soft_body_format.active_finding = next(
        (i for i, one in enumerate(findings) if one.code.startswith("SURFACE_WINDING")), 0)


def repair_it():
    bpy.ops.sbfmt.repair(index=-1)
    if any(one.code == "SURFACE_WINDING" for one in bpy.context.scene.soft_body_format.findings):
        raise RuntimeError("the button did not repair the face")


def idle(times):
    """That many calls, in which nothing is touched, as a step; then `CHECKS` holds how many checks were made unasked until now."""
    left = [times]

    def wait():
        from soft_body_format.operators import live_check
        left[0] -= 1
        if left[0] > 0:
            return False
        CHECKS.append(live_check.Live.count)
        print("checks made unasked:", CHECKS)
        return True
    return wait


def touch():
    """A change, which is checked unasked however slow this machine is."""
    from soft_body_format.operators import live_check
    live_check.MAX_CHECK_S = 1e6
    bpy.data.objects["Head"].data.update()


def expect_no_messages():
    if CHECKS[-1] != CHECKS[-2] or CHECKS[-1] == 0:
        raise RuntimeError(f"a change is to be checked, and not again and again: {CHECKS}")
    from soft_body_format.operators import live_check
    live_check.MAX_CHECK_S = 0


def add_follower():
    bpy.context.scene.soft_body_format.gait.followers.add().bone = "head"


def bend():
    """A pose that keeps its limits, but for one leg."""
    choose(rig().name)
    bpy.ops.object.mode_set(mode="POSE")
    for pose in rig().pose.bones:
        pose.rotation_mode = "XYZ"
    broken = rig().pose.bones["head"]
    broken.rotation_euler = (0.2, 1.3, 0.2)
    rig().data.bones.active = rig().data.bones["head"]


def draw_way():
    for pose in rig().pose.bones:
        pose.rotation_euler = (0, 0, 0)
    bpy.ops.object.mode_set(mode="OBJECT")
    data = bpy.data.curves.new("Way", "CURVE")
    data.dimensions = "3D"
    spline = data.splines.new("BEZIER")
    spline.bezier_points.add(2)
    for point, position in zip(spline.bezier_points, ((0, 0, 0), (0.6, -1.2, 0), (-0.4, -2.4, 0))):
        point.co, point.handle_left_type, point.handle_right_type = position, "AUTO", "AUTO"
    way = bpy.data.objects.new("Way", data)
    bpy.context.scene.collection.objects.link(way)
    settings = bpy.context.scene.soft_body_format.preview
    settings.drive, settings.curve, settings.speed = "CURVE", way, 0.4


def start_preview():
    bpy.context.scene.frame_set(1)
    press(bpy.ops.sbfmt.preview_start)


def play():
    for frame in range(2, 61):
        bpy.context.scene.frame_set(frame)


def stop_preview():
    bpy.ops.sbfmt.preview_stop()


def leave():
    """The add-on takes everything off again. Blender itself, without its panels, can't be asked to quit in peace."""
    addon_utils.disable("soft_body_format")
    sys.stdout.flush()
    os._exit(0)


# ---- Pictures ----

def shoot(name, *kinds):
    """What those areas show, as one picture; of panels alone as much as they fill."""
    def take():
        bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=2)
        areas = [area_of(kind) for kind in kinds]
        low = [min(getattr(one, axis) for one in areas) for axis in "xy"]
        high = [max(getattr(one, axis) + size for one, size in ((one, getattr(one, extent)) for one in areas))
                for axis, extent in (("x", "width"), ("y", "height"))]
        panels_alone = kinds == ("PROPERTIES", )
        if panels_alone:  # without its navigation and header
            region = region_of(areas[0])
            low, high = [region.x, region.y], [region.x + region.width, region.y + region.height]
        pictures.save_part(SCREEN, os.path.join(FOLDER, f"{name}.png"), (*low, *high), trim_bottom=panels_alone)
    return take


def several(*works):
    return lambda: [work() for work in works]


FRONT = (0.82, 0.43, 0.18, 0.34)
STEPS = (
    lay_out, prepare_panels, several(only, split), place_properties, open_bundle,
    several(lambda: look(sections(), FRONT, 1.8), lambda: choose("Chest"),
            lambda: bpy.data.objects["Pelvis"].select_set(True),
            lambda: only("material", "pins", "limits", "collision", "weight_maps")),
    lambda: tab("OBJECT"), shoot("blender-object", "PROPERTIES"),
    press_escape, expect_nothing, several(press_build, lambda: only("check", "build", "drawn")), until(is_built), lambda: tab("SCENE"),
    shoot("blender", "VIEW_3D", "PROPERTIES"),
    several(break_something, lambda: only("check")), shoot("blender-check", "PROPERTIES"), repair_it,
    touch, idle(8), idle(8), expect_no_messages,
    lambda: only("gait", "legs"), shoot("blender-gait", "PROPERTIES"),
    several(add_follower, lambda: only("head", "tails", "followers", "gait")), shoot("blender-tails", "PROPERTIES"),
    several(bend, lambda: only("bone", "bone_material"),
            lambda: setattr(bpy.context.scene.soft_body_format, "show_joints", "ALL"),
            lambda: setattr(bpy.context.scene.soft_body_format, "show_overlay", False)),
    lambda: tab("BONE"), shoot("blender-joints", "VIEW_3D", "PROPERTIES"),
    several(draw_way, lambda: only("preview", "bake"), lambda: setattr(bpy.context.scene.soft_body_format, "show_joints", "NONE")),
    lambda: tab("SCENE"), start_preview, until(is_playing), play,
    lambda: look([one.name for one in bpy.data.objects if one.name.endswith("(preview)")], FRONT, 1.5), shoot("blender-preview", "VIEW_3D", "PROPERTIES"),
    stop_preview, lambda: only(*(one.__name__[len("SBFMT_PT_"):] for one in OWN_PANELS)), leave,
)


def run(steps):
    """One a timer's call, so that Blender draws between them; again where it says False. What goes wrong ends it with a status."""
    left = list(steps)

    def call():
        try:
            with bpy.context.temp_override(window=WINDOW):
                if left and left[0]() is not False:
                    left.pop(0)
                    print(f"step {len(steps) - len(left)} of {len(steps)}, {time.process_time():.0f} s of the processor", flush=True)
        except Exception:  # pylint: disable=broad-except
            traceback.print_exc()
            sys.stdout.flush()
            os._exit(3)
        return 0.3
    return call


bpy.context.preferences.view.show_splash = False
if not SMOOTH:
    bpy.context.preferences.system.viewport_aa, bpy.context.preferences.system.use_overlay_smooth_wire = "OFF", False
addon_utils.enable("soft_body_format")
watch_work()
bpy.app.timers.register(run(STEPS), first_interval=1.5)
