"""Scene > Soft body format > Build: builds the character in the background, then draws the result over it."""

import bpy

from ..building import build_in_steps
from ..findings import Findings
from ..overlay import structure
from ..settings.build_settings import build_arguments
from ..space import Space
from ..to_document import Options
from ..whole import write_whole
from .working import Refused, WithLibrary


def built_scene(operator, context, change=None):
    """A generator like `build_in_steps` that returns (Built, Whole) of the scene. `change` may change the document first."""
    findings = Findings()
    whole = write_whole(context, Options(textures="EMBED"), findings)
    if findings.errors:
        findings.show(operator)
        raise Refused
    if change is not None:
        change(whole)
    scene = context.scene
    built = yield from build_in_steps(whole.document, build_arguments(scene, Space.of_scene(scene).unit_m),
                                      scene.soft_body_format.repairs_files)
    return built, whole


class SBFMT_OT_build(WithLibrary, bpy.types.Operator):
    """Cut the sections, make lattices and springs, and draw them over the model. Escape cancels"""

    bl_idname = "sbfmt.build"
    bl_label = "Build"
    instead = "sbfmt build"

    def work(self, context):
        built, _ = yield from built_scene(self, context)
        structure.show(context.scene, built.document)
        self.report({"INFO"}, structure.summary(context.scene))


def register():
    bpy.utils.register_class(SBFMT_OT_build)


def unregister():
    bpy.utils.unregister_class(SBFMT_OT_build)
