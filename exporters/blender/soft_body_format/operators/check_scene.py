"""Scene > Soft body format > Check: what an export would say, as a list; a click selects what it is about."""

import bpy
from bpy.props import IntProperty

from .. import sbfmt
from ..findings import Findings
from ..finishing import check, has_library, to_asset
from ..to_document import Options
from ..whole import write_whole


def find(context):
    """What is wrong with the scene, without writing anything."""
    findings = Findings()
    whole = write_whole(context, Options(textures="EMBED"), findings)
    if not has_library():
        findings.info("the compiled library is not found: only what the add-on itself knows was checked")
    elif not findings.errors:
        try:
            with to_asset(whole.document) as asset:
                check(asset, "", findings, whole.locator)
        except sbfmt.Error as error:
            findings.error(str(error))
    return findings


class SBFMT_OT_check(bpy.types.Operator):
    """Look for what is wrong with the character, and list it"""

    bl_idname = "sbfmt.check"
    bl_label = "Check"
    bl_options = {"REGISTER"}

    def execute(self, context):
        settings, found = context.scene.soft_body_format, find(context)
        settings.findings.clear()
        for one in found:
            entry = settings.findings.add()
            for name in ("severity", "message", "object_name", "bone_name", "code"):
                setattr(entry, name, getattr(one, name))
            entry.vertices = " ".join(map(str, one.vertices))
        errors = len(found.errors)
        self.report({"WARNING" if errors else "INFO"}, f"{errors} errors, {len(found) - errors} other messages" if found
                    else "nothing is wrong")
        return {"FINISHED"}


class SBFMT_OT_select_finding(bpy.types.Operator):
    """Select the vertices, the bone or the object that the message is about"""

    bl_idname = "sbfmt.select_finding"
    bl_label = "Select what is meant"
    bl_options = {"REGISTER", "UNDO"}

    index: IntProperty(options={"HIDDEN"})

    def execute(self, context):
        finding = context.scene.soft_body_format.findings[self.index]
        source = context.view_layer.objects.get(finding.object_name)
        if source is None:
            self.report({"INFO"}, "the message is about no object of this scene")
            return {"CANCELLED"}
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.object.select_all(action="DESELECT")
        source.select_set(True)
        context.view_layer.objects.active = source
        if finding.bone_name and source.type == "ARMATURE":
            source.data.bones.active = source.data.bones.get(finding.bone_name)
        elif finding.vertices:
            self.select_vertices(source, [int(word) for word in finding.vertices.split()])
        return {"FINISHED"}

    @staticmethod
    def select_vertices(source, vertices):
        mesh, chosen = source.data, set(vertices)
        mesh.polygons.foreach_set("select", [False] * len(mesh.polygons))
        mesh.edges.foreach_set("select", [False] * len(mesh.edges))
        mesh.vertices.foreach_set("select", [vertex.index in chosen for vertex in mesh.vertices])
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_mode(type="VERT")


class SBFMT_UL_findings(bpy.types.UIList):
    """One message a line."""

    ICONS = {"ERROR": "CANCEL", "WARNING": "ERROR", "INFO": "INFO"}

    def draw_item(self, _context, layout, _data, item, _icon, _active_data, _active_name, index):
        place = item.object_name + (f", {item.bone_name}" if item.bone_name else "")
        layout.label(text=f"{place}: {item.message}" if place else item.message, icon=self.ICONS.get(item.severity, "DOT"))
        if place:
            layout.operator(SBFMT_OT_select_finding.bl_idname, text="", icon="RESTRICT_SELECT_OFF").index = index


class SBFMT_PT_check(bpy.types.Panel):
    bl_label = "Check and build"
    bl_parent_id = "SBFMT_PT_scene"
    bl_space_type, bl_region_type, bl_context = "PROPERTIES", "WINDOW", "scene"
    bl_order = -1

    def draw(self, context):
        layout, settings = self.layout, context.scene.soft_body_format
        row = layout.row()
        row.operator(SBFMT_OT_check.bl_idname, icon="CHECKMARK")
        row.operator("sbfmt.build", icon="MESH_ICOSPHERE")
        layout.template_list("SBFMT_UL_findings", "", settings, "findings", settings, "active_finding", rows=4)
        if settings.active_finding < len(settings.findings):
            column = layout.column(align=True)
            for line in wrapped(settings.findings[settings.active_finding].message):
                column.label(text=line)
        layout.prop(settings, "show_overlay")


def wrapped(text, width=60):
    """Blender's labels don't wrap."""
    lines = [""]
    for word in text.split():
        if len(lines[-1]) + len(word) > width:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return lines


CLASSES = (SBFMT_OT_check, SBFMT_OT_select_finding, SBFMT_UL_findings, SBFMT_PT_check)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)


def unregister():
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
