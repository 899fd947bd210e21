"""In Blender: the points of a Mesh Cache modifier at a frame of a point cache, as JSON in a file: positions in the cache's axes."""

import json
import sys

import bpy

path, count, frame, mode, out = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = 30
mesh = bpy.data.meshes.new("points")
mesh.from_pydata([(0, 0, 0)] * int(count), [], [])
shown = bpy.data.objects.new("points", mesh)
bpy.context.scene.collection.objects.link(shown)
cache = shown.modifiers.new("cache", "MESH_CACHE")
cache.cache_format = "MDD" if path.endswith(".mdd") else "PC2"
cache.filepath = path
cache.time_mode = mode
cache.frame_start = 0
cache.forward_axis, cache.up_axis = "POS_Z", "NEG_Y"  # it turns them the other way round
bpy.context.scene.frame_set(int(frame))
moved = shown.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
with open(out, "w", encoding="utf-8") as stream:
    json.dump([[vertex.co.x, vertex.co.z, -vertex.co.y] for vertex in moved.vertices], stream)
