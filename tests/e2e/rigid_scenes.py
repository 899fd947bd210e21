"""glTF files with rigid bodies and joints (KHR_physics_rigid_bodies), written from a description of each body."""

import json
import struct

EXTENSION, SHAPES = "KHR_physics_rigid_bodies", "KHR_implicit_shapes"
CORNERS = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def glb_bytes(document, binary=b""):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    size = 12 + 8 + len(text) + 8 + len(binary)
    return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text +
            struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def box_mesh(size=(1, 1, 1)):
    """Buffer, views, accessors and mesh of a box of that size."""
    points = [[0.5 * s * c for s, c in zip(size, corner)] for corner in CORNERS]
    indices = [side[k] for side in SIDES for k in (0, 1, 2, 0, 2, 3)]
    binary = struct.pack(f"<{3 * len(points)}f", *sum(points, [])) + struct.pack(f"<{len(indices)}H", *indices)
    first = 12 * len(points)
    half = [0.5 * s for s in size]
    return binary, {
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": [{"buffer": 0, "byteLength": first}, {"buffer": 0, "byteOffset": first, "byteLength": 2 * len(indices)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [-h for h in half], "max": half},
                      {"bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}]}


class Scene:
    """Nodes are added with their extension; `bytes` is the file."""

    def __init__(self):
        self.binary, self.document = box_mesh()
        self.nodes, self.tops, self.shapes, self.joints, self.materials, self.filters = [], [], [], [], [], []

    def node(self, name, parent=None, physics=None, **members):
        index = len(self.nodes)
        node = {"name": name, **members}
        if physics:
            node["extensions"] = {EXTENSION: physics}
        self.nodes.append(node)
        if parent is None:
            self.tops.append(index)
        else:
            self.nodes[parent].setdefault("children", []).append(index)
        return index

    def shape(self, kind, **values):
        self.shapes.append({"type": kind, kind: values})
        return {"geometry": {"shape": len(self.shapes) - 1}}

    def body(self, name, at=(0, 50, 0), collider=None, parent=None, rotation=(0, 0, 0, 1), scale=(1, 1, 1), **motion):
        """A dynamic box of 1 m, unless a collider is given; False: none."""
        physics = {"motion": motion}
        if collider is not False:
            physics["collider"] = collider or self.shape("box", size=[1, 1, 1])
        return self.node(name, parent, physics, mesh=0, translation=list(at), rotation=list(rotation), scale=list(scale))

    def joint(self, body, other, limits=(), drives=(), at=(0, 0, 0), other_at=(0, 0, 0), **members):
        """Joins two nodes at a position in each; `other` None is the world."""
        frame = self.node("frame b", other, translation=list(other_at))
        self.joints.append({"limits": list(limits), "drives": list(drives)})
        return self.node("frame a", body, {"joint": {"connectedNode": frame, "joint": len(self.joints) - 1, **members}},
                         translation=list(at))

    def json(self):
        lists = {"physicsMaterials": self.materials, "collisionFilters": self.filters, "physicsJoints": self.joints}
        extensions = {EXTENSION: {name: items for name, items in lists.items() if items}}
        if self.shapes:
            extensions[SHAPES] = {"shapes": self.shapes}
        return {"asset": {"version": "2.0"}, "extensionsUsed": sorted(extensions), "scene": 0, "scenes": [{"nodes": self.tops}],
                "nodes": self.nodes, "extensions": extensions, **self.document}

    def bytes(self):
        return glb_bytes(self.json(), self.binary)
