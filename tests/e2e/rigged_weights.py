"""Compares weights of a conversion with those of the original: the fraction of equal points, and the distance of posed skins."""

import csv
import math
import os

import obj_variants
from bundle_file import Bundle, apply, inverse, matrix_of, product
from glb_file import Glb
from sbfmt_program import SOURCE_PARTS, call
from skinned_glb import SkinnedGlb


def weights_by_vertex(path):
    """For each line v of the OBJ that the bundle came from, or that export writes of it: {bone: weight}, and where
    it is."""
    bundle, found = Bundle(path), {}
    names, at = bundle.bone_names(), 0
    for mesh in bundle.meshes:
        places = bundle.positions(mesh)
        if mesh.find("skin") is not None:
            weights = [{names[bone]: weight for bone, weight in point} for point in bundle.skin(mesh)]
        else:
            bone = mesh.get("bone")
            weights = [{names[bundle.bone_of_id[bone]]: 1.0} if bone else {}] * len(places)
        for source, position, weight in zip(bundle.source_points(mesh), places, weights):
            found[source] = (weight, position)
        at += len(places)
    return found


class Original:
    """A rigged file, its weights, and the OBJ that export makes of it."""

    def __init__(self, path, folder):
        self.path, self.name = path, os.path.splitext(os.path.basename(path))[0]
        self.bundle, self.obj_path = os.path.join(folder, self.name + ".sbf"), os.path.join(folder, self.name + ".obj")
        made = call("convert", path, *SOURCE_PARTS, "-o", self.bundle)
        if made.status == 0:
            made = call("export", self.bundle, "-o", self.obj_path)
        if made.status:
            raise RuntimeError(made.err)
        self.obj = obj_variants.read(self.obj_path)
        self.weights, self.places = [], []
        bundle = Bundle(self.bundle)
        self.bone_names = names = bundle.bone_names()
        for mesh in bundle.meshes:  # in the order in which export writes them
            self.places += bundle.positions(mesh)
            if mesh.find("skin") is not None:
                self.weights += [{names[b]: w for b, w in point} for point in bundle.skin(mesh)]
            else:
                bone = mesh.get("bone")
                only = {names[bundle.bone_of_id[bone]]: 1.0} if bone else {}
                self.weights += [only] * len(bundle.positions(mesh))

    def expected(self, origins):
        """The mean of the weights of points of the original."""
        mean = {}
        for origin in origins:
            for bone, weight in self.weights[origin].items():
                mean[bone] = mean.get(bone, 0) + weight / len(origins)
        return mean


def save_in_a_pose(path, saved_path, turns):
    """Writes the binary glTF with nodes turned, {name: quaternion}, as a program saves it in the middle of a movement.
    Returns the motion of each node's frame that this makes, by name, in the space of the file."""
    file = Glb(path)
    before = file.worlds({}, 0)
    saved = SkinnedGlb.of(path)
    for node in saved.json["nodes"]:
        if node.get("name") in turns:
            turned = product(matrix_of((0, 0, 0), node.get("rotation", (0, 0, 0, 1))), matrix_of((0, 0, 0), turns[node["name"]]))
            node["rotation"] = quaternion_of(turned)
    saved.write(saved_path)
    after = Glb(saved_path).worlds({}, 0)
    return {node.get("name"): product(after[i], inverse(before[i])) for i, node in enumerate(file.nodes)}


def add_clip(path, animated_path, name, turns, seconds):
    """Writes the binary glTF with a clip that turns nodes from rest, {name: quaternion at the end}."""
    file = SkinnedGlb.of(path)
    times, clip = file.accessor([0.0, seconds], "f", "SCALAR", min=[0.0], max=[seconds]), {"name": name, "samplers": [], "channels": []}
    for i, node in enumerate(file.json["nodes"]):
        if node.get("name") not in turns:
            continue
        rest = node.get("rotation", [0, 0, 0, 1])
        end = quaternion_of(product(matrix_of((0, 0, 0), rest), matrix_of((0, 0, 0), turns[node["name"]])))
        keys = file.accessor([rest, end], "f", "VEC4")
        clip["channels"].append({"sampler": len(clip["samplers"]), "target": {"node": i, "path": "rotation"}})
        clip["samplers"].append({"input": times, "output": keys})
    file.json.setdefault("animations", []).append(clip)
    file.write(animated_path)


def quaternion_of(m):
    """Of a rotation by less than half a turn about any axis."""
    w = max(1 + m[0][0] + m[1][1] + m[2][2], 0) ** 0.5 / 2
    return [(m[2][1] - m[1][2]) / (4 * w), (m[0][2] - m[2][0]) / (4 * w), (m[1][0] - m[0][1]) / (4 * w), w]


