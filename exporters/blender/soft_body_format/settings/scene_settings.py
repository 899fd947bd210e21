"""Settings of the scene panel: the gait, and the messages of the last check."""

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, \
    PointerProperty, StringProperty

from ..space import DIRECTIONS
from .build_settings import SBFMT_PG_build
from .preview_settings import SBFMT_PG_preview


class SBFMT_PG_leg(bpy.types.PropertyGroup):
    """One leg: a chain of bones from the hip to the foot."""

    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")
    root: StringProperty(name="First bone", description="Thigh or upper arm")
    end: StringProperty(name="Foot", description="Last bone; its head is the foot that steps")
    group: IntProperty(name="Group", default=0, min=0, soft_max=7, description="Feet of one group may be in the air together")
    use_home: BoolProperty(name="Own home", default=False, description="Stand at another position than in the rest pose")
    home: FloatVectorProperty(name="Home", subtype="TRANSLATION", unit="LENGTH", description="Position of the foot in the world")
    use_pole: BoolProperty(name="Pole", default=False, description="Bend towards a point instead of as in the rest pose")
    pole: FloatVectorProperty(name="Pole", subtype="TRANSLATION", unit="LENGTH", description="Position of that point in the world")
    solver: EnumProperty(name="Solver", default="two_bone", items=[
        (name, label, text) for name, label, text in (
            ("two_bone", "Two bones", "Closed form; for legs of two bones"), ("ccd", "CCD", "Turns bone after bone"),
            ("fabrik", "FABRIK", "Forwards and backwards along the chain"),
            ("damped_least_squares", "Damped least squares", "Smooth near full reach"), ("spline", "Spline", "Along a curve"))])


class SBFMT_PG_tail(bpy.types.PropertyGroup):
    """A chain that lags behind the body and overshoots."""

    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")
    root: StringProperty(name="First bone")
    end: StringProperty(name="Last bone", description="Empty: to the end of the chain")
    frequency: FloatProperty(name="Frequency (Hz)", default=1.2, min=0.01, soft_max=10)
    damping_ratio: FloatProperty(name="Damping ratio", default=0.25, min=0, soft_max=2)
    limit: FloatProperty(name="Most bend", default=0.6, min=0, max=3.15, subtype="ANGLE")


class SBFMT_PG_follower(bpy.types.PropertyGroup):
    """A bone that follows its own animation like a spring."""

    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")
    bone: StringProperty(name="Bone")
    channel: EnumProperty(name="What follows", default="rotation", items=(
        ("rotation", "Rotation", ""), ("position", "Position", ""), ("both", "Both", ""),
        ("squash", "Squash", "Gets shorter when its head is stopped and longer when its head speeds up; keeps the volume"),
        ("weight", "Weight", "Sinks, rises and leans with its children as its head lags behind")))
    frequency: FloatProperty(name="Frequency (Hz)", default=2, min=0.01, soft_max=10)
    damping_ratio: FloatProperty(name="Damping ratio", default=0.5, min=0, soft_max=2)
    response: FloatProperty(name="Response", default=0, soft_min=-2, soft_max=2,
                            description="Above 1 overshoots at once, below 0 anticipates; 2 for a squash")
    axis: EnumProperty(name="Squash along", default="y", description="The bone's own axis",
                       items=(("x", "X", ""), ("y", "Y", ""), ("z", "Z", "")))
    strength: FloatProperty(name="Strength", default=1, min=0, soft_max=3,
                            description="Squash or weight: how far the bone stretches or moves, as a fraction of the distance that it lags")
    limit: FloatProperty(name="Limit", default=0.5, min=0.01, soft_max=2,
                         description="A squash stays below 1 + this of its length, above 1 / (1 + this); a weight moves by less than this of its length")


