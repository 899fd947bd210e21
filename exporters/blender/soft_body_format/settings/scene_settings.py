"""What the panel of a scene holds: how the character walks, and what an export or a check found."""

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, \
    PointerProperty, StringProperty

from ..space import WAYS
from .build_settings import SBFMT_PG_build
from .preview_settings import SBFMT_PG_preview


class SBFMT_PG_leg(bpy.types.PropertyGroup):
    """One leg: a chain of bones from the hip to the foot."""

    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")
    root: StringProperty(name="First bone", description="Thigh or upper arm")
    end: StringProperty(name="Foot", description="Last bone; its head is what steps")
    group: IntProperty(name="Group", default=0, min=0, soft_max=7, description="Feet of one group may be in the air together")
    use_home: BoolProperty(name="Own home", default=False, description="Stand elsewhere than in the rest pose")
    home: FloatVectorProperty(name="Home", subtype="TRANSLATION", unit="LENGTH", description="Where the foot stands, in the world")
    use_pole: BoolProperty(name="Pole", default=False, description="Bend towards a point instead of as in the rest pose")
    pole: FloatVectorProperty(name="Pole", subtype="TRANSLATION", unit="LENGTH", description="That point, in the world")
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
    """A bone that follows its own animation as a spring does."""

    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")
    bone: StringProperty(name="Bone")
    channel: EnumProperty(name="What follows", default="rotation", items=(
        ("rotation", "Rotation", ""), ("position", "Position", ""), ("both", "Both", ""),
        ("squash", "Squash", "Shorter where its head is stopped, longer where it speeds away; the volume stays"),
        ("weight", "Weight", "Sinks, rises and leans as its head lags behind in the world, and all that hangs on it with it")))
    frequency: FloatProperty(name="Frequency (Hz)", default=2, min=0.01, soft_max=10)
    damping_ratio: FloatProperty(name="Damping ratio", default=0.5, min=0, soft_max=2)
    response: FloatProperty(name="Response", default=0, soft_min=-2, soft_max=2,
                            description="Above 1 overshoots at once, below 0 anticipates; 2 for a squash")
    axis: EnumProperty(name="Squash along", default="y", description="The bone's own axis",
                       items=(("x", "X", ""), ("y", "Y", ""), ("z", "Z", "")))
    strength: FloatProperty(name="Strength", default=1, min=0, soft_max=3,
                            description="Of a squash or a weight: share of its length by which the bone stretches, or moves, as it lags by its length")
    limit: FloatProperty(name="Limit", default=0.5, min=0.01, soft_max=2,
                         description="A squash stays below 1 + this of its length, above 1 / (1 + this); a weight moves by less than this of its length")


class SBFMT_PG_gait(bpy.types.PropertyGroup):
    """Scene > Soft body format > Gait."""

    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")
    use: BoolProperty(name="Walks", default=False, description="Write a gait")
    armature: PointerProperty(name="Armature", type=bpy.types.Object, poll=lambda _self, one: one.type == "ARMATURE")
    body: StringProperty(name="Body", description="The bone on which the rest hangs in a walk: it travels with the character")
    hips: StringProperty(name="Hips", description="Turns with the line between the hind feet")
    chest: StringProperty(name="Chest", description="Turns with the line between the fore feet")
    step_height: FloatProperty(name="Step height", default=0.05, min=0, unit="LENGTH")
    step_width: FloatProperty(name="Step width", default=0, min=0, unit="LENGTH",
                              description="Of a foot from the middle line; 0: as it stands")
    step_trigger: FloatProperty(name="Step trigger", default=0.05, min=1e-4, unit="LENGTH",
                                description="A foot this far from its home wants to step")
    step_duration: FloatProperty(name="Step duration (s)", default=0.25, min=0.01, soft_max=2)
    walk_speed: FloatProperty(name="Walking speed (m/s)", default=0.5, min=0.001, soft_max=5)
    hip_tilt: FloatProperty(name="Hip tilt", default=0.5, min=0, max=1)
    body_tilt: FloatProperty(name="Body tilt", default=0.7, min=0, max=1)
    legs: CollectionProperty(type=SBFMT_PG_leg)
    active_leg: IntProperty()
    head: StringProperty(name="Head", description="Leads a turn and comes back; empty: no head turns")
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
    ahead: EnumProperty(name="Looks along", default="-Y", description="Which way of the scene is ahead in the file, where the character walks to",
                        items=[(way, way, f"Ahead is {way}") for way in WAYS])
    ground: FloatProperty(name="Stands at", default=0, unit="LENGTH", description="Height of the scene that is the ground, 0, in the file")
    gait: PointerProperty(type=SBFMT_PG_gait)
    build: PointerProperty(type=SBFMT_PG_build)
    preview: PointerProperty(type=SBFMT_PG_preview)
    findings: CollectionProperty(type=SBFMT_PG_finding)
    active_finding: IntProperty()
    checks_live: BoolProperty(name="Check as I work", default=True, description="After the first check the list follows the scene, "
                              "where a check takes less than half a second")
    is_checked: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})
    check_time: FloatProperty(options={"HIDDEN", "SKIP_SAVE"}, description="Seconds that the last check took")
    mends_files: BoolProperty(name="Mend files as they are written", default=False,
                              description="What has one right answer is mended in builds and exports, and told")
    show_joints: EnumProperty(name="Joints", default="SELECTED", description="Whose limits are drawn in the viewport", items=(
        ("NONE", "None", "No joint is drawn"), ("SELECTED", "Selected", "Those of the active armature's selected bones"),
        ("ALL", "All", "Those of every armature that is seen")))
    show_overlay: BoolProperty(name="Draw the build", default=True, description="What was built last, over the model")
    show_parts: EnumProperty(name="Of it", options={"ENUM_FLAG"}, default={"SURFACE", "INSIDE", "LATTICE", "PINS"}, items=(
        ("SURFACE", "Surface", "Springs over the surface, yellow and blue, and between bodies, green"),
        ("INSIDE", "Inside", "Springs inside, orange"), ("LATTICE", "Lattice", "Tetrahedra, light blue"),
        ("PINS", "Pins", "Points that are held, red")))


CLASSES = (SBFMT_PG_leg, SBFMT_PG_tail, SBFMT_PG_follower, SBFMT_PG_gait, SBFMT_PG_finding, SBFMT_PG_scene)
