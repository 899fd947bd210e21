"""Scene > Soft body format > Preview > Bake: the preview's motion as point caches or shape keys."""

import os

import bpy
import numpy
from bpy.props import IntProperty

from ..finishing import has_library
from ..preview import baked, handlers
from ..preview.point_cache import CacheWriter
from .preview_scene import previewed_scene
from .working import Refused, Working


class CacheTake:
    """Writes each object's points, in its own space, as the frames pass."""

    def __init__(self, scene, folder, ending, samples):
        self.scene, self.folder, self.ending, self.samples = scene, folder, ending, samples
        self.start, self.writers = scene.frame_current, {}
        os.makedirs(folder, exist_ok=True)

    def take(self, name, places, _frame):
        source = self.scene.objects[name]
        if name not in self.writers:
            path = os.path.join(self.folder, bpy.path.clean_name(name) + self.ending)
            self.writers[name] = CacheWriter(path, len(places), self.samples, self.start, self.scene.render.fps / self.scene.render.fps_base)
        inverse = numpy.array(source.matrix_world.inverted_safe())
        self.writers[name].write(places @ inverse[:3, :3].T + inverse[:3, 3])

    def finish(self, _context):
        for name, writer in self.writers.items():
            writer.close()
            baked.add_modifier(self.scene.objects[name], writer.path, self.start)
        return f"{len(self.writers)} objects play from {self.folder}"

    def drop(self):
        for writer in self.writers.values():
            writer.drop()


class KeyTake:
    """Keeps every n-th frame, and the last, for shape keys of copies."""

    def __init__(self, start, end, every):
        self.frames = [frame for frame in range(start, end + 1) if (frame - start) % every == 0 or frame == end]
        self.recorded = {}

    def take(self, name, places, frame):
        if frame in self.frames:
            self.recorded.setdefault(name, []).append(places)

    def finish(self, context):
        baked.add_copies(context, self.recorded, self.frames)
        return f"{len(self.recorded)} copies with {len(self.frames)} shapes each are in the collection {baked.NAME}"

    def drop(self):
        self.recorded = {}


class SBFMT_OT_bake(Working, bpy.types.Operator):
    """Build the character, play it from start to end and keep its motion. Escape cancels"""

    bl_idname = "sbfmt.bake"
    bl_label = "Bake"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, _context):
        if not has_library():
            cls.poll_message_set("The compiled library is not found: run sbfmt run --cache on the exported file")
            return False
        return True

    @staticmethod
    def folder(settings):
        if settings.bake_folder.startswith("//") and not bpy.data.filepath:
            raise Refused("point caches lie beside the .blend, which has no place yet: save it, or choose another folder")
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
            take = KeyTake(start, end, settings.key_every) if settings.bake_to == "SHAPE_KEYS" else \
                CacheTake(scene, folder, f".{settings.bake_to.lower()}", end - start + 1)
            actors = [actor for actor in stage.actors if actor.is_own]
            if len(actors) < len(stage.actors):
                self.report({"WARNING"}, "what collection instances show is not baked: make them real first (Object > Apply > Make "
                            "Instances Real)")
            for frame in range(start, end + 1):
                if frame > start:
                    scene.frame_set(frame)
                    session.step(scene)
                for actor in actors:
                    take.take(actor.source, session.points(actor), frame)
                yield "Baking:", (frame - start + 1) / (end - start + 1)
            told = take.finish(context)
            done = True
            scene.frame_set(start)
            self.report({"INFO"}, told)
        finally:
            if take is not None and not done:
                take.drop()
            if session is not None:
                session.close()
            if not done:
                scene.frame_set(kept)


class SBFMT_OT_bake_cut(bpy.types.Operator):
    """Keep no more of the bakes than the frames from start to end"""

    bl_idname = "sbfmt.bake_cut"
    bl_label = "Cut ends"
    bl_options = {"REGISTER", "UNDO"}

    start: IntProperty(name="Start", description="First frame that is kept")
    end: IntProperty(name="End", description="Last frame that is kept")

    @classmethod
    def poll(cls, _context):
        return bool(baked.modifiers() or baked.copies())

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
                baked.cut_modifier(modifier, self.start, self.end, scene.render.fps / scene.render.fps_base)
        except (OSError, ValueError) as error:
            self.report({"ERROR"}, f"the cache can't be cut: {error}")
            return {"CANCELLED"}
        for made in baked.copies():
            baked.cut_keys(made, self.start, self.end)
        scene.soft_body_format.preview.bake_start, scene.soft_body_format.preview.bake_end = self.start, self.end
        return {"FINISHED"}


class SBFMT_OT_bake_free(bpy.types.Operator):
    """Take the bakes away: their modifiers and copies, not the files"""

    bl_idname = "sbfmt.bake_free"
    bl_label = "Free"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, _context):
        return bool(baked.modifiers() or baked.copies())

    def execute(self, _context):
        for source, modifier in baked.modifiers():
            source.modifiers.remove(modifier)
        baked.free_copies()
        return {"FINISHED"}


CLASSES = (SBFMT_OT_bake, SBFMT_OT_bake_cut, SBFMT_OT_bake_free)

register, unregister = bpy.utils.register_classes_factory(CLASSES)
