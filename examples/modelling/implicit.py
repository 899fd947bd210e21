"""Makes smooth bodies from rounded parts. Each part is a distance field; parts blend smoothly, and the surface where the
result is 0 becomes one closed mesh of quads.

The mesh is made by naive surface nets (S. F. Gibson, "Constrained elastic surface nets", 1998): a point in each cell
of a grid that the surface crosses, a quad around each crossed edge; the points are then spread evenly and moved onto
the surface. Two distances blend by the polynomial smooth minimum.

Python 3 standard library only. Metres, +Y up. Parts are given on the left (+X); `both` adds the mirror image.
"""

import math
from collections import namedtuple

from quad_mesh import QuadMesh, add, dot, length, lerp, mean, scale, sub, unit

# distance: from a point to the part's surface, negative inside; centre, radius: a bounding ball of the part; melt: distance in
# metres over which it blends with the parts before it; carve: subtract the part
Part = namedtuple("Part", "distance centre radius melt carve")


def across_middle(point):
    return (-point[0], point[1], point[2])


class Body:
    """Parts, blended in the order in which they were added."""

    def __init__(self):
        self.parts = []

    def _add(self, distance, centre, radius, melt, carve=False):
        self.parts.append(Part(distance, centre, radius, melt, carve))
        return self

    def cone(self, start, end, start_radius, end_radius, melt=0.02, carve=False):
        """A cone from one ball to another, such as a limb between two joints."""
        ax, ay, az = start
        dx, dy, dz = sub(end, start)
        squared = dx * dx + dy * dy + dz * dz
        grow = end_radius - start_radius

        def distance(x, y, z):
            x, y, z = x - ax, y - ay, z - az
            t = min(max((x * dx + y * dy + z * dz) / squared, 0.0), 1.0)
            x, y, z = x - t * dx, y - t * dy, z - t * dz
            return math.sqrt(x * x + y * y + z * z) - start_radius - t * grow

        return self._add(distance, lerp(start, end, 0.5), 0.5 * math.sqrt(squared) + max(start_radius, end_radius), melt,
                         carve)

    def ball(self, centre, radii, melt=0.02, tilt=(0.0, 0.0, 0.0), carve=False):
        """An ellipsoid; radii: one or three; tilt: degrees about x, then y, then z."""
        a, b, c = radii if isinstance(radii, tuple) else (radii, radii, radii)
        cx, cy, cz = centre
        rows = _rotation(tilt)
        (ux, uy, uz), (vx, vy, vz), (wx, wy, wz) = (tuple(row[k] for row in rows) for k in range(3))

        def distance(x, y, z):
            x, y, z = x - cx, y - cy, z - cz
            p, q, r = (ux * x + uy * y + uz * z) / a, (vx * x + vy * y + vz * z) / b, (wx * x + wy * y + wz * z) / c
            away = math.sqrt(p * p + q * q + r * r)
            p, q, r = p / a, q / b, r / c
            slope = math.sqrt(p * p + q * q + r * r)
            return away * (away - 1.0) / slope if slope > 0.0 else -min(a, b, c)

        return self._add(distance, centre, max(a, b, c), melt, carve)

    def tube(self, points, radii, melt=0.02):
        """Cones from point to point."""
        for i in range(len(points) - 1):
            self.cone(points[i], points[i + 1], radii[i], radii[i + 1], melt if i == 0 else 0.4 * min(radii[i:i + 2]))
        return self

    def both(self, add_part, *arguments, **how):
        """A part on the left and its mirror image: both(body.cone, hip, knee, 0.03, 0.02)."""
        add_part(*arguments, **how)
        tilt = how.get("tilt")
        if tilt:
            how = {**how, "tilt": (tilt[0], -tilt[1], -tilt[2])}

        def mirrored(coordinates):
            if isinstance(coordinates, list):
                return [mirrored(p) for p in coordinates]
            return across_middle(coordinates) if isinstance(coordinates, tuple) else coordinates

        # of a ball the second argument are radii, which have no side
        if add_part == self.ball:
            add_part(across_middle(arguments[0]), *arguments[1:], **how)
        else:
            add_part(*(mirrored(p) for p in arguments), **how)
        return self

    def __call__(self, x, y, z):
        value = 1e9
        for part in self.parts:
            cx, cy, cz = part.centre
            x0, y0, z0 = x - cx, y - cy, z - cz
            minimum = math.sqrt(x0 * x0 + y0 * y0 + z0 * z0) - part.radius
            if part.carve:
                if -minimum < value - part.melt and minimum > 0.0:
                    continue
                value = -_melted(-value, part.distance(x, y, z), part.melt)
            elif minimum < value + part.melt:
                value = _melted(value, part.distance(x, y, z), part.melt)
        return value

    def box(self):
        kept = [p for p in self.parts if not p.carve]
        return tuple((min(p.centre[k] - p.radius for p in kept), max(p.centre[k] + p.radius for p in kept))
                     for k in range(3))


