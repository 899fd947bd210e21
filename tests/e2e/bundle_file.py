"""A .sbf bundle read by a few lines of Python: meshes with skins, bones, clips; and a pose evaluated from it."""

import bisect
import math
import xml.etree.ElementTree as ElementTree


def numbers(element, name):
    found = element.find(name) if element is not None else None
    return [] if found is None or not found.text else [float(n) for n in found.text.split()]


def rows(flat, width):
    return [tuple(flat[i:i + width]) for i in range(0, len(flat), width)]


def vector(text, missing):
    return tuple(map(float, text.split())) if text else missing


def matrix_of(translation=(0, 0, 0), rotation=(0, 0, 0, 1), scale=(1, 1, 1)):
    """Rows of a 3x4 matrix: scale, then turn, then move."""
    x, y, z, w = rotation
    turn = ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))
    return tuple(tuple(turn[r][k] * scale[k] for k in range(3)) + (translation[r],) for r in range(3))


def product(a, b):
    return tuple(tuple(sum(a[r][i] * b[i][k] for i in range(3)) + (a[r][3] if k == 3 else 0) for k in range(4))
                 for r in range(3))


def inverse(a):
    c = [[a[(k + 1) % 3][(r + 1) % 3] * a[(k + 2) % 3][(r + 2) % 3] -
          a[(k + 1) % 3][(r + 2) % 3] * a[(k + 2) % 3][(r + 1) % 3] for k in range(3)] for r in range(3)]
    det = sum(a[0][k] * c[k][0] for k in range(3))
    m = [[c[r][k] / det for k in range(3)] for r in range(3)]
    return tuple(tuple(m[r]) + (-sum(m[r][k] * a[k][3] for k in range(3)),) for r in range(3))


def apply(a, p):
    return tuple(a[r][0] * p[0] + a[r][1] * p[1] + a[r][2] * p[2] + a[r][3] for r in range(3))


def slerp(a, b, fraction):
    dot = sum(x * y for x, y in zip(a, b))
    if dot < 0:
        b, dot = tuple(-x for x in b), -dot
    if dot > 0.9999:
        mixed = tuple(x + (y - x) * fraction for x, y in zip(a, b))
    else:
        angle = math.acos(dot)
        mixed = tuple((math.sin((1 - fraction) * angle) * x + math.sin(fraction * angle) * y) / math.sin(angle)
                      for x, y in zip(a, b))
    length = math.sqrt(sum(x * x for x in mixed))
    return tuple(x / length for x in mixed)


def keyed(times, values, time, turning=False):
    """Linear between keys, the nearest outside them."""
    after = bisect.bisect_right(times, time)
    if after == 0 or after == len(times):
        return values[min(after, len(times) - 1)]
    begin, end = times[after - 1], times[after]
    fraction = (time - begin) / (end - begin)
    a, b = values[after - 1], values[after]
    return slerp(a, b, fraction) if turning else tuple(x + (y - x) * fraction for x, y in zip(a, b))


class Bundle:
    def __init__(self, path):
        self.root = ElementTree.parse(path).getroot()
        self.bones = list(self.root.iter("bone"))
        self.bone_of_id = {bone.get("id"): i for i, bone in enumerate(self.bones)}
        self.parents = [self.bone_of_id.get(bone.get("parent")) for bone in self.bones]
        self.rest = [matrix_of(vector(bone.get("head"), (0, 0, 0)), vector(bone.get("rotation"), (0, 0, 0, 1)))
                     for bone in self.bones]
        self.clips = list(self.root.iter("clip"))
        self.meshes = list(self.root.iter("render_mesh"))

    def bone_names(self):
        return [bone.get("name") for bone in self.bones]

    def tracks(self, clip):
        found = {}
        for track in clip.iter("track"):
            width = 4 if track.get("property") == "rotation" else 3
            found[self.bone_of_id[track.get("bone")], track.get("property")] = (
                numbers(track, "times"), rows(numbers(track, "values"), width))
        return found

    def pose(self, tracks, time):
        """Each bone's frame in asset space at that time, as 3x4 rows."""
        frames = []
        for i, parent in enumerate(self.parents):
            above = self.rest[parent] if parent is not None else None
            local = product(inverse(above), self.rest[i]) if above else self.rest[i]
            rotation, scale = None, (1, 1, 1)
            position = tuple(row[3] for row in local)
            if (i, "translation") in tracks:
                position = keyed(*tracks[i, "translation"], time)
            if (i, "rotation") in tracks:
                rotation = keyed(*tracks[i, "rotation"], time, True)
            if (i, "scale") in tracks:
                scale = keyed(*tracks[i, "scale"], time)
            turn = matrix_of((0, 0, 0), rotation) if rotation else tuple(row[:3] + (0,) for row in local)
            own = tuple(tuple(turn[r][k] * scale[k] for k in range(3)) + (position[r],) for r in range(3))
            frames.append(product(frames[parent], own) if parent is not None else own)
        return frames

    def positions(self, mesh):
        return rows(numbers(mesh.find("polygon_mesh"), "positions"), 3)

    def polygon_sizes(self, mesh):
        return [int(n) for n in numbers(mesh.find("polygon_mesh"), "polygon_sizes")]

    def source_points(self, mesh):
        return [int(n) for n in numbers(mesh, "source_points")]

    def skin(self, mesh):
        """For each point a list of (bone, weight)."""
        found = mesh.find("skin")
        bones, weights = [int(n) for n in numbers(found, "bones")], numbers(found, "weights")
        influences, at = [], 0
        for count in map(int, numbers(found, "influence_counts")):
            influences.append(list(zip(bones[at:at + count], weights[at:at + count])))
            at += count
        return influences

    def skinned(self, mesh, frames):
        """The mesh's points where the bones' frames carry them."""
        moved = [product(frame, inverse(rest)) for frame, rest in zip(frames, self.rest)]
        points = []
        for position, influences in zip(self.positions(mesh), self.skin(mesh)):
            there = [(apply(moved[bone], position), weight) for bone, weight in influences]
            points.append(tuple(sum(p[k] * w for p, w in there) for k in range(3)))
        return points
