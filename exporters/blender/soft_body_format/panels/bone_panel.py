"""Bone > Soft body format: the joint to the bone above."""

import bpy

from .numbers import draw_matter


class SBFMT_PT_bone(bpy.types.Panel):
    bl_label = "Soft body format"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "bone"

    @classmethod
    def poll(cls, context):
        return context.bone is not None

    def draw(self, context):
        layout, joint = self.layout, context.bone.soft_body_format.joint
        layout.use_property_split = True
        layout.prop_search(context.bone.soft_body_format, "hangs_on", context.bone.id_data, "bones")
        layout.prop(joint, "kind")
        layout.row().prop(context.scene.soft_body_format, "show_joints", text="Drawn", expand=True)
        if joint.kind not in ("NONE", "fixed"):
            self.draw_limits(layout, joint)
        row = layout.row(align=True)
        row.operator("sbfmt.copy_bone", icon="COPYDOWN").other_side = False
        row.operator("sbfmt.copy_bone", text="To the other side", icon="MOD_MIRROR").other_side = True
        layout.prop(joint, "simulated")
        layout.prop(joint, "use_mass")
        if joint.use_mass:
            layout.prop(joint, "mass")
        layout.prop(joint, "use_drive")
        if joint.use_drive:
            for name in ("drive_stiffness", "drive_damping", "drive_maximum"):
                layout.prop(joint, name)

    @staticmethod
    def draw_limits(layout, joint):
        if joint.kind != "spherical":
            layout.prop(joint, "axis")
        else:
            layout.prop(joint, "use_cone")
            if joint.use_cone:
                layout.prop(joint, "cone")
        ranges = {"spherical": ("twist", "swing_y", "swing_z"), "revolute": ("twist", ), "prismatic": ("slide", ),
                  "cylindrical": ("twist", "slide")}[joint.kind]
        for name in ranges:
            layout.prop(joint, f"use_{name}")
            if getattr(joint, f"use_{name}"):
                column = layout.column(align=True)
                column.prop(joint, f"{name}_min")
                column.prop(joint, f"{name}_max")
        layout.prop(joint, "limit_stiffness")
        layout.prop(joint, "limit_damping")


class SBFMT_PT_bone_material(bpy.types.Panel):
    bl_label = "Material of its section"
    bl_parent_id = "SBFMT_PT_bone"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "bone"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.bone is not None

    def draw_header(self, context):
        self.layout.prop(context.bone.soft_body_format, "use_material", text="")

    def draw(self, context):
        settings = context.bone.soft_body_format
        self.layout.active = settings.use_material
        self.layout.prop(settings, "rigid")
        if not settings.rigid:
            self.layout.prop(settings, "elements")
            draw_matter(self.layout, settings.attributes)


CLASSES = (SBFMT_PT_bone, SBFMT_PT_bone_material)
