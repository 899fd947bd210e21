"""Scene > Soft body format > Check: lists the messages of an export. A click on a message selects its object, bone or vertices."""

import time

import bpy
from bpy.props import IntProperty

from .. import sbfmt
from ..findings import Findings
from ..finishing import check, has_library, repair_reporter, to_asset
from ..repairs import repair_of
from ..to_document import Options
from ..whole import write_whole
from .exception_reports import report_exceptions

COLUMNS = ("severity", "message", "object_name", "bone_name", "code", "vertices")  # of the list


def find(context):
    """Checks the scene and writes nothing."""
    findings = Findings()
    whole = write_whole(context, Options(textures="EMBED"), findings)
    if not has_library():
        findings.info(f"only what the add-on itself knows was checked: the compiled library {sbfmt.library_fault()}")
    elif not findings.errors:
        try:
            repaired = repair_reporter(findings, whole.locator) if context.scene.soft_body_format.repairs_files else None
            with to_asset(whole.document, repaired) as asset:
                check(asset, "", findings, whole.locator)
            findings[:] = [one for one in findings if one.code != "DERIVED_STALE"]  # an export builds the derived parts again
        except sbfmt.Error as error:
            findings.error(str(error))
    return findings


def put_in_list(settings, found):
    """Replaces the scene's list of messages if the new messages differ."""
    lines = [(one.severity, one.message, one.object_name, one.bone_name, one.code, " ".join(map(str, one.vertices))) for one in found]
    if lines != [tuple(getattr(entry, name) for name in COLUMNS) for entry in settings.findings]:
        settings.findings.clear()
        for line in lines:
            entry = settings.findings.add()
            for name, value in zip(COLUMNS, line):
                setattr(entry, name, value)


def show(scene, findings_of):
    """Fills the scene's list of messages and stores how long the check took."""
    settings, began = scene.soft_body_format, time.monotonic()
    found = findings_of()
    put_in_list(settings, found)
    settings.is_checked, settings.check_time = True, time.monotonic() - began
    return found


class SBFMT_OT_check(bpy.types.Operator):
    """Check the character and list what is wrong"""

    bl_idname = "sbfmt.check"
    bl_label = "Check"
    bl_options = {"REGISTER"}

    @report_exceptions
    def execute(self, context):
        found = show(context.scene, lambda: find(context))
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


class SBFMT_OT_repair(bpy.types.Operator):
    """Repair this, if there is one right answer, and check again"""

    bl_idname = "sbfmt.repair"
    bl_label = "Repair"
    bl_options = {"REGISTER", "UNDO"}

    index: IntProperty(options={"HIDDEN"}, description="Index of the message; -1: every message that has a repair")

    @classmethod
    def description(cls, context, properties):
        settings = context.scene.soft_body_format
        if 0 <= properties.index < len(settings.findings):
            repair = repair_of(settings.findings[properties.index], settings.repairs_files)
            if repair is not None:
                return f"{repair.label}, and check again"
        return "Repair everything that has one right answer, and check again"

    @report_exceptions
    def execute(self, context):
        settings, done = context.scene.soft_body_format, set()
        chosen = [one for index, one in enumerate(settings.findings) if self.index in (-1, index)]
        for finding in chosen:
            repair = repair_of(finding, settings.repairs_files)
            if repair is None:
                continue
            source = context.scene.objects.get(finding.object_name)
            what = (repair.label, finding.object_name, finding.bone_name)
            if repair.act is None:
                settings.repairs_files = True
            elif source is None or source.library is not None:
                self.report({"WARNING"}, f"{finding.object_name} is linked from another file: repair it in that file")
                continue
            elif what not in done:
                repair.act(source, finding.bone_name)
            done.add(what)
        if not done:
            self.report({"INFO"}, "no message has one right answer: see what the messages advise")
            return {"CANCELLED"}
        found = "; ".join(f"{name}: {label.lower()}" if name else label for label, name, _ in sorted(done))
        bpy.ops.sbfmt.check()
        self.report({"INFO"}, found)
        return {"FINISHED"}


CLASSES = (SBFMT_OT_check, SBFMT_OT_select_finding, SBFMT_OT_repair)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
