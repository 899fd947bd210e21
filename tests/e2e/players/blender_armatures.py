"""In Blender: characters with armatures that are scaled, turned, below others or shared, saved as glTF in a frame of their clip, some
by way of FBX. Writes to a folder. The JSON lists, for each file, the position of every vertex at rest and in that frame, in glTF's axes."""

import json
import math
import os
import sys

import bpy
import numpy

if "bool" not in vars(numpy):
    numpy.bool = bool  # Blender 3.4's importer asks for what newer versions of numpy have not

folder, out = sys.argv[sys.argv.index("--") + 1:]
FRAME = 8


def tube(name, low, high, radius):
    rings, sides = 7, 8
    points = [(radius * math.cos(2 * math.pi * s / sides), radius * math.sin(2 * math.pi * s / sides),
               low + (high - low) * r / (rings - 1)) for r in range(rings) for s in range(sides)]
    faces = [(r * sides + s, r * sides + (s + 1) % sides, (r + 1) * sides + (s + 1) % sides, (r + 1) * sides + s)
             for r in range(rings - 1) for s in range(sides)]
    faces += [tuple(range(sides))[::-1], tuple((rings - 1) * sides + s for s in range(sides))]
    data = bpy.data.meshes.new(name)
    data.from_pydata(points, [], faces)
    made = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(made)
    return made


def armature(unit):
    """Three bones of 0.6 units one above the other, that bend in the course of 16 frames."""
    made = bpy.data.objects.new("Armature", bpy.data.armatures.new("Armature"))
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    bpy.ops.object.mode_set(mode="EDIT")
    below = None
    for i in range(3):
        bone = made.data.edit_bones.new(f"bone{i}")
        bone.head, bone.tail, bone.parent = (0, 0, 0.6 * i * unit), (0, 0, 0.6 * (i + 1) * unit), below
        below = bone
    bpy.ops.object.mode_set(mode="OBJECT")
    for i, bone in enumerate(made.pose.bones):
        bone.rotation_mode = "XYZ"
        for frame, angle in ((1, 0), (16, 0.5 * (i + 1))):
            bone.rotation_euler = (angle, 0, angle / 3)
            bone.keyframe_insert("rotation_euler", frame=frame)
    return made


def skin(mesh, rig, unit, child):
    for i in range(3):
        group = mesh.vertex_groups.new(name=f"bone{i}")
        for vertex in mesh.data.vertices:
            at = min(max(vertex.co.z / (0.6 * unit) - 0.5, 0), 2)
            if abs(at - i) < 1:
                group.add([vertex.index], 1 - abs(at - i), "REPLACE")
    mesh.modifiers.new("Armature", "ARMATURE").object = rig
    if child:
        mesh.parent = rig
        mesh.matrix_parent_inverse = rig.matrix_world.inverted()


def character(turn=0.0, scale=1.0, parent=False, outside=False, second=False):
    unit = 1 / scale  # of the armature: the character is 1.8 m tall in any case
    rig = armature(unit)
    if parent:
        above = bpy.data.objects.new("Root", None)
        bpy.context.scene.collection.objects.link(above)
        above.location, above.rotation_euler, above.scale = (0.3, -0.2, 0.1), (0, 0, 0.7), (1.5, 1.5, 1.5)
        rig.parent = above
    rig.rotation_euler, rig.scale = (turn, 0, 0), (scale, scale, scale)
    bpy.context.view_layer.update()
    body = tube("body", 0, 1.8 * unit, 0.2 * unit)
    meshes = [body] + ([tube("hat", 1.7 * unit, 2 * unit, 0.3 * unit)] if second else [])
    for mesh in meshes:
        mesh.matrix_world = rig.matrix_world
        bpy.context.view_layer.update()
        skin(mesh, rig, unit, not outside)
    bpy.context.view_layer.update()


def through_fbx():
    path = os.path.join(folder, "way.fbx")
    bpy.ops.export_scene.fbx(filepath=path, add_leaf_bones=False)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.fbx(filepath=path)


def drawn():
    graph, found = bpy.context.evaluated_depsgraph_get(), {}
    for shown in bpy.data.objects:
        if shown.type == "MESH":
            evaluated = shown.evaluated_get(graph)
            points = [evaluated.matrix_world @ vertex.co for vertex in evaluated.to_mesh().vertices]
            found[shown.name] = [(p[0], p[2], -p[1]) for p in points]
    return found


def posed(position):
    for data in bpy.data.armatures:
        data.pose_position = position
    bpy.context.view_layer.update()
    return drawn()


CASES = {
    "plain": ({}, False), "scaled": ({"scale": 0.01}, False), "turned": ({"turn": math.pi / 2, "scale": 0.01}, False),
    "below": ({"parent": True, "scale": 0.5}, False), "outside": ({"outside": True, "scale": 2}, False),
    "two": ({"second": True, "turn": -math.pi / 2, "scale": 0.01}, False),
    "fbx": ({}, True), "fbx_two": ({"second": True, "parent": True}, True), "fbx_outside": ({"outside": True}, True),
}
expected = {}
for name, (settings, by_fbx) in CASES.items():
    for frame in (1, FRAME):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        character(**settings)
        if by_fbx:
            through_fbx()
        bpy.context.scene.frame_set(frame)
        rest, now = posed("REST"), posed("POSE")
        file = f"{name}_{frame}.glb"
        bpy.ops.export_scene.gltf(filepath=os.path.join(folder, file), export_current_frame=True)
        expected[file] = {"rest": rest, "now": now, "is_posed": frame == FRAME}
with open(out, "w", encoding="utf-8") as stream:
    json.dump(expected, stream)