def _melted(a, b, k):
    if k <= 0.0:
        return min(a, b)
    h = max(k - abs(a - b), 0.0) / k
    return min(a, b) - h * h * k * 0.25


def _rotation(tilt):
    """Rows of Rz Ry Rx."""
    (sx, cx), (sy, cy), (sz, cz) = ((math.sin(math.radians(t)), math.cos(math.radians(t))) for t in tilt)
    return ((cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx),
            (sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx),
            (-sy, cy * sx, cy * cx))


EDGES = [(a, a | 1 << k) for k in range(3) for a in range(8) if not a >> k & 1]
# each side of a cell: its corners in a ring
SIDES = [(base, base | 1 << u, base | 1 << u | 1 << v, base | 1 << v)
         for k, u, v in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) for base in (0, 1 << k)]
BLOCK = 8  # cells


class _Grid:
    """Values at the corners of cells, computed when needed."""

    def __init__(self, body, cell):
        self.body, self.cell, self.values = body, cell, {}

    def at(self, i, j, k):
        key = (abs(i), j, k)  # computed on the left, so that both sides are equal to the bit
        value = self.values.get(key)
        if value is None:
            h = self.cell
            value = self.values[key] = self.body(abs(i) * h, j * h, k * h)
        return value

    def corners(self, i, j, k):
        return [self.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) for c in range(8)]

    def crossed_cells(self):
        """Cells whose corners are not all on one side. Blocks far from the surface are skipped."""
        h, size = self.cell, BLOCK
        ranges = [range(math.floor(low / h / size) - 1, math.floor(high / h / size) + 2) for low, high in self.body.box()]
        far = 0.5 * math.sqrt(3.0) * size * h * 1.5
        for bi in ranges[0]:
            for bj in ranges[1]:
                for bk in ranges[2]:
                    if abs(self.body(*((b + 0.5) * size * h for b in (bi, bj, bk)))) > far:
                        continue
                    yield from self._crossed_in(bi * size, bj * size, bk * size)

    def _crossed_in(self, i0, j0, k0):
        h = self.cell
        for i in range(i0, i0 + BLOCK):
            for j in range(j0, j0 + BLOCK):
                k = k0
                while k < k0 + BLOCK:
                    near = abs(self.at(i, j, k))
                    if near > 3.0 * h:  # too far from the surface for the next cells to be crossed
                        k += max(1, int(near / h * 0.6 - 1.0))
                        continue
                    corners = self.corners(i, j, k)
                    if min(corners) < 0.0 <= max(corners):
                        yield (i, j, k), corners
                    k += 1


def _around(coordinates, corner, axis):
    """The cells around the edge that leaves a corner of a cell along an axis."""
    u, v = (axis + 1) % 3, (axis + 2) % 3
    for du in (0, 1):
        for dv in (0, 1):
            beside = list(coordinates)
            beside[u] += (corner >> u & 1) - du
            beside[v] += (corner >> v & 1) - dv
            yield tuple(beside)


