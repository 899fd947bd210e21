"""Scene > Soft body format > Check: what an export would say, as a list; a click selects what it is about."""

import time

import bpy
from bpy.props import IntProperty

from .. import sbfmt
from ..findings import Findings
from ..finishing import check, has_library, mender, to_asset
from ..mending import mend_of
from ..to_document import Options
from ..whole import write_whole
from .own_faults import told

COLUMNS = ("severity", "message", "object_name", "bone_name", "code", "vertices")  # of the list


def find(context):
    """What is wrong with the scene, without writing anything."""
    findings = Findings()
    whole = write_whole(context, Options(textures="EMBED"), findings)
    if not has_library():
        findings.info(f"only what the add-on itself knows was checked: the compiled library {sbfmt.library_fault()}")
    elif not findings.errors:
        try:
            mended = mender(findings, whole.locator) if context.scene.soft_body_format.mends_files else None
            with to_asset(whole.document, mended) as asset:
                check(asset, "", findings, whole.locator)
            findings[:] = [one for one in findings if one.code != "DERIVED_STALE"]  # what is written is built anew
        except sbfmt.Error as error:
            findings.error(str(error))
    return findings


def put_in_list(settings, found):
    """What is found becomes the scene's list, where it differs from what stands there."""
    lines = [(one.severity, one.message, one.object_name, one.bone_name, one.code, " ".join(map(str, one.vertices))) for one in found]
    if lines != [tuple(getattr(entry, name) for name in COLUMNS) for entry in settings.findings]:
        settings.findings.clear()
        for line in lines:
            entry = settings.findings.add()
            for name, value in zip(COLUMNS, line):
                setattr(entry, name, value)


def show(scene, findings_of):
    """Puts what is found into the scene's list; and how long the search took."""
    settings, began = scene.soft_body_format, time.monotonic()
    found = findings_of()
    put_in_list(settings, found)
    settings.is_checked, settings.check_time = True, time.monotonic() - began
    return found


class SBFMT_OT_check(bpy.types.Operator):
    """Look for what is wrong with the character, and list it"""

    bl_idname = "sbfmt.check"
    bl_label = "Check"
    bl_options = {"REGISTER"}

    @told
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


class SBFMT_OT_mend(bpy.types.Operator):
    """Mend this, where there is one right answer, and check again"""

    bl_idname = "sbfmt.mend"
    bl_label = "Mend"
    bl_options = {"REGISTER", "UNDO"}

    index: IntProperty(options={"HIDDEN"}, description="Of the message; -1: all that can be mended")

    @classmethod
    def description(cls, context, properties):
        settings = context.scene.soft_body_format
        if 0 <= properties.index < len(settings.findings):
            mend = mend_of(settings.findings[properties.index], settings.mends_files)
            if mend is not None:
                return f"{mend.label}, and check again"
        return "Mend all that has one right answer, and check again"

    @told
    def execute(self, context):
        settings, done = context.scene.soft_body_format, set()
        chosen = [one for index, one in enumerate(settings.findings) if self.index in (-1, index)]
        for finding in chosen:
            mend = mend_of(finding, settings.mends_files)
            if mend is None:
                continue
            source = context.scene.objects.get(finding.object_name)
            what = (mend.label, finding.object_name, finding.bone_name)
            if mend.act is None:
                settings.mends_files = True
            elif source is None or source.library is not None:
                self.report({"WARNING"}, f"{finding.object_name} is not this file's to change: mend it where it is linked from")
                continue
            elif what not in done:
                mend.act(source, finding.bone_name)
            done.add(what)
        if not done:
            self.report({"INFO"}, "nothing of it has one right answer: see what the messages say")
            return {"CANCELLED"}
        found = "; ".join(f"{name}: {label.lower()}" if name else label for label, name, _ in sorted(done))
        bpy.ops.sbfmt.check()
        self.report({"INFO"}, found)
        return {"FINISHED"}


CLASSES = (SBFMT_OT_check, SBFMT_OT_select_finding, SBFMT_OT_mend)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
