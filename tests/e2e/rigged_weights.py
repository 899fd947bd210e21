"""Weights of a conversion against those of the original: how many points have the same, how far posed skins are apart."""

import os

import obj_variants
from bundle_file import Bundle, apply, inverse, product
from sbfmt_program import call


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
        for source, place, weight in zip(bundle.source_points(mesh), places, weights):
            found[source] = (weight, place)
        at += len(places)
    return found


class Original:
    """A rigged file, its weights, and the OBJ that export makes of it."""

    def __init__(self, path, folder):
        self.path, self.name = path, os.path.splitext(os.path.basename(path))[0]
        self.bundle, self.obj_path = os.path.join(folder, self.name + ".sbf"), os.path.join(folder, self.name + ".obj")
        made = call("convert", path, "--no-build", "-o", self.bundle)
        if made.status == 0:
            made = call("export", self.bundle, "-o", self.obj_path)
        if made.status:
            raise RuntimeError(made.err)
        self.obj = obj_variants.read(self.obj_path)
        self.weights, self.places = [], []
        bundle = Bundle(self.bundle)
        names = bundle.bone_names()
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


def share_of_equal(original, variant, path, within=1e-3):
    """The share of the variant's points whose weights are those of one of the points they came from. A mirrored
    symmetric mesh is the same mesh with its sides exchanged: then points may be their mirror images as well, all of
    them."""
    found, twins = weights_by_vertex(path), mirror_twins(original)
    straight = exchanged = 0
    for vertex, (weights, _) in found.items():
        origins = variant.origins[vertex]
        straight += any(difference(original.weights[o], weights) <= within for o in origins)
        exchanged += any(difference(original.weights[t], weights) <= within for o in origins for t in twins[o])
    return max(straight, exchanged) / max(len(found), 1)


def posed_errors(original, variant, path, clips=3, frames=4):
    """Distances between the variant's points as posed by their weights and by those expected of them, in shares of
    the longest side: by frames of the file's clips."""
    bundle, found = Bundle(path), weights_by_vertex(path)
    places = [place for _, place in found.values()]
    size = max(max(p[k] for p in places) - min(p[k] for p in places) for k in range(3))
    index = {name: i for i, name in enumerate(bundle.bone_names())}
    errors = []
    for clip in bundle.clips[:clips]:
        tracks = bundle.tracks(clip)
        for frame in range(frames):
            pose = bundle.pose(tracks, float(clip.get("duration", 1)) * (frame + 0.5) / frames)
            moved = {name: product(pose[i], inverse(bundle.rest[i])) for name, i in index.items()}
            for vertex, (weights, place) in found.items():
                expected = original.expected(variant.origins[vertex])
                if not expected:
                    continue
                there, wanted = (tuple(sum(apply(moved[b], place)[k] * w for b, w in of.items()) for k in range(3))
                                 for of in (weights, expected))
                errors.append(sum((x - y) ** 2 for x, y in zip(there, wanted)) ** 0.5 / size)
    return sorted(errors)
