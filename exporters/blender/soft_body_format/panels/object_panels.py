"""Object > Soft body format: role, material, pins and painted attributes."""

import bpy

from ..to_document.roles import COLLISION, IGNORE, RENDER, SURFACES, role_of, shown_role
from .list_buttons import draw_list
from .numbers import draw_matter


class ObjectPanel:
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "object"

    @classmethod
    def poll(cls, context):
        return context.object is not None and (context.object.type == "MESH" or context.object.type in SURFACES)


class BodyPanel(ObjectPanel):
    """Base class for panels of soft bodies."""

    bl_parent_id = "SBFMT_PT_object"

    @classmethod
    def poll(cls, context):
        return ObjectPanel.poll.__func__(cls, context) and role_of(context.object) not in (RENDER, COLLISION, IGNORE)


class SBFMT_PT_object(ObjectPanel, bpy.types.Panel):
    bl_label = "Soft body format"

    def draw(self, context):
        layout, source = self.layout, context.object
        layout.use_property_split = True
        layout.prop(source.soft_body_format, "role")
        if source.soft_body_format.role == "AUTO":
            layout.label(text=f"Exported as: {shown_role(source).capitalize()}", icon="INFO")
        if role_of(source) not in (RENDER, COLLISION, IGNORE):
            layout.prop(source.soft_body_format, "simulation_only")
        layout.operator("sbfmt.copy_object", icon="COPYDOWN")


class SBFMT_PT_material(BodyPanel, bpy.types.Panel):
    bl_label = "Material"

    def draw(self, context):
        layout, settings = self.layout, context.object.soft_body_format
        layout.use_property_split = True
        if any(one.type in ("SOFT_BODY", "CLOTH") for one in context.object.modifiers):
            layout.prop(settings, "own_values")
            layout = layout.column()
            layout.enabled = settings.own_values
        draw_matter(layout, settings.attributes)


class SBFMT_PT_limits(BodyPanel, bpy.types.Panel):
    bl_label = "Pressure, yield, tear"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, numbers = self.layout, context.object.soft_body_format.attributes
        layout.use_property_split = True
        layout.prop(numbers, "pressure_mode")
        if numbers.pressure_mode != "none":
            layout.prop(numbers, "pressure")
        for switch, names in (("yields", ("yield_strain", "yield_flow")), ("tears", ("tear_strain", ))):
            layout.prop(numbers, switch)
            if getattr(numbers, switch):
                for name in names:
                    layout.prop(numbers, name)


class SBFMT_PT_collision(BodyPanel, bpy.types.Panel):
    bl_label = "Collision"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.object.soft_body_format
        layout.use_property_split = True
        for name in ("particle_radius", "outer_thickness", "inner_thickness", "self_collision"):
            layout.prop(settings, name)


class SBFMT_PT_pins(BodyPanel, bpy.types.Panel):
    bl_label = "Pins"

    def draw(self, context):
        layout, source = self.layout, context.object
        layout.use_property_split = True
        pin = draw_list(layout, source.soft_body_format, "object.pins", "active_pin")
        if pin is None:
            return
        layout.prop_search(pin, "group", source, "vertex_groups")
        layout.prop(pin, "armature")
        if pin.armature is not None:
            layout.prop_search(pin, "bone", pin.armature.data, "bones")
        for name in ("minimum", "maximum", "stiffness", "damping"):
            layout.prop(pin, name)


class SBFMT_PT_weight_maps(BodyPanel, bpy.types.Panel):
    bl_label = "Painted attributes"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, source = self.layout, context.object
        layout.use_property_split = True
        entry = draw_list(layout, source.soft_body_format, "object.weight_maps", "active_weight_map")
        if entry is None:
            return
        layout.prop_search(entry, "group", source, "vertex_groups")
        for name in ("attribute", "low", "high"):
            layout.prop(entry, name)


CLASSES = (SBFMT_PT_object, SBFMT_PT_material, SBFMT_PT_limits, SBFMT_PT_collision, SBFMT_PT_pins, SBFMT_PT_weight_maps)
