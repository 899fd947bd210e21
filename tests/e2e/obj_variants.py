"""Reads OBJ files, changes them as other programs would write them, and writes them.

A point of an Obj knows which points of the first one it came from (`origins`), so that what a conversion makes of a
variant can be compared with what it makes of the original: its weights are the mean of theirs."""

import random


class Obj:
    def __init__(self, points, uvs, normals, faces, origins=None, library=None):
        self.points, self.uvs, self.normals, self.library = points, uvs, normals, library
        self.faces = faces  # (object, material, [(point, uv or None, normal or None)])
        self.origins = origins or [[i] for i in range(len(points))]

    def copy(self):
        return Obj(list(self.points), list(self.uvs), list(self.normals), [(o, m, list(c)) for o, m, c in self.faces],
                   [list(o) for o in self.origins], self.library)


def read(path):
    points, uvs, normals, faces = [], [], [], []
    name, material, library = "", None, None
    with open(path, encoding="utf-8") as stream:
        for line in stream:
            word, _, rest = line.strip().partition(" ")
            if word == "v":
                points.append(tuple(map(float, rest.split()[:3])))
            elif word == "vt":
                uvs.append(tuple(map(float, rest.split()[:2])))
            elif word == "vn":
                normals.append(tuple(map(float, rest.split()[:3])))
            elif word == "o":
                name = rest
            elif word == "usemtl":
                material = rest
            elif word == "mtllib":
                library = rest
            elif word == "f":
                corners = []
                for corner in rest.split():
                    ids = (corner.split("/") + ["", ""])[:3]
                    corners.append(tuple(int(i) - 1 if i else None for i in ids))
                faces.append((name, material, corners))
    return Obj(points, uvs, normals, faces, library=library)


def write(obj, path, digits=None):
    """`digits` after the point, as Blender's 6; all of them otherwise."""
    number = (lambda x: f"{x:.{digits}f}") if digits is not None else repr
    with open(path, "w", encoding="utf-8") as stream:
        if obj.library:
            stream.write(f"mtllib {obj.library}\n")
        for word, rows in (("v", obj.points), ("vt", obj.uvs), ("vn", obj.normals)):
            for row in rows:
                stream.write(" ".join([word, *map(number, row)]) + "\n")
        last, material_last = None, None
        for name, material, corners in obj.faces:
            if name != last:
                stream.write(f"o {name}\n")
            if material and material != material_last:
                stream.write(f"usemtl {material}\n")
            last, material_last = name, material
            stream.write("f " + " ".join("/".join("" if i is None else str(i + 1) for i in corner).rstrip("/")
                                         for corner in corners) + "\n")


def moved(obj, unit=1.0, axes=("x", "y", "z"), offset=(0, 0, 0), turn_mirrored=True):
    """Each axis of the new file as one of the old, as "-z"; lengths divided by `unit` (m). A mirroring exporter turns
    polygons, so that they still face outwards, or does not."""
    rows = [("xyz".index(a[-1]), -1 if a[0] == "-" else 1) for a in axes]
    sign = 1
    for _, s in rows:
        sign *= s
    order = [i for i, _ in rows]
    sign *= 1 if order in ([0, 1, 2], [1, 2, 0], [2, 0, 1]) else -1
    new = obj.copy()
    new.points = [tuple(s * p[i] / unit + o for (i, s), o in zip(rows, offset)) for p in obj.points]
    new.normals = [tuple(s * n[i] for i, s in rows) for n in obj.normals]
    if sign < 0 and turn_mirrored:
        new.faces = [(o, m, c[:1] + c[:0:-1]) for o, m, c in obj.faces]
    return new


def renumbered(obj, order):
    position = {old: new for new, old in enumerate(order)}
    new = obj.copy()
    new.points = [obj.points[i] for i in order]
    new.origins = [obj.origins[i] for i in order]
    new.faces = [(o, m, [(position[p], t, n) for p, t, n in c]) for o, m, c in obj.faces]
    return new


def shuffled(obj, seed=1):
    order = list(range(len(obj.points)))
    random.Random(seed).shuffle(order)
    new = renumbered(obj, order)
    random.Random(seed + 1).shuffle(new.faces)
    new.faces.sort(key=lambda face: face[0])
    return new


def triangulated(obj):
    new = obj.copy()
    new.faces = [(o, m, [c[0], c[k], c[k + 1]]) for o, m, c in obj.faces for k in range(1, len(c) - 1)]
    return new


def one_object(obj, name="all"):
    new = obj.copy()
    new.faces = [(name, m, c) for _, m, c in obj.faces]
    return new


def by_material(obj):
    new = obj.copy()
    new.faces = sorted(((f"{o}_{m}", m, c) for o, m, c in obj.faces), key=lambda face: face[0])
    return doubled(new, lambda face, corner: (corner[0], face[0]))


