"""Makes small rigged characters like those of unknown users: people of tubes in any number, position, pose and unit."""

import math

from bundle_file import apply, inverse, matrix_of, product
from skinned_glb import SkinnedGlb

# Bone, parent, head in metres; a person who stands on y = 0, faces +Z and has the arms out.
PERSON = [
    ("hips", None, (0, 0.95, 0)), ("spine", "hips", (0, 1.10, 0)), ("chest", "spine", (0, 1.28, 0)),
    ("head", "chest", (0, 1.55, 0)),
    *[(f"{name}.{side}", f"{above}.{side}" if above[0] != "!" else above[1:], (x * sign, y, z))
      for side, sign in (("L", 1), ("R", -1))
      for name, above, (x, y, z) in (("thigh", "!hips", (0.10, 0.90, 0)), ("shin", "thigh", (0.10, 0.50, 0.02)),
                                     ("foot", "shin", (0.10, 0.09, -0.02)), ("arm", "!chest", (0.18, 1.42, 0)),
                                     ("forearm", "arm", (0.45, 1.42, -0.01)), ("hand", "forearm", (0.70, 1.42, 0)))],
]
TIPS = {"head": (0, 1.78, 0), "hand": (0.85, 1.42, 0), "foot": (0.10, 0.03, 0.15)}
RADII = {"hips": 0.13, "spine": 0.12, "chest": 0.14, "head": 0.10, "thigh": 0.07, "shin": 0.055, "foot": 0.045,
         "arm": 0.05, "forearm": 0.045, "hand": 0.04}


def heads_and_tips():
    heads = {name: at for name, _, at in PERSON}
    tips = {}
    for name, _, at in PERSON:
        stem, dot, side = name.partition(".")
        if stem in TIPS:
            x, y, z = TIPS[stem]
            tips[name] = (-x if side == "R" else x, y, z)
        else:
            following = {"hips": "spine", "spine": "chest", "chest": "head", "thigh": "shin", "shin": "foot",
                         "arm": "forearm", "forearm": "hand"}[stem]
            tips[name] = heads[following + dot + side]
    return heads, tips


def tube_along(start, end, radius, sides=8, rings=4):
    """A closed tube between two points."""
    along = [b - a for a, b in zip(start, end)]
    length = math.sqrt(sum(x * x for x in along))
    along = [x / length for x in along]
    aside = (0, 0, 1) if abs(along[2]) < 0.9 else (1, 0, 0)
    u = [aside[(k + 1) % 3] * along[(k + 2) % 3] - aside[(k + 2) % 3] * along[(k + 1) % 3] for k in range(3)]
    size = math.sqrt(sum(x * x for x in u))
    u = [x / size for x in u]
    v = [along[(k + 1) % 3] * u[(k + 2) % 3] - along[(k + 2) % 3] * u[(k + 1) % 3] for k in range(3)]
    points = [tuple(start[k] + along[k] * length * r / (rings - 1) +
                    radius * (u[k] * math.cos(2 * math.pi * s / sides) + v[k] * math.sin(2 * math.pi * s / sides))
                    for k in range(3)) for r in range(rings) for s in range(sides)]
    triangles = []
    for r in range(rings - 1):
        for s in range(sides):
            a, b = r * sides + s, r * sides + (s + 1) % sides
            triangles += [(a, b, b + sides), (a, b + sides, a + sides)]
    last = (rings - 1) * sides
    triangles += [(0, s + 1, s) for s in range(1, sides - 1)]
    triangles += [(last, last + s, last + s + 1) for s in range(1, sides - 1)]
    return points, triangles


def person_shape():
    """Points, triangles, and the bone of each point."""
    heads, tips = heads_and_tips()
    points, triangles, bones = [], [], []
    for number, (name, _, _) in enumerate(PERSON):
        more, faces = tube_along(heads[name], tips[name], RADII[name.partition(".")[0]])
        triangles += [tuple(i + len(points) for i in face) for face in faces]
        points += more
        bones += [number] * len(more)
    return points, triangles, bones


def write_person_obj(path, scale):
    points, triangles, _ = person_shape()
    with open(path, "w", encoding="ascii") as stream:
        stream.writelines(f"v {x * scale:.5f} {y * scale:.5f} {z * scale:.5f}\n" for x, y, z in points)
        stream.writelines("f " + " ".join(str(i + 1) for i in t) + "\n" for t in triangles)
    return path


