"""Writes one QuadMesh under a skin as a GLB. Same input, same bytes. Python 3 standard library only."""

import json
import struct

from model_files import Buffer, bone_frame, float32, limits_extras, quaternion
from quad_mesh import cross, dot, sub


def smooth_weights(points, bones, reach, max_bones=4, min_weight=0.02):
    """For each point [(bone, weight)]: shares of the bones' lines, falling off with the distance d as
    (1 + (d / reach)^2)^-4; of `max_bones` bones at most, those above `min_weight`, summing to one."""
    def distance(point, bone):
        offset, along = sub(point, bone.head), sub(bone.tail, bone.head)
        t = min(max(dot(offset, along) / dot(along, along), 0.0), 1.0)
        off = tuple(w - t * a for w, a in zip(offset, along))
        return dot(off, off) ** 0.5

    weights = []
    for point in points:
        near = min(distance(point, bone) for bone in bones)
        influences = [((1.0 + ((distance(point, bone) - near) / reach) ** 2) ** -4, i) for i, bone in enumerate(bones)]
        influences = sorted(influences, key=lambda influence: (-influence[0], influence[1]))[:max_bones]
        total = sum(influence for influence, _ in influences)
        kept = [(i, influence / total) for influence, i in influences if influence / total >= min_weight]
        total = sum(influence for _, influence in kept)
        weights.append([(i, round(influence / total, 5)) for i, influence in kept])
    return weights


def planted(points, bones, weights, height):
    """The weights, but what is lower than `height` follows one bone alone, of those it follows the one that ends
    lowest, of two equally low the one it follows more: soles that do not knead as the leg above them turns. From there to
    twice the height it passes into what it was."""
    result = []
    for point, entries in zip(points, weights):
        own = min(entries, key=lambda bone: (bones[bone[0]].tail[1], -bone[1]))[0]
        rest = min(max(point[1] / height - 1.0, 0.0), 1.0)
        influence = {i: w * rest for i, w in entries if i != own and w * rest >= 0.005}
        influence[own] = 1.0 - sum(influence.values())
        result.append([(i, round(w, 5)) for i, w in sorted(influence.items(), key=lambda s: (-s[1], s[0]))])
    return result


def triangles_of(points):
    """A polygon as a fan of triangles: from the corner that leaves the smallest of them largest, of a quad the first."""
    count = len(points)

    def fan(start):
        return [(start + k) % count for i in range(1, count - 1) for k in (0, i, i + 1)]

    def smallest_angle(order):
        normals = [cross(sub(points[b], points[a]), sub(points[c], points[a]))
                   for a, b, c in zip(order[::3], order[1::3], order[2::3])]
        return round(min(dot(n, n) for n in normals), 20)

    return fan(0) if count <= 4 else max(map(fan, range(count)), key=smallest_angle)


def skinned_glb_bytes(armature, bones, mesh, weights, materials, title, licence):
    """A GLB of the mesh as triangles, skinned to the bones; `weights` as smooth_weights gives them. A vertex is stored
    once for each texture coordinate it has, as glTF wants it: those in one place are one point of the surface."""
    buffer, nodes = Buffer(), [{"name": armature, "children": []}]
    by_name = {bone.name: bone for bone in bones}
    matrices, frame_of = [], {None: ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))}
    for bone in bones:
        frame = frame_of[bone.name] = frame_of[bone.parent] if bone.tail is None else bone_frame(bone)
        parent, outer = by_name.get(bone.parent), frame_of[bone.parent]
        offset = tuple(dot(axis, sub(bone.head, parent.head if parent else (0.0, 0.0, 0.0))) for axis in outer)
        basis = tuple(tuple(dot(axis, column) for axis in outer) for column in frame)
        nodes.append({"name": bone.name, "translation": [float32(round(c, 7)) for c in offset],
                      "rotation": [float32(c if abs(c) > 1e-9 else 0.0) for c in quaternion(basis)]})
        if bone.limits:
            nodes[-1]["extras"] = limits_extras(bone)
        owner = nodes[1 + [b.name for b in bones].index(bone.parent)] if parent else nodes[0]
        owner.setdefault("children", []).append(len(nodes) - 1)
        # columns of the inverse of the bone's rest transform
        matrices.append(tuple(c for k in range(3) for c in (frame[0][k], frame[1][k], frame[2][k], 0.0))
                        + tuple(-dot(axis, bone.head) for axis in frame) + (1.0,))
    normals, index_of_material = mesh.normals(), {m.name: i for i, m in enumerate(materials)}
    primitives = []
    for material in materials:
        vertex_of, rows, indices = {}, [], []
        for face in mesh.faces:
            if face.material != material.name:
                continue
            corners = []
            for c, uv in zip(face.corners, face.uvs):
                key = (c, f"{uv[0]:.5f} {uv[1]:.5f}")
                if key not in vertex_of:
                    vertex_of[key] = len(rows)
                    rows.append((c, uv))
                corners.append(vertex_of[key])
            indices += [(corners[i],) for i in triangles_of([mesh.points[c] for c in face.corners])]
        entries = [weights[c] + [(0, 0.0)] * (4 - len(weights[c])) for c, _ in rows]
        primitives.append({
            "attributes": {"POSITION": buffer.put([mesh.points[c] for c, _ in rows], "VEC3", "f", bounds=True),
                           "NORMAL": buffer.put([normals[c] for c, _ in rows], "VEC3", "f"),
                           "TEXCOORD_0": buffer.put([(round(u, 5), round(1.0 - v, 5)) for _, (u, v) in rows], "VEC2", "f"),
                           "JOINTS_0": buffer.put([tuple(i for i, _ in h) for h in entries], "VEC4", "H"),
                           "WEIGHTS_0": buffer.put([tuple(w for _, w in h) for h in entries], "VEC4", "f")},
            "indices": buffer.put(indices, "SCALAR", "H"), "material": index_of_material[material.name]})
    inverse = buffer.put(matrices, "MAT4", "f")
    del buffer.views[-1]["target"]
    nodes[0]["children"].append(len(nodes))
    nodes.append({"name": mesh.name, "mesh": 0, "skin": 0})
    document = {
        "asset": {"version": "2.0", "generator": "sbfmt examples/modelling", "copyright": licence,
                  "extras": {"title": title}},
        "scene": 0, "scenes": [{"name": armature, "nodes": [0]}], "nodes": nodes,
        "meshes": [{"name": mesh.name, "primitives": primitives}],
        "skins": [{"joints": list(range(1, 1 + len(bones))), "inverseBindMatrices": inverse}],
        "materials": [{"name": m.name, "pbrMetallicRoughness": {
            "baseColorFactor": list(m.colour) + [1.0], "metallicFactor": 0.0, "roughnessFactor": m.roughness}}
            for m in materials],
        "accessors": buffer.accessors, "bufferViews": buffer.views, "buffers": [{"byteLength": len(buffer.data)}]}
    text = json.dumps(document, separators=(",", ":")).encode("ascii")
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(buffer.data)
    return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(buffer.data), b"BIN\0") + bytes(buffer.data))
