"""Settings of the bone panel: the joint to the parent bone, and the mass."""

import math

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from .attributes import SBFMT_PG_attributes

KINDS = (
    ("NONE", "None", "From the rig's constraints and IK limits, if there are any"),
    ("spherical", "Ball", "Rotates about all axes, inside a cone or within ranges"),
    ("revolute", "Hinge", "Turns about one axis"),
    ("prismatic", "Slider", "Slides along one axis"),
    ("cylindrical", "Cylinder", "Rotates about an axis and slides along it"),
    ("fixed", "Fixed", "Does not move"),
)


def angle(name, default, low=-math.pi, high=math.pi):
    return FloatProperty(name=name, default=default, min=low, max=high, subtype="ANGLE")


class SBFMT_PG_joint(bpy.types.PropertyGroup):
    """Bone > Soft body format. Twist is about the bone, swing Y about its Z, swing Z about its X, all against the rest pose."""

    kind: EnumProperty(name="Joint", items=KINDS, default="NONE")
    axis: EnumProperty(name="Axis", default="X", items=[(one, one, f"The bone's {one} axis") for one in "XYZ"],
                       description="Of a hinge, slider or cylinder")
    use_cone: BoolProperty(name="Cone", default=False, description="Limit the swing to a cone about the rest pose")
    cone: angle("Half angle", math.radians(45), 0)
    use_twist: BoolProperty(name="Twist", default=False, description="Limit the rotation about the bone itself, or about a hinge's axis")
    twist_min: angle("Least", math.radians(-30))
    twist_max: angle("Most", math.radians(30))
    use_swing_y: BoolProperty(name="Swing Y", default=False, description="Limit the rotation about the bone's Z axis")
    swing_y_min: angle("Least", math.radians(-30))
    swing_y_max: angle("Most", math.radians(30))
    use_swing_z: BoolProperty(name="Swing Z", default=False, description="Limit the rotation about the bone's X axis")
    swing_z_min: angle("Least", math.radians(-30))
    swing_z_max: angle("Most", math.radians(30))
    use_slide: BoolProperty(name="Slide", default=False, description="Limit the displacement along the axis")
    slide_min: FloatProperty(name="Least (m)", default=0)
    slide_max: FloatProperty(name="Most (m)", default=0.1)
    limit_stiffness: FloatProperty(name="Limit spring (N·m/rad)", default=0, min=0, description="0: hard limits")
    limit_damping: FloatProperty(name="Limit damping (N·m·s/rad)", default=0, min=0)
    use_mass: BoolProperty(name="Own mass", default=False, description="Set the mass of the bone's rigid body")
    mass: FloatProperty(name="Mass (kg)", default=1, min=1e-6, soft_max=100)
    simulated: BoolProperty(name="Simulated", default=False, description="Falls and swings; otherwise it follows the animation")
    use_drive: BoolProperty(name="Drive", default=False, description="A motor that pulls towards the animated pose")
    drive_stiffness: FloatProperty(name="Stiffness (N·m/rad)", default=10, min=0)
    drive_damping: FloatProperty(name="Damping (N·m·s/rad)", default=1, min=0)
    drive_maximum: FloatProperty(name="Most torque (N·m)", default=0, min=0, description="0: no bound")


class SBFMT_PG_bone(bpy.types.PropertyGroup):
    identity: StringProperty(options={"HIDDEN"}, description="Id in the file it was imported from")
    order: IntProperty(options={"HIDDEN"}, description="Position in that file, from 1; 0: the bone is new")
    chain_identity: StringProperty(options={"HIDDEN"}, description="Id of the chain of inverse kinematics that ends at it")
    hangs_on: StringProperty(name="Hangs on", description="Parent of this bone in the file, such as the shin of a foot that is moved "
                             "by hand; empty: its parent here")
    joint: PointerProperty(type=SBFMT_PG_joint)
    use_material: BoolProperty(name="Material of its section", default=False,
                               description="Material of the section cut from a skin for this bone; off: the scene's")
    attributes: PointerProperty(type=SBFMT_PG_attributes)
    rigid: BoolProperty(name="Rigid", default=False, description="No section: the skin moves with this bone")
    elements: IntProperty(name="Tetrahedra", default=0, min=0, soft_max=1000,
                          description="About how many tetrahedra its lattice has; 0: the program chooses")
    proposed: BoolProperty(options={"HIDDEN"}, description="These were guessed from the rig")


CLASSES = (SBFMT_PG_joint, SBFMT_PG_bone)