class SBFMT_PG_gait(bpy.types.PropertyGroup):
    """Scene > Soft body format > Gait."""

    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")
    use: BoolProperty(name="Walks", default=False, description="Write a gait")
    armature: PointerProperty(name="Armature", type=bpy.types.Object, poll=lambda _self, one: one.type == "ARMATURE")
    body: StringProperty(name="Body", description="The bone that carries the rest in a walk: it travels with the character")
    hips: StringProperty(name="Hips", description="Turns with the line between the hind feet")
    chest: StringProperty(name="Chest", description="Turns with the line between the fore feet")
    step_height: FloatProperty(name="Step height", default=0.05, min=0, unit="LENGTH")
    step_width: FloatProperty(name="Step width", default=0, min=0, unit="LENGTH",
                              description="Distance of a foot from the middle line; 0: as in the rest pose")
    step_trigger: FloatProperty(name="Step trigger", default=0.05, min=1e-4, unit="LENGTH",
                                description="A foot this far from its home position steps")
    step_duration: FloatProperty(name="Step duration (s)", default=0.25, min=0.01, soft_max=2)
    walk_speed: FloatProperty(name="Walking speed (m/s)", default=0.5, min=0.001, soft_max=5)
    hip_tilt: FloatProperty(name="Hip tilt", default=0.5, min=0, max=1)
    body_tilt: FloatProperty(name="Body tilt", default=0.7, min=0, max=1)
    legs: CollectionProperty(type=SBFMT_PG_leg)
    active_leg: IntProperty()
    head: StringProperty(name="Head", description="Turns ahead of the body and comes back; empty: no bone")
    head_lead: FloatProperty(name="Lead (s)", default=0.4, min=0, soft_max=2)
    head_limit: FloatProperty(name="Most turn", default=0.7, min=0, max=3.15, subtype="ANGLE")
    tails: CollectionProperty(type=SBFMT_PG_tail)
    active_tail: IntProperty()
    followers: CollectionProperty(type=SBFMT_PG_follower)
    active_follower: IntProperty()


class SBFMT_PG_finding(bpy.types.PropertyGroup):
    """One message of the last check, for the list."""

    severity: StringProperty()
    message: StringProperty()
    object_name: StringProperty()
    bone_name: StringProperty()
    vertices: StringProperty(description="Numbers, separated by spaces")
    code: StringProperty()


class SBFMT_PG_scene(bpy.types.PropertyGroup):
    ahead: EnumProperty(name="Looks along", default="-Y", description="Direction in the scene in which the character walks: forward in the file",
                        items=[(direction, direction, f"Ahead is {direction}") for direction in DIRECTIONS])
    ground: FloatProperty(name="Stands at", default=0, unit="LENGTH", description="Height in the scene of the ground, which is 0 in the file")
    gait: PointerProperty(type=SBFMT_PG_gait)
    build: PointerProperty(type=SBFMT_PG_build)
    preview: PointerProperty(type=SBFMT_PG_preview)
    findings: CollectionProperty(type=SBFMT_PG_finding)
    active_finding: IntProperty()
    checks_live: BoolProperty(name="Check as I work", default=True, description="After the first check the list follows the scene, "
                              "where a check takes less than half a second")
    is_checked: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    check_time: FloatProperty(options={"HIDDEN", "SKIP_SAVE"}, description="Seconds that the last check took")
    repairs_files: BoolProperty(name="Repair files as they are written", default=False,
                              description="Builds and exports repair faults that have one right answer, and report each repair")
    show_joints: EnumProperty(name="Joints", default="SELECTED", description="Joints whose limits are drawn in the viewport", items=(
        ("NONE", "None", "No joint is drawn"), ("SELECTED", "Selected", "Joints of the active armature's selected bones"),
        ("ALL", "All", "Joints of every visible armature")))
    show_overlay: BoolProperty(name="Draw the build", default=True, description="Draw the last build over the model")
    show_parts: EnumProperty(name="Of it", options={"ENUM_FLAG"}, default={"SURFACE", "INSIDE", "LATTICE", "PINS"}, items=(
        ("SURFACE", "Surface", "Springs over the surface, yellow and blue, and between bodies, green"),
        ("INSIDE", "Inside", "Springs inside, orange"), ("LATTICE", "Lattice", "Tetrahedra, light blue"),
        ("PINS", "Pins", "Pinned points, red")))


CLASSES = (SBFMT_PG_leg, SBFMT_PG_tail, SBFMT_PG_follower, SBFMT_PG_gait, SBFMT_PG_finding, SBFMT_PG_scene)