def posed(original, motions):
    """The original's OBJ as drawn with its bones moved so, each corner with a normal of its own."""
    obj, blended = original.obj.copy(), []
    for weights in original.weights:
        blended.append([[sum(motions[b][r][k] * w for b, w in weights.items()) for k in range(4)] for r in range(3)])
    obj.points = [apply(m, p) for m, p in zip(blended, obj.points)]
    obj.normals, faces = [], []
    for name, material, corners in obj.faces:
        own = []
        for point, uv, normal in corners:
            rows = [row[:3] for row in blended[point]]
            cofactors = [cross(rows[(r + 1) % 3], rows[(r + 2) % 3]) for r in range(3)]
            own.append((point, uv, len(obj.normals)))
            obj.normals.append(unit([sum(c * x for c, x in zip(row, original.obj.normals[normal])) for row in cofactors]))
        faces.append((name, material, own))
    obj.faces = faces
    return obj


def cross(a, b):
    return tuple(a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3] for k in range(3))


def unit(v):
    length = sum(x * x for x in v) ** 0.5 or 1
    return tuple(x / length for x in v)


def difference(a, b):
    return max((abs(a.get(bone, 0) - b.get(bone, 0)) for bone in {*a, *b}), default=0)


def mirror_twins(original):
    """For each point the one at its mirror image in x, if there is one within a ten-thousandth of the size."""
    cell = 2e-4 * obj_variants.size_of(original.obj)
    middle = (max(p[0] for p in original.obj.points) + min(p[0] for p in original.obj.points)) / 2
    grid = {}
    for i, p in enumerate(original.obj.points):
        grid.setdefault(tuple(round(x / cell) for x in p), []).append(i)
    twins = []
    for p in original.obj.points:
        key = [round(x / cell) for x in (2 * middle - p[0], p[1], p[2])]
        near = (grid.get((key[0] + a, key[1] + b, key[2] + c), []) for a in (-1, 0, 1) for b in (-1, 0, 1)
                for c in (-1, 0, 1))
        twins.append([i for found in near for i in found])
    return twins


def equal_fraction(original, variant, path, within=1e-3):
    """The fraction of the variant's points that have the weights of one of their original points. A mirrored
    symmetric mesh is the same mesh with its sides exchanged: then points may be their mirror images as well, all of
    them."""
    found, twins = weights_by_vertex(path), mirror_twins(original)
    straight = exchanged = 0
    for vertex, (weights, _) in found.items():
        origins = variant.origins[vertex]
        straight += any(difference(original.weights[o], weights) <= within for o in origins)
        exchanged += any(difference(original.weights[t], weights) <= within for o in origins for t in twins[o])
    return max(straight, exchanged) / max(len(found), 1)


def walk_motions(path, folder, seconds=2, frames=6):
    """How a built bundle's bones have moved from rest, by name, at frames of its own walk, swim or flight."""
    bundle, out = Bundle(path), os.path.join(folder, "walk.csv")
    made = call("run", path, "--seconds", seconds, "--drive", "0.4,0", "--pose", out)
    if made.status:
        raise RuntimeError(made.err)
    rest, poses = dict(zip(bundle.bone_names(), bundle.rest)), {}
    with open(out, encoding="utf-8") as stream:
        for row in csv.DictReader(stream):
            position, turn = ([float(row[k]) for k in keys] for keys in (("px", "py", "pz"), ("qx", "qy", "qz", "qw")))
            pose = product(matrix_of(position, turn), inverse(rest[row["bone"]]))
            poses.setdefault(int(row["frame"]), {})[row["bone"]] = pose
    last = max(poses)
    return [poses[last * (i + 1) // frames] for i in range(frames)]


def clip_motions(path, clips=3, frames=4):
    """The same at frames of the clips."""
    bundle, found = Bundle(path), []
    for clip in bundle.clips[:clips]:
        tracks = bundle.tracks(clip)
        for frame in range(frames):
            pose = bundle.pose(tracks, float(clip.get("duration", 1)) * (frame + 0.5) / frames)
            found.append({name: product(pose[i], inverse(bundle.rest[i])) for i, name in enumerate(bundle.bone_names())})
    return found


def posed_errors(original, variant, path, motions):
    """Distances between the variant's points as posed by their weights and by those expected of them, in shares of
    the longest side, over all motions of the bones."""
    found = weights_by_vertex(path)
    places = [position for _, position in found.values()]
    size = max(max(p[k] for p in places) - min(p[k] for p in places) for k in range(3))
    errors = []
    for vertex, (weights, position) in found.items():
        expected = original.expected(variant.origins[vertex])
        if not expected:
            continue
        for motion in motions:
            there, wanted = (tuple(sum(apply(motion[b], position)[k] * w for b, w in of.items()) for k in range(3))
                             for of in (weights, expected))
            errors.append(math.dist(there, wanted) / size)
    return sorted(errors)
