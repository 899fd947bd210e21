"""Writes binary glTF files of skinned meshes, as exporters write them: nodes, joints with inverse bind matrices, weights."""

import json
import struct

from bundle_file import apply, inverse, product


def column_major(m):
    return [m[r][k] if r < 3 else float(k == 3) for k in range(4) for r in range(4)]


class SkinnedGlb:
    """Nodes are added parents first; `write` makes the file."""

    def __init__(self):
        self.json = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "skins": [], "accessors": [], "bufferViews": [], "animations": []}
        self.binary = b""

    @classmethod
    def of(cls, path):
        """One that continues a file."""
        made = cls()
        with open(path, "rb") as stream:
            content = stream.read()
        size, = struct.unpack_from("<I", content, 12)
        made.json.update(json.loads(content[20:20 + size]))
        made.binary = content[28 + size:]
        return made

    def node(self, name, parent=None, matrix=None, **more):
        number = len(self.json["nodes"])
        self.json["nodes"].append({"name": name, **more})
        if matrix:
            self.json["nodes"][-1]["matrix"] = column_major(matrix)
        siblings = (self.json["scenes"][0]["nodes"] if parent is None
                    else self.json["nodes"][parent].setdefault("children", []))
        siblings.append(number)
        return number

    def accessor(self, rows, kind, shape, **more):
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}[shape]
        flat = [n for row in rows for n in (row if width > 1 else (row,))]
        self.binary += b"\0" * (-len(self.binary) % 4)
        content = struct.pack(f"<{len(flat)}{kind}", *flat)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(content)})
        self.binary += content
        kinds = {"f": 5126, "B": 5121, "H": 5123, "I": 5125}
        self.json["accessors"].append({"bufferView": len(self.json["bufferViews"]) - 1, "componentType": kinds[kind],
                                       "count": len(rows), "type": shape, **more})
        return len(self.json["accessors"]) - 1

    def mesh(self, points, triangles, joints=None, weights=None, **primitive):
        low, high = ([f(p[k] for p in points) for k in range(3)] for f in (min, max))
        attributes = {"POSITION": self.accessor(points, "f", "VEC3", min=low, max=high)}
        if joints:
            attributes["JOINTS_0"] = self.accessor(joints, "H", "VEC4")
            attributes["WEIGHTS_0"] = self.accessor(weights, "f", "VEC4")
        indices = self.accessor([i for t in triangles for i in t], "I", "SCALAR")
        self.json["meshes"].append({"primitives": [{"attributes": attributes, "indices": indices, **primitive}]})
        return len(self.json["meshes"]) - 1

    def skin(self, joints, binds):
        matrices = self.accessor([column_major(m) for m in binds], "f", "MAT4")
        self.json["skins"].append({"joints": joints, "inverseBindMatrices": matrices})
        return len(self.json["skins"]) - 1

    def write(self, path):
        binary = self.binary + b"\0" * (-len(self.binary) % 4)
        self.json["buffers"] = [{"byteLength": len(binary)}]
        text = json.dumps({k: v for k, v in self.json.items() if v != []}).encode()
        text += b" " * (-len(text) % 4)
        with open(path, "wb") as stream:
            stream.write(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)))
            stream.write(struct.pack("<I4s", len(text), b"JSON") + text)
            stream.write(struct.pack("<I4s", len(binary), b"BIN\0") + binary)
        return path


def box(low, high):
    """Points and triangles of a box with outward faces."""
    points = [tuple((high if i >> k & 1 else low)[k] for k in range(3)) for i in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return points, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def tube(bottom, top, radius, rings=9, sides=8):
    """Points and triangles of an upright closed tube around the y axis."""
    import math
    points = [(radius * math.cos(2 * math.pi * s / sides), bottom + (top - bottom) * r / (rings - 1),
               -radius * math.sin(2 * math.pi * s / sides)) for r in range(rings) for s in range(sides)]
    triangles = []
    for r in range(rings - 1):
        for s in range(sides):
            a, b = r * sides + s, r * sides + (s + 1) % sides
            triangles += [(a, b, b + sides), (a, b + sides, a + sides)]
    last = (rings - 1) * sides
    triangles += [(0, s + 1, s) for s in range(1, sides - 1)]
    triangles += [(last, last + s, last + s + 1) for s in range(1, sides - 1)]
    return points, triangles


def inverse_binds(joint_worlds, mesh_to_scene):
    """Of a mesh whose space lay at `mesh_to_scene` when it was bound to joints at `joint_worlds`."""
    return [product(inverse(w), mesh_to_scene) for w in joint_worlds]


def moved(points, matrix):
    return [apply(matrix, p) for p in points]
