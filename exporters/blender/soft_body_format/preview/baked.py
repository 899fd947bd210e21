"""Results of bakes in the scene: Mesh Cache modifiers that read point caches, or copies with shape keys. Cuts and removes them."""

import os

import bpy
import numpy

from ..space import Space
from . import copies
from .point_cache import cut_cache, read_cache
from .stage import rest_meshes

NAME = "Soft body bake"
KEY = "frame "


def key_name(frame):
    return f"{KEY}{frame:04d}"


# ---- Point caches ----

def add_modifier(source, path, start):
    """Adds the modifier last, so that the points end at the baked positions."""
    found = source.modifiers.get(NAME) or source.modifiers.new(NAME, "MESH_CACHE")
    found.cache_format = "MDD" if path.endswith(".mdd") else "PC2"
    found.filepath = bpy.path.relpath(path) if bpy.data.filepath else path
    found.time_mode, found.play_mode, found.interpolation = "FRAME", "SCENE", "LINEAR"
    found.frame_start, found.frame_scale = start, 1.0


def modifiers():
    """[(object, its modifier)] of all bakes."""
    return [(source, one) for source in bpy.data.objects for one in source.modifiers if one.name == NAME and one.type == "MESH_CACHE"]


def cut_modifier(modifier, start, end, rate):
    path = bpy.path.abspath(modifier.filepath)
    first, samples = round(modifier.frame_start), len(read_cache(path))
    start, end = max(start, first), min(end, first + samples - 1)
    stem, ending = os.path.splitext(path)
    new_path = f"{stem.split(' frames ')[0]} frames {start}-{end}{ending}"
    cut_cache(path, new_path, start - first, end - start + 1, start, rate)
    modifier.filepath = bpy.path.relpath(new_path) if bpy.data.filepath else new_path
    modifier.frame_start = start


# ---- Copies ----

def add_copies(context, stage, actors):
    """Makes a new object for each actor, in world space, and hides the actor's own: {actor's source: object}. Removes the objects of
    an earlier bake."""
    scene, layer = context.scene, context.view_layer
    meshes = rest_meshes(context, [scene.objects[actor.source] for actor in actors if stage.has_points(actor)])
    collection = copies.begin(scene, NAME)
    copies_of = {}
    for actor in actors:
        mesh = meshes.get(actor.source) or stage.mesh_of(actor, Space.of_scene(scene))
        made = bpy.data.objects.new(f"{actor.source} (baked)", mesh)
        copies_of[actor.source] = copies.add(collection, made, actor.source)
        if made.data.shape_keys is not None:
            made.shape_key_clear()
    copies.hide_originals(collection, scene, layer, sorted({actor.owner for actor in actors}))
    return copies_of


def add_keys(made, positions, frames):
    """Adds a shape key for each frame, with value 1 at the frame and 0 at the frames before and after."""
    made.shape_key_add(name="Basis", from_mix=False)
    for index, frame in enumerate(frames):
        block = made.shape_key_add(name=key_name(frame), from_mix=False)
        block.data.foreach_set("co", numpy.ascontiguousarray(positions[index], dtype=numpy.float32).ravel())
        for key, value in ((index - 1, 0.0), (index + 1, 0.0), (index, 1.0)):
            if 0 <= key < len(frames):
                block.value = value
                block.keyframe_insert("value", frame=frames[key])
    for curves in curve_lists(made.data.shape_keys):
        for curve in curves:
            for point in curve.keyframe_points:
                point.interpolation = "LINEAR"


def curve_lists(owner):
    """The lists of F-curves that animate it: one list before Blender 4.4, one per channel bag since."""
    action = owner.animation_data.action if owner.animation_data is not None else None
    if action is None:
        return []
    if hasattr(action, "layers") and len(action.layers):
        return [bag.fcurves for layer in action.layers for strip in layer.strips for bag in strip.channelbags]
    return [action.fcurves]


def baked_copies():
    collection = bpy.data.collections.get(NAME)
    return list(collection.objects) if collection is not None else []


def cut_keys(made, start, end):
    """Removes the shape keys of other frames, with their curves."""
    keys = made.data.shape_keys
    if keys is None:  # it plays a point cache
        return
    removed = [block.name for block in keys.key_blocks if block.name.startswith(KEY) and not start <= int(block.name[len(KEY):]) <= end]
    paths = {keys.key_blocks[name].path_from_id("value") for name in removed}
    for curves in curve_lists(keys):
        for curve in [one for one in curves if one.data_path in paths]:
            curves.remove(curve)
    for name in removed:
        made.shape_key_remove(keys.key_blocks[name])
