"""File > Import > Soft body format."""

import os

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ImportHelper

from .. import sbfmt
from ..findings import Findings
from ..finishing import has_library
from ..from_document import SceneMaker
from ..sbfmt.document import from_xml
from .exception_reports import report_exceptions


def read_document(path):
    """The document of a file; by the library, which checks it, where there is one."""
    if has_library():
        with sbfmt.load(path) as asset:
            return from_xml(asset.to_xml())
    if path.endswith((".sbfz", ".glb")):
        raise ValueError(f"{os.path.splitext(path)[1]} files need the compiled library. It {sbfmt.library_fault()}. Or run sbfmt unpack "
                         f"{os.path.basename(path)} -o FILE.sbf, and import that")
    with open(path, "rb") as file:
        return from_xml(file.read())


class IMPORT_SCENE_OT_soft_body_format(bpy.types.Operator, ImportHelper):
    """Open a soft body bundle: meshes, armature, pins, joints and gait"""

    bl_idname = "import_scene.soft_body_format"
    bl_label = "Import soft body format"
    bl_options = {"UNDO"}

    filename_ext = ".sbf"
    filter_glob: StringProperty(default="*.sbf;*.sbfz;*.glb", options={"HIDDEN"})

    @report_exceptions
    def execute(self, context):
        findings = Findings()
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            document = read_document(self.filepath)
        except (sbfmt.Error, ValueError, SyntaxError) as error:
            self.report({"ERROR"}, f"{os.path.basename(self.filepath)}: {error}")
            return {"CANCELLED"}
        except OSError as error:
            self.report({"ERROR"}, f"{self.filepath} can't be read: {error.strerror}; check the path and its permissions")
            return {"CANCELLED"}
        name = document.info.title or os.path.splitext(os.path.basename(self.filepath))[0]
        SceneMaker(context, document, name, os.path.dirname(os.path.abspath(self.filepath)), findings).make()
        findings.show(self)
        return {"FINISHED"}


def menu(self, _context):
    self.layout.operator(IMPORT_SCENE_OT_soft_body_format.bl_idname, text="Soft body format (.sbf, .sbfz, .glb)")


def register():
    bpy.utils.register_class(IMPORT_SCENE_OT_soft_body_format)
    bpy.types.TOPBAR_MT_file_import.append(menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(menu)
    bpy.utils.unregister_class(IMPORT_SCENE_OT_soft_body_format)
