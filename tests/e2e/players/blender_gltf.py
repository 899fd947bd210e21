"""In Blender: the meshes of a glTF file at a frame, as JSON in a file: for each mesh its vertices at rest and where they are then,
in the file's axes."""

import json
import sys

import bpy
import numpy

if "bool" not in vars(numpy):
    numpy.bool = bool  # Blender 3.4's importer asks for what newer versions of numpy have not

path, frame, out = sys.argv[sys.argv.index("--") + 1:]
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.context.scene.render.fps = 30
bpy.ops.import_scene.gltf(filepath=path)
bpy.context.scene.frame_set(int(frame))
graph = bpy.context.evaluated_depsgraph_get()


def in_file(v):
    return [v[0], v[2], -v[1]]


meshes = []
for shown in bpy.data.objects:
    if shown.type != "MESH":
        continue
    evaluated = shown.evaluated_get(graph)
    moved = evaluated.to_mesh()
    keys = shown.data.shape_keys
    meshes.append({
        "name": shown.data.name, "triangles": len(shown.data.polygons), "materials": len(shown.data.materials),
        "keys": len(keys.key_blocks) - 1 if keys else 0,
        "rest": [in_file(vertex.co) for vertex in shown.data.vertices],
        "now": [in_file(evaluated.matrix_world @ vertex.co) for vertex in moved.vertices]})
armatures = [one for one in bpy.data.objects if one.type == "ARMATURE"]
with open(out, "w", encoding="utf-8") as stream:
    json.dump({"meshes": meshes, "joints": sum(len(one.data.bones) for one in armatures)}, stream)