def _sheets(corners):
    """{crossed edge: number of the sheet of the surface it belongs to}: in a cell that two sheets pass each has a point
    of its own, so that no edge of the mesh has more than two faces."""
    inside = [value < 0.0 for value in corners]
    sheet = {edge: edge for edge in EDGES if inside[edge[0]] != inside[edge[1]]}

    def root(edge):
        while sheet[edge] != edge:
            edge = sheet[edge]
        return edge

    for side in SIDES:
        ring = [(side[k], side[(k + 1) % 4]) for k in range(4)]
        crossed = [(min(e), max(e)) for e in ring if inside[e[0]] != inside[e[1]]]
        if len(crossed) == 4 and inside[side[0]]:  # two opposite corners inside: two sheets
            crossed = crossed[3:] + crossed[:3]
        for first, second in zip(crossed[::2], crossed[1::2]):
            sheet[root(first)] = root(second)
    return {edge: root(edge) for edge in sheet}


def _net(body, cell, name):
    mesh, point_of, grid = QuadMesh(name), {}, _Grid(body, cell)
    cells = {coordinates: (corners, _sheets(corners)) for coordinates, corners in grid.crossed_cells()}
    waiting = sorted(cells)  # distances of flat parts are approximate: cells beside a crossed edge may have been skipped
    while waiting:
        coordinates = waiting.pop()
        for a, b in cells[coordinates][1]:
            k = (a ^ b).bit_length() - 1
            for beside in _around(coordinates, a, k):
                if beside not in cells:
                    corners = grid.corners(*beside)
                    cells[beside] = (corners, _sheets(corners))
                    waiting.append(beside)
    for coordinates in sorted(cells):
        corners, sheets = cells[coordinates]
        for sheet in sorted(set(sheets.values())):
            crossings = []
            for a, b in (edge for edge in EDGES if sheets.get(edge) == sheet):
                t = corners[a] / (corners[a] - corners[b])
                crossings.append(tuple((a >> k & 1) + t * ((b >> k & 1) - (a >> k & 1)) for k in range(3)))
            middle = mean(crossings)
            index = mesh.add_point(tuple((coordinates[k] + middle[k]) * cell for k in range(3)))
            point_of.update({(coordinates, edge): index for edge in EDGES if sheets.get(edge) == sheet})
    for coordinates in sorted(cells):
        corners = cells[coordinates][0]
        for axis in range(3):
            here, there = corners[0] < 0.0, corners[1 << axis] < 0.0
            if here == there:
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            ring = []
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):  # the cells around the edge, which each sees elsewhere
                beside, at = list(coordinates), du << u | dv << v
                beside[u] -= du
                beside[v] -= dv
                ring.append(point_of[tuple(beside), (at, at | 1 << axis)])
            mesh.add_face(ring if here else ring[::-1], ((0.0, 0.0),) * 4, "")
    image = {}
    for (coordinates, edge), index in point_of.items():
        if coordinates[0] >= 0:
            other = tuple(sorted(corner ^ 1 for corner in edge))
            image[index] = point_of[(-1 - coordinates[0], *coordinates[1:]), other]
    return mesh, image


def gradient(body, p, step=1e-4):
    x, y, z = p
    return (body(x + step, y, z) - body(x - step, y, z), body(x, y + step, z) - body(x, y - step, z),
            body(x, y, z + step) - body(x, y, z - step))


def _onto(body, p, max_step):
    """The point of the surface near p, at most so far away."""
    for _ in range(2):
        slope = scale(gradient(body, p), 5000.0)
        squared = dot(slope, slope)
        if squared < 1e-6:
            return p
        step = scale(slope, -body(*p) / squared)
        size = length(step)
        p = add(p, step if size <= max_step else scale(step, max_step / size))
    return p


