"""Writes QuadMesh sections as OBJ with MTL, and as a GLB whose nodes are the bones of a rig.

Same input, same bytes: no dates, no machine's paths, fixed digits. Python 3 standard library only.
"""

import json
import math
import struct
from collections import namedtuple

from quad_mesh import cross, dot, sub

# colour: linear base colour (r, g, b); roughness 0..1
Material = namedtuple("Material", "name colour roughness")

# head, tail: asset space, metres; axis: the direction of its local +X (made exactly right-angled to the bone); limits:
# {"swing_y": (min, max), "swing_z": (min, max), "twist": (min, max)} in radians, or None. A bone without tail is a bare
# end.
Bone = namedtuple("Bone", "name parent head tail axis limits", defaults=(None,))


def bone_frame(bone):
    """Columns x, y, z of the bone's rest rotation: +Y from head to tail, +X as near to bone.axis as that allows."""
    along = sub(bone.tail, bone.head)
    y = tuple(c / math.sqrt(dot(along, along)) for c in along)
    x = sub(bone.axis, tuple(c * dot(bone.axis, y) for c in y))
    x = tuple(c / math.sqrt(dot(x, x)) for c in x)
    return x, y, cross(x, y)


def quaternion(columns):
    """x, y, z, w of a rotation given by its columns, w >= 0."""
    (m00, m10, m20), (m01, m11, m21), (m02, m12, m22) = columns
    parts = [math.sqrt(max(0.0, 1.0 + a + b + c)) * 0.5
             for a, b, c in ((m00, -m11, -m22), (-m00, m11, -m22), (-m00, -m11, m22), (m00, m11, m22))]
    largest = max(range(4), key=lambda i: parts[i])
    four = 4.0 * parts[largest]
    x, y, z, w = (
        (parts[0], (m01 + m10) / four, (m02 + m20) / four, (m21 - m12) / four),
        ((m01 + m10) / four, parts[1], (m12 + m21) / four, (m02 - m20) / four),
        ((m02 + m20) / four, (m12 + m21) / four, parts[2], (m10 - m01) / four),
        ((m21 - m12) / four, (m02 - m20) / four, (m10 - m01) / four, parts[3]))[largest]
    sign = -1.0 if w < 0.0 else 1.0
    return [sign * c for c in (x, y, z, w)]


def limits_extras(bone):
    """A joint's limits as sbfmt reads them from the extras of a node."""
    return {"sbf_limits": {key: list(bone.limits[key]) for key in ("swing_y", "swing_z", "twist")}}


def float32(value):
    return struct.unpack("<f", struct.pack("<f", value))[0] + 0.0


def _decimals(values, digits):
    return " ".join(f"{v + 0.0:.{digits}f}" for v in values)


def obj_text(sections, material_file, title):
    """OBJ text: an `o` per section, quads kept, normals left to the reader (smooth group on)."""
    lines = [f"# {title}", "# metres, +Y up, +Z towards the head", f"mtllib {material_file}"]
    first_point = first_uv = 1
    for mesh in sections:
        lines.append(f"o {mesh.name}")
        lines += ["v " + _decimals(p, 6) for p in mesh.points]
        uv_index = {}
        for face in mesh.faces:
            for uv in face.uvs:
                uv_index.setdefault(_decimals(uv, 5), len(uv_index))
        lines += ["vt " + uv for uv in uv_index]
        lines.append("s 1")
        current = None
        for face in mesh.faces:
            if face.material != current:
                current = face.material
                lines.append(f"usemtl {current}")
            lines.append("f " + " ".join(f"{first_point + c}/{first_uv + uv_index[_decimals(uv, 5)]}"
                                         for c, uv in zip(face.corners, face.uvs)))
        first_point += len(mesh.points)
        first_uv += len(uv_index)
    return "\n".join(lines) + "\n"


def mtl_text(materials, title):
    """MTL text. Colours are linear, and roughness stands both as Pr and as the Ns that Blender reads and writes."""
    lines = [f"# {title}"]
    for m in materials:
        lines += [f"newmtl {m.name}", f"Ns {900.0 * (1.0 - m.roughness) ** 2:.2f}", "Kd " + _decimals(m.colour, 4),
                  "Ks 0.5000 0.5000 0.5000", f"Pr {m.roughness:.2f}", "Pm 0.00", "d 1.0", "illum 2"]
    return "\n".join(lines) + "\n"


