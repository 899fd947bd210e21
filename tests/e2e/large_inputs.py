"""Writes large inputs of a stated size: skinned characters, scenes of many bodies, faces of many corners.

By hand: large_inputs.py character VERTICES BONES OUT.glb | bodies COUNT OUT.obj | face CORNERS OUT.obj
"""

import array
import math
import sys

from skinned_glb import SkinnedGlb


class Tubes:
    """Closed tubes around straight chains of bones, their weights sliding from bone to bone."""

    def __init__(self):
        self.points, self.triangles, self.joints, self.weights = (array.array(kind) for kind in "fIHf")

    def add(self, begin, end, radius, bones, rings, sides):
        """`bones` follow each other from `begin` to `end`, equally long; the tube has rings * sides + 2 vertices."""
        axis = [b - a for a, b in zip(begin, end)]
        length = math.sqrt(sum(n * n for n in axis))
        axis = [n / length for n in axis]
        across = [0.0, 0.0, 1.0] if abs(axis[1]) > 0.7 else [0.0, 1.0, 0.0]
        u = cross(axis, across)
        size = math.sqrt(sum(n * n for n in u))
        u = [n / size for n in u]
        v = cross(axis, u)
        first = len(self.points) // 3
        circle = [(math.cos(2 * math.pi * s / sides), math.sin(2 * math.pi * s / sides)) for s in range(sides)]
        for ring in range(rings):
            t = ring / (rings - 1)
            centre = [b + axis[k] * length * t for k, b in enumerate(begin)]
            for x, y in circle:
                self.points.extend(centre[k] + radius * (u[k] * x + v[k] * y) for k in range(3))
                self._hold(t, bones)
        for t, centre in ((0, begin), (1, end)):
            self.points.extend(centre)
            self._hold(t, bones)
        triangles = self.triangles
        for ring in range(rings - 1):
            for s in range(sides):
                a, b = first + ring * sides + s, first + ring * sides + (s + 1) % sides
                triangles.extend((a, b, b + sides, a, b + sides, a + sides))
        last = first + (rings - 1) * sides
        for s in range(sides):
            triangles.extend((first + (s + 1) % sides, first + s, last + sides))
            triangles.extend((last + s, last + (s + 1) % sides, last + sides + 1))

    def _hold(self, t, bones):
        at = min(max(t * len(bones) - 0.5, 0), len(bones) - 1)
        low = min(int(at), len(bones) - 1)
        high = min(low + 1, len(bones) - 1)
        self.joints.extend((bones[low], bones[high], 0, 0))
        self.weights.extend((1 - (at - low), at - low, 0, 0))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def chain_of(parts, begin, end, parent, count):
    """Adds `count` bones (head, parent) from `begin` to `end`; returns their numbers."""
    numbers = []
    for i in range(count):
        parts.append(([a + (b - a) * i / count for a, b in zip(begin, end)], parent))
        parent = len(parts) - 1
        numbers.append(parent)
    return numbers


