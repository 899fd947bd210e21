"""A binary glTF read with the standard library alone: nodes, meshes, skins and animations, and a pose evaluated."""

import json
import struct

from bundle_file import apply, keyed, matrix_of, product

FORMATS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Glb:
    def __init__(self, path):
        with open(path, "rb") as stream:
            data = stream.read()
        size, = struct.unpack_from("<I", data, 12)
        self.json = json.loads(data[20:20 + size])
        self.binary = data[20 + size + 8:]
        self.nodes = self.json["nodes"]
        self.parents = [None] * len(self.nodes)
        for i, node in enumerate(self.nodes):
            for child in node.get("children", ()):
                self.parents[child] = i

    def accessor(self, number):
        a = self.json["accessors"][number]
        view = self.json["bufferViews"][a["bufferView"]]
        width, kind = WIDTHS[a["type"]], FORMATS[a["componentType"]]
        start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
        stride = view.get("byteStride", width * struct.calcsize(kind))
        maximum = {"B": 255, "H": 65535}.get(kind, 1) if a.get("normalized") else 1
        found = [struct.unpack_from(f"<{width}{kind}", self.binary, start + i * stride) for i in range(a["count"])]
        return [tuple(n / maximum for n in row) for row in found] if maximum > 1 else found

    def primitives(self):
        """(mesh node, primitive) in the order of the file's meshes."""
        for i, node in enumerate(self.nodes):
            if "mesh" in node:
                for primitive in self.json["meshes"][node["mesh"]]["primitives"]:
                    yield i, primitive

    def joint_count(self):
        return len({joint for skin in self.json.get("skins", ()) for joint in skin["joints"]})

    def tracks(self, animation):
        found = {}
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            assert sampler.get("interpolation", "LINEAR") == "LINEAR"
            times = [row[0] for row in self.accessor(sampler["input"])]
            found[channel["target"]["node"], channel["target"]["path"]] = times, self.accessor(sampler["output"])
        return found

    def worlds(self, tracks, time):
        found = {}

        def world(i):
            if i not in found:
                node, own = self.nodes[i], None
                if "matrix" in node:
                    m = node["matrix"]
                    own = tuple(tuple(m[4 * k + r] for k in range(4)) for r in range(3))
                else:
                    trs = [node.get("translation", (0, 0, 0)), node.get("rotation", (0, 0, 0, 1)),
                           node.get("scale", (1, 1, 1))]
                    for k, name in enumerate(("translation", "rotation", "scale")):
                        if (i, name) in tracks:
                            trs[k] = keyed(*tracks[i, name], time, name == "rotation")
                    own = matrix_of(*trs)
                found[i] = product(world(self.parents[i]), own) if self.parents[i] is not None else own
            return found[i]

        return [world(i) for i in range(len(self.nodes))]

    def skinned(self, worlds, target=None):
        """The vertices of all skinned primitives, in the order of the file, where the joints carry them; as a morph target
        has them before. None for a vertex without weights."""
        points = []
        for node, primitive in self.primitives():
            skin = self.json["skins"][self.nodes[node]["skin"]]
            binds = [tuple(tuple(m[4 * k + r] for k in range(4)) for r in range(3))
                     for m in self.accessor(skin["inverseBindMatrices"])]
            moved = [product(worlds[joint], bind) for joint, bind in zip(skin["joints"], binds)]
            attributes = primitive["attributes"]
            positions = self.accessor(attributes["POSITION"])
            if target is not None:
                offsets = self.accessor(primitive["targets"][target]["POSITION"])
                positions = [tuple(a + b for a, b in zip(p, by)) for p, by in zip(positions, offsets)]
            for position, joints, weights in zip(positions,
                                              self.accessor(attributes["JOINTS_0"]),
                                              self.accessor(attributes["WEIGHTS_0"])):
                there = [(apply(moved[j], position), w) for j, w in zip(joints, weights) if w > 0]
                total = sum(w for _, w in there)
                points.append(tuple(sum(p[k] * w for p, w in there) / total for k in range(3)) if there else None)
        return points
