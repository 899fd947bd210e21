"""Settings of the object panels: role, material, pins, and attributes painted as vertex groups."""

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from .attributes import SBFMT_PG_attributes

ROLES = (
    ("AUTO", "Automatic", "Soft body and cloth modifiers make a soft body, a parent bone makes a section, weights a skin"),
    ("RENDER", "Render mesh", "Visible, and moved by its bones or by the sections that are cut from it"),
    ("SECTION", "Section", "A soft part that is attached to a bone"),
    ("SOFT", "Soft body", "Soft, and fixed only by its pins"),
    ("COLLISION", "Rigid part", "A rigid body with a hull, for joints and collision"),
    ("IGNORE", "Ignore", "Left out"),
)


class SBFMT_PG_pin(bpy.types.PropertyGroup):
    """One set of pins: a vertex group that is pinned to a bone or to the world."""

    group: StringProperty(name="Vertex group", description="Its weights: 1 pins rigidly, less pulls softly; empty: every vertex")
    armature: PointerProperty(name="Armature", type=bpy.types.Object, poll=lambda _self, one: one.type == "ARMATURE",
                              description="Armature of the bone; empty: the world")
    bone: StringProperty(name="Bone", description="Bone that the vertices are pinned to; empty: the world")
    minimum: FloatProperty(name="Least weight", default=0, min=0, max=1, description="Weights are raised to it")
    maximum: FloatProperty(name="Most weight", default=1, min=0, max=1, description="Weights are lowered to it")
    stiffness: FloatProperty(name="Stiffness (N/m)", default=0, min=0, soft_max=10000,
                             description="Stiffness at weight 1; 0: the stiffness of the body's material")
    damping: FloatProperty(name="Damping (N·s/m)", default=0, min=0, soft_max=100, description="Damping at weight 1")


class SBFMT_PG_weight_map(bpy.types.PropertyGroup):
    """A vertex group that scales one attribute."""

    group: StringProperty(name="Vertex group", description="Its weights interpolate between the two factors")
    attribute: EnumProperty(name="Attribute", default="young_modulus", items=[
        (name, name.replace("_", " ").capitalize(), f"Scales {name.replace('_', ' ')}") for name in (
            "density", "young_modulus", "bending_stiffness", "mass_damping", "stiffness_damping", "friction", "pressure",
            "yield_strain", "tear_strain")])
    low: FloatProperty(name="Factor at weight 0", default=0.1, min=0, soft_max=10)
    high: FloatProperty(name="Factor at weight 1", default=1, min=0, soft_max=10)


class SBFMT_PG_object(bpy.types.PropertyGroup):
    """Object > Soft body format."""

    role: EnumProperty(name="Role", items=ROLES, default="AUTO", description="What the object is for")
    own_values: BoolProperty(
        name="Values of this panel", default=False,
        description="Use the numbers below instead of those of the object's soft body or cloth modifier")
    simulation_only: BoolProperty(name="Simulation only", default=False,
                                  description="Soft, but not visible: it moves another mesh")
    mesh_identity: StringProperty(options={"HIDDEN"}, description="Id of the render mesh in the file it was imported from")
    body_identity: StringProperty(options={"HIDDEN"}, description="Id of the body in the file it was imported from")
    rigid_identity: StringProperty(options={"HIDDEN"}, description="Id of the rigid body in that file")
    joint_identity: StringProperty(options={"HIDDEN"}, description="Id of the joint in that file")
    field_identity: StringProperty(options={"HIDDEN"}, description="Id of the force field in that file")
    attributes: PointerProperty(type=SBFMT_PG_attributes)
    particle_radius: FloatProperty(name="Point radius (m)", default=0.01, min=0, soft_max=0.1, precision=4)
    outer_thickness: FloatProperty(name="Outer thickness (m)", default=0.005, min=0, soft_max=0.1, precision=4)
    inner_thickness: FloatProperty(name="Inner thickness (m)", default=0.01, min=0, soft_max=0.1, precision=4)
    self_collision: BoolProperty(name="Self collision", default=False, description="The body meets itself")
    pins: CollectionProperty(type=SBFMT_PG_pin)
    active_pin: IntProperty()
    weight_maps: CollectionProperty(type=SBFMT_PG_weight_map)
    active_weight_map: IntProperty()


CLASSES = (SBFMT_PG_pin, SBFMT_PG_weight_map, SBFMT_PG_object)