def neighbours(mesh):
    beside = [set() for _ in mesh.points]
    for face in mesh.faces:
        for a, b in zip(face.corners, face.corners[1:] + face.corners[:1]):
            beside[a].add(b)
            beside[b].add(a)
    return [sorted(s) for s in beside]


def mesh_of(body, cell, name, rounds=4):
    """The surface of the body as quads about `cell` long; exactly symmetric where the body is."""
    mesh, image = _net(body, cell, name)
    beside = neighbours(mesh)
    for _ in range(rounds):
        moved = {}
        for i in image:
            middle = mean([mesh.points[b] for b in beside[i]])
            goal = lerp(mesh.points[i], middle, 0.6)
            moved[i] = _onto(body, goal, 0.5 * cell)
        for i, p in moved.items():
            p = (max(p[0], 0.05 * cell), p[1], p[2])
            mesh.points[i] = p
            mesh.points[image[i]] = across_middle(p)
    return mesh


def _back(point, side, flip):
    """Moves a point that was computed on the left back to its own side, or to the middle."""
    if abs(side) < 1e-12:
        return (0.0, point[1], point[2])
    return across_middle(point) if flip else point


def refine(mesh, body, field):
    """Quarters the faces on which the field is negative somewhere; neighbours take the new corners on their sides."""
    touched = {n for n, face in enumerate(mesh.faces) if min(field(mesh.points[c]) for c in face.corners) < 0.0}
    middles = {}

    def middle_of(a, b):
        key = (min(a, b), max(a, b))
        if key not in middles:
            ends = [mesh.points[c] for c in key]
            flip = sum(p[0] for p in ends) < 0.0  # values computed on the left are equal on both sides
            p = mean([across_middle(p) for p in ends] if flip else ends)
            p = _onto(body, p, 0.2 * length(sub(*ends)))
            middles[key] = mesh.add_point(_back(p, sum(q[0] for q in ends), flip))
        return middles[key]

    for n in sorted(touched):
        corners = mesh.faces[n].corners
        for a, b in zip(corners, corners[1:] + corners[:1]):
            middle_of(a, b)
    faces = []
    for n, face in enumerate(mesh.faces):
        corners, ring = face.corners, []
        for a, b in zip(corners, corners[1:] + corners[:1]):
            between = middles.get((min(a, b), max(a, b)))
            ring += [a] if between is None else [a, between]
        if n not in touched:
            faces.append(face._replace(corners=tuple(ring), uvs=((0.0, 0.0),) * len(ring)))
            continue
        points = [mesh.points[c] for c in corners]
        flip = sum(p[0] for p in points) < 0.0
        left = sorted(across_middle(p) for p in points) if flip else sorted(points)
        p = mean(left)
        p = _onto(body, p, 0.3 * max(length(sub(q, p)) for q in left))
        centre = mesh.add_point(_back(p, sum(q[0] for q in points), flip))
        for k in range(0, len(ring), 2):
            faces.append(face._replace(corners=(ring[k], ring[k + 1], centre, ring[k - 1])))
    mesh.faces = faces
    return mesh


def paint(mesh, body, rules, base, snap=0.3):
    """Gives every face a material: that of the last rule whose field is negative on it, else `base`.

    rules: [(material, field)], field(p) an approximate distance in metres from p to the painted region. Borders of colours are
    smooth: points near a region's border are moved onto it, and other faces that it crosses are cut in two."""
    mesh.faces = [face._replace(material=base) for face in mesh.faces]
    for material, field in rules:
        values = [field(p) for p in mesh.points]
        _snap(mesh, body, values, snap)
        _cut(mesh, body, values, material)
    # projected from the side: good enough for a texture
    mesh.faces = [face._replace(uvs=tuple((round(mesh.points[c][2], 5), round(mesh.points[c][1], 5)) for c in face.corners))
                  for face in mesh.faces]
    return mesh


def _images(mesh):
    index_of = {p: i for i, p in enumerate(mesh.points)}
    return [index_of[across_middle(p)] for p in mesh.points]


