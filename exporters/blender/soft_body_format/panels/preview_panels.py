"""Scene > Soft body format > Preview, and the same in the sidebar of the 3D viewport."""

import bpy

from ..preview import handlers
from .scene_panels import ScenePanel


class PreviewPanel:
    bl_label = "Preview"

    def draw(self, context):
        layout, settings = self.layout, context.scene.soft_body_format.preview
        session = handlers.running()
        row = layout.row(align=True)
        row.operator("sbfmt.preview_start", text="Start" if session is None else "Restart", icon="PLAY" if session is None else
                     "FILE_REFRESH")
        row.operator("sbfmt.preview_stop", icon="SNAP_FACE")
        if session is not None:
            layout.label(text=session.state(), icon="INFO")
        layout.use_property_split = True
        layout.prop(settings, "ground")
        if settings.ground == "OBJECT":
            layout.prop(settings, "ground_object")
        if settings.ground != "NONE":
            layout.prop(settings, "ground_height")
        layout.prop(settings, "drive")
        column = layout.column(align=True)
        if settings.drive == "CURVE":
            column.prop(settings, "curve")
        if settings.drive != "STAND":
            column.prop(settings, "speed")
        if settings.drive == "WALK":
            column.prop(settings, "sideways")
            column.prop(settings, "turn")
        layout.prop(settings, "follow_animation")
        layout.prop(settings, "settling_s")


class SBFMT_PT_preview(PreviewPanel, ScenePanel, bpy.types.Panel):
    bl_parent_id = "SBFMT_PT_scene"


class SBFMT_PT_preview_view(PreviewPanel, bpy.types.Panel):
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Soft body"
    bl_label = "Preview"


class BakePanel:
    bl_label = "Bake"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, settings = self.layout, context.scene.soft_body_format.preview
        layout.use_property_split = True
        column = layout.column(align=True)
        column.prop(settings, "bake_start")
        column.prop(settings, "bake_end")
        layout.prop(settings, "bake_to")
        layout.prop(settings, "key_every" if settings.bake_to == "SHAPE_KEYS" else "bake_folder")
        layout.operator("sbfmt.bake", icon="REC")
        row = layout.row(align=True)
        row.operator("sbfmt.bake_cut", icon="SCULPTMODE_HLT")
        row.operator("sbfmt.bake_free", icon="TRASH")


class SBFMT_PT_bake(BakePanel, ScenePanel, bpy.types.Panel):
    bl_parent_id = "SBFMT_PT_preview"


class SBFMT_PT_bake_view(BakePanel, bpy.types.Panel):
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Soft body"
    bl_parent_id = "SBFMT_PT_preview_view"


CLASSES = (SBFMT_PT_preview, SBFMT_PT_bake, SBFMT_PT_preview_view, SBFMT_PT_bake_view)