def write_person_bvh(path, scale, axes=("x", "y", "z"), loose=()):
    """Motion capture of the person, standing still for two frames. Each axis of the file is one of the person's, as
    "-z". `loose` bones have no parent, as Blender writes them: below a root "__0" without channels, with ends that an
    importer invented."""
    heads, tips = heads_and_tips()
    parents = {name: None if name in loose else parent for name, parent, _ in PERSON}
    if loose:
        parents = {"__0": None, **{name: parent or "__0" for name, parent in parents.items()}}
        heads = {"__0": (0, 0, 0), **heads}
    for bone in loose:
        tips[bone] = [h + 4 * (t - h) for h, t in zip(heads[bone], tips[bone])]

    def offset(a, b):
        moved = [(a[k] - b[k]) * scale for k in range(3)]
        return " ".join(f"{moved['xyz'.index(axis[-1])] * (-1 if axis[0] == '-' else 1):.4f}" for axis in axes)

    def channels_of(bone):
        return 0 if bone == "__0" else 6 if parents[bone] in (None, "__0") else 3

    def lines_of(bone):
        above = heads[parents[bone]] if parents[bone] else (0, 0, 0)
        count = channels_of(bone)
        yield ("JOINT " if parents[bone] else "ROOT ") + bone
        yield "{"
        yield "OFFSET " + offset(heads[bone], above)
        yield f"CHANNELS {count}" + " Xposition Yposition Zposition" * (count > 3) + " Zrotation Xrotation Yrotation" * (count > 0)
        children = [name for name, parent in parents.items() if parent == bone]
        for child in children:
            yield from lines_of(child)
        if not children:
            yield from ("End Site", "{", "OFFSET " + offset(tips[bone], heads[bone]), "}")
        yield "}"

    def in_order(bone):
        yield bone
        for child in parents:
            if parents[child] == bone:
                yield from in_order(child)

    root = next(iter(parents))
    frame = " ".join((offset(heads[bone], (0, 0, 0)) + " " if channels_of(bone) == 6 else "") + "0 0 0"
                     for bone in in_order(root) if channels_of(bone))
    with open(path, "w", encoding="ascii") as stream:
        stream.write("\n".join(["HIERARCHY", *lines_of(root), "MOTION", "Frames: 2", "Frame Time: 0.0333", frame, frame, ""]))
    return path


def add_person(glb, name="person", placed=None, prefix="", armature=None):
    """Adds a person with a skin of its own. `placed`: 3x4 matrix that takes it from where it stands to where the file
    has it; only turns, moves and equal scales keep its bones."""
    placed = placed or matrix_of()
    heads = {bone: apply(placed, at) for bone, _, at in PERSON}
    joints, numbers = [], {}
    for bone, parent, _ in PERSON:
        above = heads[parent] if parent else (0, 0, 0)
        numbers[bone] = glb.node(prefix + bone, numbers[parent] if parent else armature,
                                 translation=[a - b for a, b in zip(heads[bone], above)])
        joints.append(numbers[bone])
    points, triangles, bones = person_shape()
    points = [apply(placed, p) for p in points]
    mesh = glb.mesh(points, triangles, [(b, 0, 0, 0) for b in bones], [(1, 0, 0, 0)] * len(bones))
    glb.json["meshes"][mesh]["name"] = name
    skin = glb.skin(joints, [inverse(matrix_of(heads[bone])) for bone, _, _ in PERSON])
    glb.json["skins"][skin]["name"] = name
    glb.node(name, mesh=mesh, skin=skin)
    return joints


def turned(axis, degrees, at=(0, 0, 0)):
    half = math.radians(degrees) / 2
    return matrix_of(at, [math.sin(half) * (a == axis) for a in "xyz"] + [math.cos(half)])


def people(path, *placed, **more):
    """A file with a person at each of these matrices."""
    glb = SkinnedGlb()
    for i, matrix in enumerate(placed):
        add_person(glb, f"person{i + 1}", matrix, f"p{i + 1}_" if len(placed) > 1 else "", **more)
    return glb.write(path)