def _snap(mesh, body, values, snap):
    """Moves points onto the border if it cuts an edge close to them; their value becomes 0."""
    beside, image, moved = neighbours(mesh), _images(mesh), {}
    for i, p in enumerate(mesh.points):
        near = []
        if p[0] < 0.0:
            continue
        for b in beside[i]:
            if values[b] * values[i] < 0.0 and values[i] / (values[i] - values[b]) <= snap:
                near.append(lerp(p, mesh.points[b], values[i] / (values[i] - values[b])))
        if near:
            moved[i] = _onto(body, mean(near), 0.5 * max(length(sub(q, p)) for q in near) + 1e-6)
    for i, p in moved.items():
        mesh.points[i], mesh.points[image[i]] = p, across_middle(p)
        values[i] = values[image[i]] = 0.0


def _cut(mesh, body, values, material):
    """Cuts faces along the line on which values are 0; those below it get the material."""
    image, added = _images(mesh), {}
    for i, b in sorted({(min(e), max(e)) for e in mesh.directed_edges()}):
        if values[i] * values[b] < 0.0 and (i, b) not in added:
            t = values[i] / (values[i] - values[b])
            p = lerp(mesh.points[i], mesh.points[b], t)
            p = _onto(body, p, 0.1 * length(sub(mesh.points[i], mesh.points[b])))
            other = (image[i], image[b])
            if set(other) == {i, b}:
                p = (0.0, p[1], p[2])
            added[i, b] = mesh.add_point(p)
            values.append(0.0)
            if set(other) != {i, b}:
                added[min(other), max(other)] = mesh.add_point(across_middle(p))
                values.append(0.0)
    faces = []
    for face in mesh.faces:
        corners = []
        for a, b in zip(face.corners, face.corners[1:] + face.corners[:1]):
            corners.append(a)
            between = added.get((min(a, b), max(a, b)))
            if between is not None:
                corners.append(between)
        pieces = _pieces(corners, values)
        for piece in pieces:
            side = sum(values[c] for c in piece)
            faces.append(face._replace(corners=tuple(piece), material=material if side < 0.0 else face.material))
    mesh.faces = faces


def _pieces(corners, values):
    """A polygon cut along the line between its two corners of value 0, if it lies on both sides of it."""
    zeros = [n for n, c in enumerate(corners) if values[c] == 0.0]
    if len(zeros) != 2:
        return [corners]
    first, last = zeros
    one, other = corners[first:last + 1], corners[last:] + corners[:first + 1]
    if len(one) < 3 or len(other) < 3:
        return [corners]
    return [one, other]


# ---- Fields for painting ----

def within(centre, radius, both=True):
    """Inside a ball, and its mirror image."""
    def field(p):
        q = (abs(p[0]), p[1], p[2]) if both else p
        return length(sub(q, centre)) - radius
    return field


def beyond(origin, direction):
    """On the side of a plane that `direction` points to."""
    normal = unit(direction)
    return lambda p: -dot(sub((abs(p[0]), p[1], p[2]), origin), normal)


def along(start, end, radius, end_radius=None):
    """Near a line, and its mirror image."""
    axis = sub(end, start)
    squared, grow = dot(axis, axis), (radius if end_radius is None else end_radius) - radius

    def field(p):
        q = sub((abs(p[0]), p[1], p[2]), start)
        t = min(max(dot(q, axis) / squared, 0.0), 1.0)
        return length(sub(q, scale(axis, t))) - radius - t * grow
    return field


def both_of(*fields):
    return lambda p: max(f(p) for f in fields)


def either_of(*fields):
    return lambda p: min(f(p) for f in fields)


def outside(field):
    return lambda p: -field(p)


def smile_about(centre, radius, inner_radius, height):
    """The lower part of a ring: between two balls, and below a height."""
    return both_of(within(centre, radius, both=False), outside(within(centre, inner_radius, both=False)),
                   beyond((0.0, height, 0.0), (0.0, -1.0, 0.0)))