def doubled(obj, key=None):
    """A point for each set of corners with one key: for each texture coordinate, where none is given."""
    key = key or (lambda face, corner: (corner[0], corner[1]))
    new, found = obj.copy(), {}
    new.points, new.origins = [], []
    for i, (name, material, corners) in enumerate(obj.faces):
        for k, corner in enumerate(corners):
            at = found.get(key(obj.faces[i], corner))
            if at is None:
                at = found[key(obj.faces[i], corner)] = len(new.points)
                new.points.append(obj.points[corner[0]])
                new.origins.append(list(obj.origins[corner[0]]))
            corners = corners[:k] + [(at, corner[1], corner[2])] + corners[k + 1:]
        new.faces[i] = (name, material, corners)
    return new


def merged(obj):
    """Merges points at equal positions."""
    new, found, position = obj.copy(), {}, []
    new.points, new.origins = [], []
    for point, origin in zip(obj.points, obj.origins):
        if point not in found:
            found[point] = len(new.points)
            new.points.append(point)
            new.origins.append([])
        position.append(found[point])
        new.origins[found[point]] += origin
    new.faces = [(o, m, [(position[p], t, n) for p, t, n in c]) for o, m, c in obj.faces]
    return new


def only(obj, keep):
    """The objects for whose names `keep` is true."""
    new = obj.copy()
    new.faces = [face for face in obj.faces if keep(face[0])]
    used = sorted({p for _, _, corners in new.faces for p, _, _ in corners})
    return renumbered(new, used)


# --- Meshes that are like another: uvs and normals are left out ------------------------------------------------------

def size_of(obj):
    return max(max(p[k] for p in obj.points) - min(p[k] for p in obj.points) for k in range(3))


def jiggled(obj, fraction=1 / 3, by=0.01, seed=1):
    """Moves a fraction of the points by a fraction of the longest edge."""
    new, chance, size = obj.copy(), random.Random(seed), size_of(obj)
    for i, p in enumerate(obj.points):
        way = [chance.gauss(0, 1) for _ in range(3)]
        length = sum(x * x for x in way) ** 0.5
        if chance.random() < fraction:
            new.points[i] = tuple(x + by * size * d / length for x, d in zip(p, way))
    new.normals, new.uvs = [], []
    new.faces = [(o, m, [(p, None, None) for p, _, _ in c]) for o, m, c in obj.faces]
    return new


def subdivided(obj):
    """Each polygon into as many quads as it has corners; points of the sides' middles move as Catmull and Clark's."""
    new = Obj(list(obj.points), [], [], [], [list(o) for o in obj.origins], obj.library)
    sides, faces_of_side = {}, {}
    for face, (_, _, corners) in enumerate(obj.faces):
        for k, corner in enumerate(corners):
            side = tuple(sorted((corner[0], corners[(k + 1) % len(corners)][0])))
            faces_of_side.setdefault(side, []).append(face)
    middles = []
    for _, _, corners in obj.faces:
        middles.append(len(new.points))
        new.points.append(tuple(sum(obj.points[p][k] for p, _, _ in corners) / len(corners) for k in range(3)))
        new.origins.append([o for p, _, _ in corners for o in obj.origins[p]])
    for side, faces in faces_of_side.items():
        ends = [obj.points[i] for i in side]
        around = ends + [new.points[middles[f]] for f in faces] if len(faces) == 2 else ends
        sides[side] = len(new.points)
        new.points.append(tuple(sum(p[k] for p in around) / len(around) for k in range(3)))
        new.origins.append([o for i in side for o in obj.origins[i]])
    for face, (name, material, corners) in enumerate(obj.faces):
        for k, corner in enumerate(corners):
            after = sides[tuple(sorted((corner[0], corners[(k + 1) % len(corners)][0])))]
            before = sides[tuple(sorted((corner[0], corners[k - 1][0])))]
            new.faces.append((name, material, [(i, None, None) for i in (corner[0], after, middles[face], before)]))
    return new


def simplified(obj, fraction=0.5):
    """Collapses the shortest edges to their middles until a fraction of the points is left."""
    tri = triangulated(obj)
    count = len({p for _, _, c in tri.faces for p, _, _ in c})
    root, points, origins = list(range(len(tri.points))), list(tri.points), [list(o) for o in tri.origins]

    def top(i):
        while root[i] != i:
            root[i] = root[root[i]]
            i = root[i]
        return i

    def length(side):
        return sum((a - b) ** 2 for a, b in zip(obj.points[side[0]], obj.points[side[1]]))

    sides = sorted({tuple(sorted((c[k][0], c[(k + 1) % 3][0]))) for _, _, c in tri.faces for k in range(3)}, key=length)
    left, grown = count, set()
    for a, b in sides:
        a, b = top(a), top(b)
        if left <= fraction * count:
            break
        if a == b or a in grown and b in grown:
            continue
        grown |= {a, b}
        root[b] = a
        origins[a] += origins[b]
        points[a] = tuple((x + y) / 2 for x, y in zip(points[a], points[b]))
        left -= 1
    new = Obj(points, [], [], [], library=obj.library)
    for name, material, corners in tri.faces:
        ids = [top(p) for p, _, _ in corners]
        if len(set(ids)) == 3:
            new.faces.append((name, material, [(i, None, None) for i in ids]))
    kept = sorted({p for _, _, c in new.faces for p, _, _ in c})
    new.origins = origins
    return renumbered(new, kept)
