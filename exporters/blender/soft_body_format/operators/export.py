"""File > Export > Soft body format."""

import os

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty
from bpy_extras.io_utils import ExportHelper

from ..findings import Findings
from ..finishing import finish, refusal
from ..settings.build_settings import build_arguments
from ..to_document import Options
from ..whole import write_whole
from .check_scene import put_in_list
from .exception_reports import report_exceptions


class EXPORT_SCENE_OT_soft_body_format(bpy.types.Operator, ExportHelper):
    """Write the character to a file: meshes, rig, soft bodies, pins, limits and gait"""

    bl_idname = "export_scene.soft_body_format"
    bl_label = "Export soft body format"
    bl_options = {"PRESET"}

    filename_ext = ".sbf"
    check_extension = False
    filter_glob: StringProperty(default="*.sbf;*.sbfz;*.glb", options={"HIDDEN"})
    selected_only: BoolProperty(name="Selected Objects Only", description="Export selected objects only", default=False)
    collection: StringProperty(name="Collection", description="Export only the objects of this collection; empty: all", default="")
    apply_modifiers: BoolProperty(
        name="Apply Modifiers", default=True,
        description="Export meshes with their modifiers applied; armature and simulation modifiers are never applied")
    textures: EnumProperty(
        name="Textures", default="COPY",
        items=(("COPY", "Copy", "Copy image files into a folder `textures` beside the file"),
               ("EMBED", "Embed", "Put the images into the file; a .glb always has them")))
    build: BoolProperty(
        name="Build", default=True,
        description="Make sections, springs, lattices and embeddings too, so that the file is ready to run")

    def check(self, _context):
        name, ending = os.path.splitext(self.filepath)
        path = bpy.path.ensure_ext(name, ending if ending in (".sbfz", ".glb") else ".sbf")
        changed, self.filepath = path != self.filepath, path
        return changed

    def draw(self, _context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "selected_only")
        layout.prop_search(self, "collection", bpy.data, "collections")
        layout.prop(self, "apply_modifiers")
        layout.prop(self, "textures")
        layout.prop(self, "build")

    @report_exceptions
    def execute(self, context):
        findings = Findings()
        if self.collection and self.collection not in bpy.data.collections:
            self.report({"ERROR"}, f"there is no collection {self.collection}; choose one of the scene's, or none")
            return {"CANCELLED"}
        refused = refusal(self.filepath)
        if refused:
            self.report({"ERROR"}, refused)
            return {"CANCELLED"}
        textures = "EMBED" if self.filepath.endswith(".glb") else self.textures
        whole = write_whole(context, Options(self.selected_only, self.collection, self.apply_modifiers, textures), findings)
        arguments = build_arguments(context.scene, whole.writer.space.unit_m) if self.build and whole.changed else None
        written = not findings.errors and finish(whole.document, self.filepath, arguments, findings, whole.locator,
                                                 whole.writer.materials.files, context.scene.soft_body_format.repairs_files)
        put_in_list(context.scene.soft_body_format, findings)
        findings.show(self)
        if not written:
            return {"CANCELLED"}
        self.report({"INFO"}, f"{os.path.basename(self.filepath)} is written")
        return {"FINISHED"}


def menu(self, _context):
    self.layout.operator(EXPORT_SCENE_OT_soft_body_format.bl_idname, text="Soft body format (.sbf, .sbfz, .glb)")


def register():
    bpy.utils.register_class(EXPORT_SCENE_OT_soft_body_format)
    bpy.types.TOPBAR_MT_file_export.append(menu)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(menu)
    bpy.utils.unregister_class(EXPORT_SCENE_OT_soft_body_format)
