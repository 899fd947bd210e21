"""Scene > Soft body format > What a build makes: settings of builds, and what the overlay draws."""

import bpy

from .numbers import draw_matter
from .scene_panels import ScenePanel


class SBFMT_PT_build(ScenePanel, bpy.types.Panel):
    bl_label = "What a build makes"
    bl_parent_id = "SBFMT_PT_scene"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, build = self.layout, context.scene.soft_body_format.build
        layout.use_property_split = True
        layout.prop(build, "interior")
        layout.prop(build, "size_by")
        if build.size_by != "AUTOMATIC":
            layout.prop(build, build.size_by.lower())
        column = layout.column(align=True)
        column.prop(build, "levels")
        column.prop(build, "render_levels")
        layout.prop(build, "flexion")
        layout.prop(build, "calibration")
        layout.prop(build, "sections")
        column = layout.column()
        column.active = build.sections
        column.prop(build, "overlap")
        column.prop(build, "use_material", text="Material of sections")
        if build.sections and build.use_material:
            draw_matter(layout.box(), build.attributes)


class SBFMT_PT_drawn(ScenePanel, bpy.types.Panel):
    bl_label = "Drawn in the viewport"
    bl_parent_id = "SBFMT_PT_scene"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.soft_body_format
        layout.use_property_split = True
        layout.prop(settings, "show_overlay")
        row = layout.row()
        row.active = settings.show_overlay
        row.prop(settings, "show_parts")
        layout.row().prop(settings, "show_joints", expand=True)


CLASSES = (SBFMT_PT_build, SBFMT_PT_drawn)
