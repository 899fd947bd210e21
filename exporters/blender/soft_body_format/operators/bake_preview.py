"""Scene > Soft body format > Preview > Bake: writes the preview's motion to point caches or shape keys."""

import os

import bpy
import numpy
from bpy.props import IntProperty

from ..preview import baked, copies, handlers
from ..preview.point_cache import CacheWriter
from ..space import frame_rate
from .preview_scene import previewed_scene
from .working import Refused, WithLibrary


class CacheTake:
    """Writes each object's points in every frame, in the object's space. Objects without points that a modifier can move play as
    copies; their points are in world space."""

    def __init__(self, scene, stage, folder, ending, samples):
        self.scene, self.stage, self.folder, self.ending, self.samples = scene, stage, folder, ending, samples
        self.start, self.writers = scene.frame_current, {}
        os.makedirs(folder, exist_ok=True)

    def take(self, actor, positions, _frame):
        name = actor.source
        if name not in self.writers:
            path = os.path.join(self.folder, bpy.path.clean_name(name) + self.ending)
            self.writers[name] = CacheWriter(path, len(positions), self.samples, self.start, frame_rate(self.scene))
        if self.stage.has_points(actor):
            inverse = numpy.array(self.scene.objects[name].matrix_world.inverted_safe())
            positions = positions @ inverse[:3, :3].T + inverse[:3, 3]
        self.writers[name].write(positions)

    def finish(self, context):
        others = [actor for actor in self.stage.actors if not self.stage.has_points(actor)]
        players = baked.add_copies(context, self.stage, others) if others else {}
        for name, writer in self.writers.items():
            writer.close()
            baked.add_modifier(players.get(name) or self.scene.objects[name], writer.path, self.start)
        return f"{len(self.writers)} objects play from {self.folder}"

    def drop(self):
        for writer in self.writers.values():
            writer.drop()


class KeyTake:
    """Keeps every n-th frame and the last one for shape keys of copies."""

    def __init__(self, stage, start, end, every):
        self.stage = stage
        self.frames = [frame for frame in range(start, end + 1) if (frame - start) % every == 0 or frame == end]
        self.recorded = {}

    def take(self, actor, positions, frame):
        if frame in self.frames:
            self.recorded.setdefault(actor.source, []).append(positions)

    def finish(self, context):
        for name, made in baked.add_copies(context, self.stage, self.stage.actors).items():
            baked.add_keys(made, self.recorded[name], self.frames)
        return f"{len(self.recorded)} copies with {len(self.frames)} shape keys each are in the collection {baked.NAME}"

    def drop(self):
        self.recorded = {}


class SBFMT_OT_bake(WithLibrary, bpy.types.Operator):
    """Build the character, play it from start to end and keep its motion. Escape cancels"""

    bl_idname = "sbfmt.bake"
    bl_label = "Bake"
    bl_options = {"REGISTER", "UNDO"}
    instead = "sbfmt run --cache"

    @staticmethod
    def folder(settings):
        if settings.bake_folder.startswith("//") and not bpy.data.filepath:
            raise Refused("point caches are written beside the .blend, which is not saved yet: save it, or choose another folder")
        return os.path.normpath(bpy.path.abspath(settings.bake_folder))

    def work(self, context):
        scene, settings = context.scene, context.scene.soft_body_format.preview
        start, end = settings.bake_start, settings.bake_end
        if end < start:
            raise Refused(f"the bake ends (frame {end}) before it starts (frame {start}): exchange them")
        folder = self.folder(settings) if settings.bake_to != "SHAPE_KEYS" else ""
        kept, session, take, done = scene.frame_current, None, None, False
        handlers.stop()
        try:
            scene.frame_set(start)
            session, stage = yield from previewed_scene(self, context)
            take = KeyTake(stage, start, end, settings.key_every) if settings.bake_to == "SHAPE_KEYS" else \
                CacheTake(scene, stage, folder, f".{settings.bake_to.lower()}", end - start + 1)
            for frame in range(start, end + 1):
                if frame > start:
                    scene.frame_set(frame)
                    session.step(scene)
                for actor in stage.actors:
                    take.take(actor, session.points(actor), frame)
                yield "Baking:", (frame - start + 1) / (end - start + 1)
            report_exceptions = take.finish(context)
            done = True
            scene.frame_set(start)
            self.report({"INFO"}, report_exceptions)
        finally:
            if take is not None and not done:
                take.drop()
            if session is not None:
                session.close()
            if not done:
                scene.frame_set(kept)


class SBFMT_OT_bake_cut(bpy.types.Operator):
    """Keep only the frames from start to end of the bakes"""

    bl_idname = "sbfmt.bake_cut"
    bl_label = "Cut ends"
    bl_options = {"REGISTER", "UNDO"}

    start: IntProperty(name="Start", description="First frame to keep")
    end: IntProperty(name="End", description="Last frame to keep")

    @classmethod
    def poll(cls, _context):
        return bool(baked.modifiers() or baked.baked_copies())

    def invoke(self, context, _event):
        settings = context.scene.soft_body_format.preview
        self.start, self.end = settings.bake_start, settings.bake_end
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context):
        scene = context.scene
        if self.end < self.start:
            self.report({"ERROR"}, f"the end ({self.end}) is before the start ({self.start}): exchange them")
            return {"CANCELLED"}
        try:
            for _, modifier in baked.modifiers():
                baked.cut_modifier(modifier, self.start, self.end, frame_rate(scene))
        except (OSError, ValueError) as error:
            self.report({"ERROR"}, f"the cache can't be cut: {error}")
            return {"CANCELLED"}
        for made in baked.baked_copies():
            baked.cut_keys(made, self.start, self.end)
        scene.soft_body_format.preview.bake_start, scene.soft_body_format.preview.bake_end = self.start, self.end
        return {"FINISHED"}


class SBFMT_OT_bake_free(bpy.types.Operator):
    """Remove the bakes: their modifiers and copies, not the files"""

    bl_idname = "sbfmt.bake_free"
    bl_label = "Free"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, _context):
        return bool(baked.modifiers() or baked.baked_copies())

    def execute(self, _context):
        for source, modifier in baked.modifiers():
            source.modifiers.remove(modifier)
        copies.strike(baked.NAME)
        return {"FINISHED"}


CLASSES = (SBFMT_OT_bake, SBFMT_OT_bake_cut, SBFMT_OT_bake_free)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
