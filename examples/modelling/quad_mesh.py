"""A polygon mesh small enough to read: points, faces with per-corner uvs and a material, and the few
operations a modelling script needs (mirror, subdivide, replace a patch) with the checks its result must pass.

Python 3 standard library only. Lengths in metres, right-handed, +Y up; faces wind counter-clockwise seen from outside.
"""

import math
from collections import Counter, namedtuple

Face = namedtuple("Face", "corners uvs material")


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def scale(a, factor):
    return (a[0] * factor, a[1] * factor, a[2] * factor)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scale(a, 1.0 / length(a))


def lerp(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def mean(points):
    return scale(tuple(map(sum, zip(*points))), 1.0 / len(points))


class QuadMesh:
    """points: list of (x, y, z); faces: list of Face, whose corners index points and whose uvs run beside them."""

    def __init__(self, name):
        self.name = name
        self.points = []
        self.faces = []

    def add_point(self, point):
        self.points.append(tuple(point))
        return len(self.points) - 1

    def add_face(self, corners, uvs, material):
        self.faces.append(Face(tuple(corners), tuple(uvs), material))

    def flipped(self):
        """Turn every face over, in place. The first corner stays, so a quad split from it keeps its diagonal."""
        self.faces = [Face(f.corners[:1] + f.corners[:0:-1], f.uvs[:1] + f.uvs[:0:-1], f.material) for f in self.faces]
        return self

    def mirrored(self, name):
        """The mirror image in the plane x = 0: same point order, winding kept outward."""
        image = QuadMesh(name)
        image.points = [(-x if x else 0.0, y, z) for x, y, z in self.points]
        image.faces = list(self.faces)
        return image.flipped()

    def stand(self):
        """Moves the lowest point to the ground."""
        lowest = min(p[1] for p in self.points)
        self.points = [(x, y - lowest, z) for x, y, z in self.points]
        return self

    def round_points(self, digits=6):
        self.points = [tuple(round(c, digits) + 0.0 for c in p) for p in self.points]
        return self

    def symmetrise(self, tolerance=1e-5):
        """Make a mesh that spans x = 0 mirror itself exactly: the +x side decides, points near the plane land on it."""
        cell = 4.0 * tolerance

        def key(point):
            return tuple(round(c / cell) for c in point)

        right = {}
        for index, p in enumerate(self.points):
            if p[0] < -tolerance:
                right.setdefault(key(p), []).append(index)
        paired = 0
        for index, p in enumerate(self.points):
            if abs(p[0]) <= tolerance:
                self.points[index] = (0.0, p[1], p[2])
            elif p[0] > tolerance:
                image = (-p[0], p[1], p[2])
                kx, ky, kz = key(image)
                near = [i for dx in (-1, 0, 1) for dy in (-1, 0, 1) for dz in (-1, 0, 1)
                        for i in right.get((kx + dx, ky + dy, kz + dz), ())]
                near = [i for i in near if length(sub(self.points[i], image)) <= tolerance]
                if len(near) != 1:
                    raise ValueError(f"{self.name}: point {index} has {len(near)} mirror images")
                self.points[near[0]] = image
                paired += 1
        if paired != sum(map(len, right.values())):
            raise ValueError(f"{self.name}: a point on the -x side mirrors none")
        return self

    def without_unused_points(self):
        """Drop points no face uses (a replaced patch leaves some), in place; the order of the rest stays."""
        used = sorted({c for f in self.faces for c in f.corners})
        new_from_old = {old: new for new, old in enumerate(used)}
        self.points = [self.points[i] for i in used]
        self.faces = [Face(tuple(new_from_old[c] for c in f.corners), f.uvs, f.material) for f in self.faces]
        return self

    def face_normal(self, face):
        """Area-weighted normal (twice the vector area)."""
        p = [self.points[c] for c in face.corners]
        total = (0.0, 0.0, 0.0)
        for i in range(1, len(p) - 1):
            total = add(total, cross(sub(p[i], p[0]), sub(p[i + 1], p[0])))
        return total

    def normals(self):
        """Smooth unit normal of every point."""
        total = [(0.0, 0.0, 0.0)] * len(self.points)
        for face in self.faces:
            n = self.face_normal(face)
            for c in face.corners:
                total[c] = add(total[c], n)
        return [unit(n) for n in total]

    def volume(self):
        """Enclosed volume in m³, positive when the faces wind outward."""
        total = 0.0
        for face in self.faces:
            p = [self.points[c] for c in face.corners]
            for i in range(1, len(p) - 1):
                total += dot(p[0], cross(p[i], p[i + 1]))
        return total / 6.0

    def directed_edges(self):
        return Counter((a, b) for f in self.faces for a, b in zip(f.corners, f.corners[1:] + f.corners[:1]))


def subdivided(mesh):
    """One step of Catmull-Clark: every face of a closed mesh becomes quads and the shape a smooth one.

    Uvs are subdivided linearly. E. Catmull, J. Clark, "Recursively generated B-spline surfaces on arbitrary
    topological meshes", Computer-Aided Design 10 (1978).
    """
    face_points = [mean([mesh.points[c] for c in f.corners]) for f in mesh.faces]
    edge_faces, point_faces, point_edges = {}, {}, {}
    for index, face in enumerate(mesh.faces):
        for a, b in zip(face.corners, face.corners[1:] + face.corners[:1]):
            edge = (min(a, b), max(a, b))
            edge_faces.setdefault(edge, []).append(index)
            point_faces.setdefault(a, []).append(index)
            point_edges.setdefault(a, set()).add(edge)
            point_edges.setdefault(b, set()).add(edge)

    fine = QuadMesh(mesh.name)
    for index, p in enumerate(mesh.points):
        valence = len(point_faces[index])
        around = mean([face_points[f] for f in point_faces[index]])
        middle = mean([mean([mesh.points[a], mesh.points[b]]) for a, b in sorted(point_edges[index])])
        fine.add_point(scale(add(add(around, scale(middle, 2.0)), scale(p, valence - 3.0)), 1.0 / valence))
    edge_index = {}
    for (a, b), faces in edge_faces.items():
        edge_index[a, b] = fine.add_point(mean([mesh.points[a], mesh.points[b], *(face_points[f] for f in faces)]))
    for face_point, face in zip(face_points, mesh.faces):
        centre = fine.add_point(face_point)
        count = len(face.corners)
        centre_uv = (sum(u for u, _ in face.uvs) / count, sum(v for _, v in face.uvs) / count)
        for i, corner in enumerate(face.corners):
            after, before = face.corners[(i + 1) % count], face.corners[i - 1]
            out = edge_index[(min(corner, after), max(corner, after))]
            back = edge_index[(min(corner, before), max(corner, before))]
            fine.add_face((corner, out, centre, back),
                          (face.uvs[i], lerp(face.uvs[i], face.uvs[(i + 1) % count], 0.5), centre_uv,
                           lerp(face.uvs[i], face.uvs[i - 1], 0.5)), face.material)
    return fine


def check_surface(mesh):
    """Everything that keeps a mesh from being the surface of one soft body, as a list of sentences (empty when it is
    one): closed, manifold, consistently wound outward, one piece, no unused or doubled point."""
    found = []
    edges = mesh.directed_edges()
    if any(n > 1 for n in edges.values()):
        found.append("an edge is used twice in the same direction")
    if any((b, a) not in edges for a, b in edges):
        found.append("the surface is open")
    if {c for f in mesh.faces for c in f.corners} != set(range(len(mesh.points))):
        found.append("a point is unused")
    if len(set(mesh.points)) != len(mesh.points):
        found.append("two points coincide")
    euler = len(mesh.points) - len(edges) // 2 + len(mesh.faces)
    if euler != 2:
        found.append(f"not one sphere-like piece (Euler characteristic {euler})")
    if mesh.volume() <= 0.0:
        found.append("the faces wind inward")
    return found


def check_section(mesh):
    """The same, and sound quads with finite uvs."""
    found = check_surface(mesh)
    for index, face in enumerate(mesh.faces):
        p = [mesh.points[c] for c in face.corners]
        if len(p) != 4 or len(set(face.corners)) != 4:
            found.append(f"face {index} is not a quad")
            continue
        normal = mesh.face_normal(face)
        sides = [length(sub(p[i - 3], p[i])) for i in range(4)]
        turns = [dot(cross(sub(p[i], p[i - 1]), sub(p[i - 3], p[i])), normal) for i in range(4)]
        if min(sides) < 2e-4 or length(normal) < 0.05 * max(sides) * min(sides):
            found.append(f"face {index} is degenerate")
        elif min(turns) <= 0.0:
            found.append(f"face {index} is not convex")
        if not all(math.isfinite(c) for uv in face.uvs for c in uv):
            found.append(f"face {index} has no uvs")
    return found


def check_mirror(left, right):
    """Sentences on how `right` fails to be the exact mirror image of `left` (itself, for a mesh across the middle)."""
    def signature(mesh, sign):
        found = []
        for face in mesh.faces:
            corners = [(sign * mesh.points[c][0] + 0.0,) + mesh.points[c][1:] for c in face.corners]
            found.append((tuple(sorted(corners)), face.material))
        return Counter(found)

    if signature(left, -1.0) != signature(right, 1.0):
        return [f"{right.name} is not the mirror image of {left.name}"]
    return []
