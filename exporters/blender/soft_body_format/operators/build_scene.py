"""Scene > Soft body format > Build: what the library makes of the character, in the background, and then drawn over it."""

import threading

import bpy

from .. import sbfmt
from ..findings import Findings
from ..finishing import has_library, to_asset
from ..overlay import structure
from ..sbfmt.document import from_xml
from ..to_document import Options, SceneWriter


class BuildJob:
    """One build in a thread of its own. Blender is not touched there; `progress` and `cancelled` are all that both sides know."""

    def __init__(self, document):
        self.document, self.built, self.error = document, None, None
        self.progress, self.passed, self.cancelled = 0.0, "", False
        self.thread = threading.Thread(target=self.run, daemon=True)

    def start(self):
        self.thread.start()

    @property
    def is_running(self):
        return self.thread.is_alive()

    def run(self):
        try:
            with to_asset(self.document) as source, source.build(progress=self.hear) as made:
                self.built = from_xml(made.to_xml())
        except (sbfmt.Error, OSError) as error:
            self.error = error

    def hear(self, name, share):
        self.passed, self.progress = name, share
        return not self.cancelled


class SBFMT_OT_build(bpy.types.Operator):
    """Cut the sections, make lattices and springs, and draw them over the model. Escape cancels"""

    bl_idname = "sbfmt.build"
    bl_label = "Build"

    job = None

    @classmethod
    def poll(cls, _context):
        return has_library()

    def begin(self, context):
        findings = Findings()
        document = SceneWriter(context, Options(textures="EMBED"), findings).write()
        if findings.errors:
            findings.show(self)
            return False
        self.job = BuildJob(document)
        self.job.start()
        return True

    def execute(self, context):
        """Without a window there is nothing to wait beside."""
        if not self.begin(context):
            return {"CANCELLED"}
        self.job.thread.join()
        return self.finish(context)

    def invoke(self, context, _event):
        if not self.begin(context):
            return {"CANCELLED"}
        manager = context.window_manager
        manager.progress_begin(0, 100)
        self.timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.job.cancelled = True
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        context.window_manager.progress_update(100 * self.job.progress)
        context.workspace.status_text_set(f"Building: {self.job.passed} {self.job.progress:.0%}. Escape cancels")
        if self.job.is_running:
            return {"RUNNING_MODAL"}
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        return self.finish(context)

    def finish(self, context):
        if isinstance(self.job.error, sbfmt.Cancelled):
            self.report({"INFO"}, "the build was cancelled; nothing has changed")
            return {"CANCELLED"}
        if self.job.error is not None:
            self.report({"ERROR"}, str(self.job.error))
            return {"CANCELLED"}
        structure.show(context.scene, self.job.built)
        self.report({"INFO"}, structure.summary(context.scene))
        return {"FINISHED"}


def register():
    bpy.utils.register_class(SBFMT_OT_build)


def unregister():
    bpy.utils.unregister_class(SBFMT_OT_build)
