"""Scene > Soft body format > Check and build: the list of messages, with buttons that select and repair."""

import bpy

from ..repairs import repair_of
from .scene_panels import ScenePanel


class SBFMT_UL_findings(bpy.types.UIList):
    """A list with one message per line."""

    ICONS = {"ERROR": "CANCEL", "WARNING": "ERROR", "INFO": "INFO"}

    def draw_item(self, context, layout, _data, item, _icon, _active_data, _active_name, index):
        location = item.object_name + (f", {item.bone_name}" if item.bone_name else "")
        layout.label(text=f"{location}: {item.message}" if location else item.message, icon=self.ICONS.get(item.severity, "DOT"))
        if repair_of(item, context.scene.soft_body_format.repairs_files) is not None:
            layout.operator("sbfmt.repair", text="", icon="TOOL_SETTINGS", emboss=False).index = index
        if location:
            layout.operator("sbfmt.select_finding", text="", icon="RESTRICT_SELECT_OFF", emboss=False).index = index


class SBFMT_PT_check(ScenePanel, bpy.types.Panel):
    bl_label = "Check and build"
    bl_parent_id = "SBFMT_PT_scene"

    def draw(self, context):
        layout, settings = self.layout, context.scene.soft_body_format
        row = layout.row()
        row.operator("sbfmt.check", icon="CHECKMARK")
        row.operator("sbfmt.build", icon="MESH_ICOSPHERE")
        layout.template_list("SBFMT_UL_findings", "", settings, "findings", settings, "active_finding", rows=4)
        if settings.active_finding < len(settings.findings):
            finding = settings.findings[settings.active_finding]
            column = layout.column(align=True)
            for line in wrapped(finding.message, context.region.width):
                column.label(text=line)
            row = layout.row(align=True)
            if finding.object_name:
                row.operator("sbfmt.select_finding", icon="RESTRICT_SELECT_OFF").index = settings.active_finding
            repair = repair_of(finding, settings.repairs_files)
            if repair is not None:
                row.operator("sbfmt.repair", text=repair.label, icon="TOOL_SETTINGS").index = settings.active_finding
        if sum(repair_of(one, settings.repairs_files) is not None for one in settings.findings) > 1:
            layout.operator("sbfmt.repair", text="Repair all", icon="TOOL_SETTINGS").index = -1
        layout.prop(settings, "checks_live")
        layout.prop(settings, "repairs_files")


def wrapped(text, width_px):
    """Wraps text, because Blender's labels don't. A letter of its font is about 6 pixels wide."""
    scale = bpy.context.preferences.system.ui_scale
    max_letters = max(20, int((width_px / scale - 40) / 6.2))
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > max_letters:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return lines


CLASSES = (SBFMT_UL_findings, SBFMT_PT_check)