def character(path, vertices, bones):
    """A four-legged body of one skin with a tail and as many tentacles as the other bones are enough for."""
    heads, chains = [], []
    spine = max(4, min(12, bones // 8))
    body = chain_of(heads, (0, 0.6, -0.5), (0, 0.6, 0.5), None, spine)
    chains.append(((0, 0.6, -0.5), (0, 0.6, 0.5), 0.16, body))
    for x in (-0.12, 0.12):
        for z, bone in ((-0.4, body[0]), (0.4, body[-1])):
            chains.append(((x, 0.6, z), (x, 0.02, z), 0.05, chain_of(heads, (x, 0.6, z), (x, 0.02, z), bone, 3)))
    left = bones - len(heads)
    tails = [left] if left <= 8 else [8] * (left // 8)
    for i, count in enumerate(tails):
        angle = 2 * math.pi * i * 0.618034
        root = (0.1 * math.cos(angle), 0.6 + 0.1 * math.sin(angle), -0.45 + 0.9 * i / len(tails))
        tip = (root[0] * 5, 0.6 + (root[1] - 0.6) * 5, root[2] * 1.4)
        radius = 0.02 if len(tails) < 60 else 0.16 / math.sqrt(len(tails))
        chains.append((root, tip, radius, chain_of(heads, root, tip, body[i % spine], count)))
    areas = [math.dist(a, b) * radius for a, b, radius, _ in chains]
    tubes = Tubes()
    for (begin, end, radius, held), area in zip(chains, areas):
        count = max(24, vertices * area / sum(areas))
        sides = max(6, round(math.sqrt(count * 2 * math.pi * radius / math.dist(begin, end))))
        tubes.add(begin, end, radius, held, max(4, round(count / sides)), sides)
    glb = SkinnedGlb()
    nodes = []
    for i, (head, parent) in enumerate(heads):
        of = heads[parent][0] if parent is not None else (0, 0, 0)
        nodes.append(glb.node(f"bone_{i}", None if parent is None else nodes[parent],
                              translation=[a - b for a, b in zip(head, of)]))
    rows = [[[1.0, 0.0, 0.0, -h[0]], [0.0, 1.0, 0.0, -h[1]], [0.0, 0.0, 1.0, -h[2]]] for h, _ in heads]
    mesh = write_mesh(glb, tubes)
    glb.node("skin", mesh=mesh, skin=glb.skin(nodes, rows))
    return glb.write(path)


def write_mesh(glb, tubes):
    def add(values, kind, shape, width, **more):
        glb.binary += b"\0" * (-len(glb.binary) % 4)
        content = values.tobytes()
        glb.json["bufferViews"].append({"buffer": 0, "byteOffset": len(glb.binary), "byteLength": len(content)})
        glb.binary += content
        glb.json["accessors"].append({"bufferView": len(glb.json["bufferViews"]) - 1, "componentType": kind,
                                      "count": len(values) // width, "type": shape, **more})
        return len(glb.json["accessors"]) - 1

    low, high = ([f(tubes.points[k::3]) for k in range(3)] for f in (min, max))
    attributes = {"POSITION": add(tubes.points, 5126, "VEC3", 3, min=low, max=high),
                  "JOINTS_0": add(tubes.joints, 5123, "VEC4", 4), "WEIGHTS_0": add(tubes.weights, 5126, "VEC4", 4)}
    indices = add(tubes.triangles, 5125, "SCALAR", 1)
    glb.json["meshes"].append({"primitives": [{"attributes": attributes, "indices": indices}]})
    return len(glb.json["meshes"]) - 1


CUBE = ((1, 4, 3, 2), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7), (4, 1, 5, 8))


def bodies(path, count, fineness=4):
    """An OBJ of `count` cubes side by side, each an object with a surface of 6 * fineness^2 quads."""
    per_row = math.ceil(math.sqrt(count))
    with open(path, "w", encoding="ascii") as out:
        used = 0
        for i in range(count):
            out.write(f"o body_{i}\n")
            x, z = 0.3 * (i % per_row), 0.3 * (i // per_row)
            numbers, faces = {}, []
            for axis in range(3):
                for side in (0, fineness):
                    for a in range(fineness):
                        for b in range(fineness):
                            at = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)]
                            corners = [tuple((side, p, q)[(k - axis) % 3] for k in range(3)) for p, q in at]
                            faces.append([numbers.setdefault(c, len(numbers)) for c in
                                          (corners if side else corners[::-1])])
            for p in numbers:
                out.write(f"v {x + 0.2 * p[0] / fineness:.6g} {0.2 * p[1] / fineness:.6g} {z + 0.2 * p[2] / fineness:.6g}\n")
            for face in faces:
                out.write("f " + " ".join(str(used + n + 1) for n in face) + "\n")
            used += len(numbers)
    return path


def face(path, corners):
    """An OBJ of one polygon with so many corners on a circle of 60 vertices."""
    with open(path, "w", encoding="ascii") as out:
        for i in range(60):
            out.write(f"v {math.cos(math.pi * i / 30):.6f} {math.sin(math.pi * i / 30):.6f} 0\n")
        one = " ".join(str(i % 60 + 1) for i in range(60)) + " "
        out.write("f ")
        for _ in range(corners // 60):
            out.write(one)
        out.write("\n")
    return path


def main():
    kind, *sizes, out = sys.argv[1:]
    {"character": character, "bodies": bodies, "face": face}[kind](out, *map(int, sizes))


if __name__ == "__main__":
    main()