class Buffer:
    def __init__(self):
        self.data, self.views, self.accessors = bytearray(), [], []

    def put(self, rows, kind, component, bounds=False):
        """Append a list of tuples as an accessor; component is a struct letter: f, H or I."""
        code = {"f": 5126, "H": 5123, "I": 5125}[component]
        flat = [c for row in rows for c in row]
        raw = struct.pack(f"<{len(flat)}{component}", *flat)
        target = 34963 if kind == "SCALAR" else 34962
        self.views.append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(raw), "target": target})
        self.data += raw + b"\0" * (-len(raw) % 4)
        accessor = {"bufferView": len(self.views) - 1, "componentType": code, "count": len(rows), "type": kind}
        if bounds:
            columns = list(zip(*rows))
            accessor["min"] = [float32(min(c)) for c in columns]
            accessor["max"] = [float32(max(c)) for c in columns]
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def glb_bytes(armature, bones, sections, bone_of_section, materials, title, licence):
    """A GLB: node `armature`, below it the bones, and each section's mesh node under its bone (no skin). Triangles, as
    glTF has nothing else; a vertex is shared wherever position, uv and material are the same. Limits go into the
    bone's extras."""
    buffer, nodes, meshes = Buffer(), [{"name": armature, "children": []}], []
    material_index = {m.name: i for i, m in enumerate(materials)}
    by_name = {b.name: b for b in bones}
    node_of, frame_of = {}, {}
    for bone in bones:
        parent = by_name.get(bone.parent)
        rotation = [0.0, 0.0, 0.0, 1.0]
        if bone.tail is None:
            frame_of[bone.name] = frame_of[bone.parent]
        else:
            frame_of[bone.name] = bone_frame(bone)
        if parent is None:
            offset, basis = bone.head, frame_of[bone.name]
        else:
            outer = frame_of[parent.name]
            offset = tuple(dot(axis, sub(bone.head, parent.head)) for axis in outer)
            basis = tuple(tuple(dot(axis, column) for axis in outer) for column in frame_of[bone.name])
        if bone.tail is not None:
            rotation = quaternion(basis)
        node = {"name": bone.name, "translation": [float32(round(c, 7)) for c in offset],
                "rotation": [float32(c if abs(c) > 1e-9 else 0.0) for c in rotation]}
        if bone.limits:
            node["extras"] = limits_extras(bone)
        node_of[bone.name] = len(nodes)
        owner = nodes[node_of[bone.parent] if parent else 0]
        owner.setdefault("children", []).append(len(nodes))
        nodes.append(node)
    for mesh in sections:
        bone = by_name[bone_of_section[mesh.name]]
        frame = frame_of[bone.name]
        normals = mesh.normals()

        def local(vector):
            return tuple(float32(dot(axis, vector)) for axis in frame)

        primitives = []
        for name in sorted({f.material for f in mesh.faces}, key=material_index.get):
            vertex_of, positions, directions, uvs, indices = {}, [], [], [], []
            for face in mesh.faces:
                if face.material != name:
                    continue
                corners = []
                for c, uv in zip(face.corners, face.uvs):
                    key = (c, f"{uv[0]:.5f} {uv[1]:.5f}")
                    if key not in vertex_of:
                        vertex_of[key] = len(positions)
                        positions.append(local(sub(mesh.points[c], bone.head)))
                        directions.append(local(normals[c]))
                        uvs.append((round(uv[0], 5), round(1.0 - uv[1], 5)))  # glTF's v runs down
                    corners.append(vertex_of[key])
                # the shorter diagonal keeps a bent quad's triangles fat
                ends = [mesh.points[c] for c in face.corners]
                spans = [dot(sub(ends[i + 2], ends[i]), sub(ends[i + 2], ends[i])) for i in (0, 1)]
                start = 0 if spans[0] <= spans[1] else 1
                corners = corners[start:] + corners[:start]
                indices += [(i,) for i in (corners[0], corners[1], corners[2], corners[0], corners[2], corners[3])]
            primitives.append({
                "attributes": {"POSITION": buffer.put(positions, "VEC3", "f", bounds=True),
                               "NORMAL": buffer.put(directions, "VEC3", "f"),
                               "TEXCOORD_0": buffer.put(uvs, "VEC2", "f")},
                "indices": buffer.put(indices, "SCALAR", "H"), "material": material_index[name]})
        meshes.append({"name": mesh.name, "primitives": primitives})
        nodes[node_of[bone.name]].setdefault("children", []).append(len(nodes))
        nodes.append({"name": mesh.name, "mesh": len(meshes) - 1})
    document = {
        "asset": {"version": "2.0", "generator": "sbfmt examples/modelling", "copyright": licence,
                  "extras": {"title": title}},
        "scene": 0, "scenes": [{"name": armature, "nodes": [0]}], "nodes": nodes, "meshes": meshes,
        "materials": [{"name": m.name, "pbrMetallicRoughness": {
            "baseColorFactor": list(m.colour) + [1.0], "metallicFactor": 0.0, "roughnessFactor": m.roughness}}
            for m in materials],
        "accessors": buffer.accessors, "bufferViews": buffer.views, "buffers": [{"byteLength": len(buffer.data)}]}
    text = json.dumps(document, separators=(",", ":")).encode("ascii")
    text += b" " * (-len(text) % 4)
    binary = bytes(buffer.data)
    total = 12 + 8 + len(text) + 8 + len(binary)
    return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(binary), b"BIN\0") + binary)
