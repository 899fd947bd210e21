"""Settings of the preview in the viewport and of bakes."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

BAKE_FOLDER = {"ANIMATABLE"} | ({"PATH_SUPPORTS_BLEND_RELATIVE"} if bpy.app.version >= (4, 5, 0) else set())


class SBFMT_PG_preview(bpy.types.PropertyGroup):
    """Scene > Soft body format > Preview."""

    ground: EnumProperty(name="Ground", default="LEVEL", items=(
        ("LEVEL", "Level", "A level ground at a height"),
        ("OBJECT", "Object", "A mesh; beside it a level ground at the height"),
        ("NONE", "None", "Nothing to stand on")))
    ground_height: FloatProperty(name="Height", default=0, unit="LENGTH", description="Height of the level ground above Stands at")
    ground_object: PointerProperty(name="Object", type=bpy.types.Object, poll=lambda _self, one: one.type == "MESH",
                                   description="The mesh that the character stands on")
    drive: EnumProperty(name="Drive", default="STAND", items=(
        ("STAND", "Stand", "Where it is"),
        ("WALK", "Walk", "With the speeds below"),
        ("CURVE", "Along a curve", "From the curve's beginning to its end, or round it where it is closed")))
    speed: FloatProperty(name="Speed (m/s)", default=0.3, soft_min=0, soft_max=5, description="Forward; may be animated")
    sideways: FloatProperty(name="Sideways (m/s)", default=0, soft_min=-2, soft_max=2, description="To the left; may be animated")
    turn: FloatProperty(name="Turn (rad/s)", default=0, soft_min=-3, soft_max=3, description="To the left; may be animated")
    curve: PointerProperty(name="Curve", type=bpy.types.Object, poll=lambda _self, one: one.type == "CURVE",
                           description="The path to walk along: the first spline, seen from above")
    follow_animation: BoolProperty(name="Play the animation", default=True,
                                   description="Play the armature's own animation under the gait")
    settling_s: FloatProperty(name="Settling time (s)", default=0, min=0, soft_max=5,
                              description="Time simulated before the first frame, so that bodies come to rest")
    bake_start: IntProperty(name="Start", default=1, description="First frame to keep")
    bake_end: IntProperty(name="End", default=250, description="Last frame to keep")
    bake_to: EnumProperty(name="Bake to", default="PC2", items=(
        ("PC2", "Point cache (.pc2)", "A file an object, played by a Mesh Cache modifier"),
        ("MDD", "Point cache (.mdd)", "A file an object, played by a Mesh Cache modifier"),
        ("SHAPE_KEYS", "Shape keys", "Copies of the objects with a keyed shape for each frame")))
    bake_folder: StringProperty(name="Folder", default="//soft_body_cache", subtype="DIR_PATH", options=BAKE_FOLDER,
                                description="Folder of point caches")
    key_every: IntProperty(name="A key every", default=1, min=1, soft_max=10, description="Frames from one shape key to the next")


CLASSES = (SBFMT_PG_preview, )
