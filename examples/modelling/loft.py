"""Lofting: closed quad meshes swept along a curve, with rounded ends that need neither fans nor n-gons.

A `surface` is anything with two methods: `centre(s)`, a point of the axis at s metres along it, and `point(s, angle)`,
the point of the skin there. `loft` cuts a piece out of it, from one joint to the next. The piece extends a little past
each joint and ends in a round cap inside its neighbour, so that the joint has neither a gap when bent nor a step when straight.

Python 3 standard library only.
"""

import math
from bisect import bisect_right
from collections import namedtuple

from quad_mesh import QuadMesh, add, cross, dot, length, lerp, scale, sub, unit


def hermite(start, slope_start, end, slope_end, t):
    """The cubic from start (t = 0) to end (t = 1) with the given slopes there; works on tuples of any length."""
    h00, h10 = (1 + 2 * t) * (1 - t) ** 2, t * (1 - t) ** 2
    h01, h11 = t * t * (3 - 2 * t), t * t * (t - 1)
    return tuple(h00 * a + h10 * ma + h01 * b + h11 * mb for a, ma, b, mb in zip(start, slope_start, end, slope_end))


class Keys:
    """Values keyed along a parameter, joined by a cubic with continuous slope (Catmull-Rom on uneven knots).
    Beyond the ends it continues in a straight line."""

    def __init__(self, rows):
        self.at = [row[0] for row in rows]
        self.values = [tuple(float(v) for v in row[1:]) for row in rows]
        count = len(rows)
        chords = [tuple((b - a) / (self.at[i + 1] - self.at[i]) for a, b in zip(self.values[i], self.values[i + 1]))
                  for i in range(count - 1)]
        self.slopes = []
        for i in range(count):
            if i in (0, count - 1):
                self.slopes.append(chords[0 if i == 0 else -1])
            else:
                before, after = self.at[i] - self.at[i - 1], self.at[i + 1] - self.at[i]
                self.slopes.append(lerp(chords[i - 1], chords[i], before / (before + after)))

    def __call__(self, t):
        if t <= self.at[0]:
            return tuple(v + m * (t - self.at[0]) for v, m in zip(self.values[0], self.slopes[0]))
        if t >= self.at[-1]:
            return tuple(v + m * (t - self.at[-1]) for v, m in zip(self.values[-1], self.slopes[-1]))
        i = bisect_right(self.at, t) - 1
        span = self.at[i + 1] - self.at[i]
        return hermite(self.values[i], tuple(span * m for m in self.slopes[i]), self.values[i + 1],
                       tuple(span * m for m in self.slopes[i + 1]), (t - self.at[i]) / span)

    def slope(self, t, step=1e-4):
        return tuple((b - a) / (2 * step) for a, b in zip(self(t - step), self(t + step)))


def oval(angle, width, up, down, power=2.0):
    """A point (side, up) of a superellipse whose upper and lower halves differ. Angles start at the bottom and turn
    towards +side: 0 bottom, 90° side, 180° top. Power 2 is an ellipse, more is boxier."""
    sine, cosine = math.sin(angle), math.cos(angle)
    height = down if cosine > 0.0 else up
    reach = (abs(sine) ** power + abs(cosine) ** power) ** (-1.0 / power)
    return width * reach * sine, -height * reach * cosine


class Tube:
    """A surface along an axis that lies in a plane: `across` is the plane's normal, where angle 90° points.

    axis: Keys over metres of x, y, z; profile: Keys over metres of width, up, down.
    """

    def __init__(self, axis, profile, across, power=2.0):
        self.axis, self.profile, self.across, self.power = axis, profile, unit(across), power

    def centre(self, s):
        return self.axis(s)

    def frame(self, s):
        along = unit(self.axis.slope(s))
        return self.across, cross(along, self.across), along

    def point(self, s, angle):
        across, upward, _ = self.frame(s)
        side, height = oval(angle, *self.profile(s), self.power)
        return add(self.centre(s), add(scale(across, side), scale(upward, height)))

    def distance(self, point, start, end, samples=48):
        """Approximate distance of the point from the skin between start and end, in metres; negative inside."""
        step = (end - start) / samples
        best = min((start + step * i for i in range(samples + 1)), key=lambda s: length(sub(point, self.centre(s))))
        for _ in range(3):
            along = unit(self.axis.slope(best))
            best = min(max(best + dot(sub(point, self.centre(best)), along), start), end)
        across, upward, _ = self.frame(best)
        offset = sub(point, self.centre(best))
        reach = length(offset)
        if reach < 1e-9:
            return -min(self.profile(best))
        angle = math.atan2(dot(offset, across), -dot(offset, upward))
        side, height = oval(angle, *self.profile(best), self.power)
        return reach - math.hypot(side, height)


class Collar:
    """A tube that joins another body, such as a limb a trunk. It widens to a fillet where they join.

    outside(point): signed distance to the other skin. The ring at `self.at` metres is a circle drawn on that skin
    around the point where the tube's axis crosses it, `flare` metres wider than the tube and `sink` metres under the
    skin, so that both meshes cross in one line. From `reach` metres further out the tube has its own radius."""

    def __init__(self, tube, outside, flare, reach, sink):
        self.tube, self.outside, self.flare, self.reach, self.sink = tube, outside, flare, reach, sink
        self.centre, self.profile = tube.centre, tube.profile
        low, high = 0.0, 4.0 * reach
        for _ in range(40):
            self.at = 0.5 * (low + high)
            low, high = (self.at, high) if outside(tube.centre(self.at)) < 0.0 else (low, self.at)
        base, step = tube.centre(self.at), 1e-4
        self.normal = unit(tuple(outside(add(base, scale(axis, step))) - outside(sub(base, scale(axis, step)))
                                 for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))))

    def _spoke(self, angle):
        """The tube's radius vector at this angle where it joins, rotated into the other skin's tangent plane."""
        base, along = self.centre(self.at), unit(self.tube.axis.slope(self.at))
        radial = sub(self.tube.point(self.at, angle), base)
        # the smallest rotation that takes `along` to the normal, after Rodrigues
        axis, cosine = cross(along, self.normal), dot(along, self.normal)
        return add(add(scale(radial, cosine), cross(axis, radial)), scale(axis, dot(axis, radial) / (1.0 + cosine)))

    def _on_skin(self, angle):
        spoke = self._spoke(angle)
        spot = add(self.centre(self.at), scale(spoke, 1.0 + self.flare / length(spoke)))
        low, high = -0.06, 0.06
        for _ in range(32):
            middle = 0.5 * (low + high)
            inside = self.outside(add(spot, scale(self.normal, middle))) < -self.sink
            low, high = (middle, high) if inside else (low, middle)
        return add(spot, scale(self.normal, low))

    def point(self, s, angle):
        part = (s - self.at) / self.reach
        if part >= 1.0:
            return self.tube.point(s, angle)
        seam = self._on_skin(angle)
        if part <= 0.0:
            root = add(self.centre(min(s, 0.0)), scale(self._spoke(angle), 0.6))
            return lerp(root, seam, s / self.at) if s > 0.0 else root
        end = self.at + self.reach
        goal = self.tube.point(end, angle)
        span = length(sub(goal, seam))
        leaving = scale(sub(self.normal, scale(unit(self._spoke(angle)), 0.8)), 0.8 * span)
        arriving = scale(unit(sub(goal, self.tube.point(end - 1e-3, angle))), span)
        return hermite(seam, leaving, goal, arriving, part)


# depth: metres from the joint to the tip; loops: positions of extra rings, as fractions of the depth; power: 2 is an
# ellipsoid, more keeps full width for longer; grid: how many quads wide the closing patch is (even).
Cap = namedtuple("Cap", "depth loops power grid", defaults=((0.3,), 2.7, 4))


def _cap_scale(part, power):
    return (1.0 - part ** power) ** (1.0 / power)


def _cap_ring(surface, joint, angles, cap, sign, part):
    """The ring at `part` of a cap's depth. It goes straight on from the joint, like a ball, whatever the axis does
    there, and takes over the taper of the skin beyond the joint, so that it stays inside a thinner neighbour."""
    beyond = joint + sign * cap.depth * part
    ahead = scale(_along(surface, joint), sign * cap.depth * part)
    ring = []
    for angle in angles:
        spoke = sub(surface.point(joint, angle), surface.centre(joint))
        taper = length(sub(surface.point(beyond, angle), surface.centre(beyond))) / length(spoke)
        ring.append(add(add(surface.centre(joint), ahead), scale(spoke, min(taper, 1.0) * _cap_scale(part, cap.power))))
    return ring


def _along(surface, s):
    return unit(sub(surface.centre(s + 1e-4), surface.centre(s - 1e-4)))


def border_walk(columns, rows=None):
    """(row, column) of the border points of a grid of columns x rows quads, from (0, 0) along row 0 and around."""
    rows = columns if rows is None else rows
    return ([(0, c) for c in range(columns)] + [(r, columns) for r in range(rows)]
            + [(rows, c) for c in range(columns, 0, -1)] + [(r, 0) for r in range(rows, 0, -1)])


def coons(border, columns, rows, row, column):
    """A point inside a grid, interpolated from its border, a map from (row, column) to points: the bilinear patch of S. Coons
    (1967). Also returns the point's relative radius: 0 in the middle, 1 on the border."""
    u, v = column / columns, row / rows
    sides = add(lerp(border[0, column], border[rows, column], v), lerp(border[row, 0], border[row, columns], u))
    corners = lerp(lerp(border[0, 0], border[0, columns], u), lerp(border[rows, 0], border[rows, columns], u), v)
    rho = math.sqrt(1.0 - 16.0 * u * (1.0 - u) * v * (1.0 - v))
    return sub(sides, corners), rho


def _close(mesh, surface, ring_ids, end, cap, sign, uv_corner, material):
    """Close a tube over its last ring with a domed patch of quads, cap.grid wide, centred on the bottom of the ring."""
    count = len(ring_ids)
    columns, rows = cap.grid, count // 2 - cap.grid
    walk = border_walk(columns, rows)
    ids = {position: ring_ids[(i - columns // 2) % count] for i, position in enumerate(walk)}
    border = {position: mesh.points[i] for position, i in ids.items()}
    last = cap.loops[-1] if cap.loops else 0.0
    along = scale(_along(surface, end), sign * cap.depth)
    for row in range(1, rows):
        for column in range(1, columns):
            flat, rho = coons(border, columns, rows, row, column)
            rise = _cap_scale(rho * _cap_scale(last, cap.power), cap.power) - last
            ids[row, column] = mesh.add_point(add(flat, scale(along, rise)))
    for row in range(rows):
        beside = columns // 2 + row
        for column in range(columns):
            positions = [(row, column), (row, column + 1), (row + 1, column + 1), (row + 1, column)]
            if sign < 0:
                positions.reverse()
            uvs = [(uv_corner[0] + 0.24 * c / columns, uv_corner[1] + 0.24 * r / rows) for r, c in positions]
            mesh.add_face([ids[position] for position in positions], uvs,
                          material(end + sign * cap.depth, beside if 2 * column >= columns else count - 1 - beside))


def loft(name, surface, stations, angles, start_cap, end_cap, material):
    """A closed piece of the surface.

    stations: metres along the axis, ascending, first and last at the joints; angles(s): radians, ascending from the
    bottom (0), mirrored left to right, their count a multiple of 4; material(s, k) names the material of the face after
    angle k at s metres (on a closing patch, k is the face at the same height on the patch's border). Points lie ring by
    ring, point (ring, k) at ring * count + k, the rings of the start cap first; the quads of the end patch come last.
    Uvs: the tube unrolled over v 0.26..1, seam at the bottom, the two patches in the corners below."""
    mesh = QuadMesh(name)
    first, last = stations[0], stations[-1]
    rings = [(first - start_cap.depth * part, _cap_ring(surface, first, angles(first), start_cap, -1, part))
             for part in reversed(start_cap.loops)]
    rings += [(s, [surface.point(s, angle) for angle in angles(s)]) for s in stations]
    rings += [(last + end_cap.depth * part, _cap_ring(surface, last, angles(last), end_cap, 1, part))
              for part in end_cap.loops]
    count = len(angles(first))
    for _, ring in rings:
        for point in ring:
            mesh.add_point(point)
    span = rings[-1][0] - rings[0][0]
    for i in range(len(rings) - 1):
        v0, v1 = (0.26 + 0.74 * (rings[j][0] - rings[0][0]) / span for j in (i, i + 1))
        for k in range(count):
            after = (k + 1) % count
            mesh.add_face((i * count + k, i * count + after, (i + 1) * count + after, (i + 1) * count + k),
                          ((k / count, v0), ((k + 1) / count, v0), ((k + 1) / count, v1), (k / count, v1)),
                          material(0.5 * (rings[i][0] + rings[i + 1][0]), k))
    _close(mesh, surface, list(range(count)), first, start_cap, -1, (0.0, 0.0), material)
    top = (len(rings) - 1) * count
    _close(mesh, surface, list(range(top, top + count)), last, end_cap, 1, (0.26, 0.0), material)
    return mesh


def inset_rings(mesh, patch, rings, inner, ring_materials, inner_material):
    """Replace a square patch of faces by concentric rings around a smaller square patch: an eye.

    patch: (n + 1) x (n + 1) point indices, rows of columns, whose faces are replaced; rings: lists of 4n points from
    the outside in, in the order of border_walk(n); inner: (n + 1) x (n + 1) points, of which the border is ignored (it
    is the last ring); ring_materials: one name per ring; inner_material(row, column): a name.
    Points of the old patch stay in the mesh, unused."""
    size = len(patch) - 1
    walk = border_walk(size)
    old = {frozenset((patch[r][c], patch[r][c + 1], patch[r + 1][c + 1], patch[r + 1][c]))
           for r in range(size) for c in range(size)}
    replaced = [face for face in mesh.faces if frozenset(face.corners) in old]
    mesh.faces = [face for face in mesh.faces if frozenset(face.corners) not in old]
    uv_of = {c: uv for face in replaced for c, uv in zip(face.corners, face.uvs)}
    edge = (patch[0][0], patch[0][1])
    forward = any(edge in zip(f.corners, f.corners[1:] + f.corners[:1]) for f in replaced)

    def put(corners, uvs, material):
        mesh.add_face(corners if forward else corners[::-1], uvs if forward else uvs[::-1], material)

    outer = [patch[r][c] for r, c in walk]
    border_uvs = outer_uvs = [uv_of[i] for i in outer]
    middle_uv = tuple(sum(uv[i] for uv in border_uvs) / len(walk) for i in (0, 1))
    for number, (ring, material) in enumerate(zip(rings, ring_materials), 1):
        ids = [mesh.add_point(p) for p in ring]
        uvs = [lerp(uv, middle_uv, 0.75 * number / len(rings)) for uv in border_uvs]
        for i in range(4 * size):
            j = (i + 1) % (4 * size)
            put((outer[i], outer[j], ids[j], ids[i]), (outer_uvs[i], outer_uvs[j], uvs[j], uvs[i]), material)
        outer, outer_uvs = ids, uvs
    index, uv = dict(zip(walk, outer)), dict(zip(walk, outer_uvs))
    for r in range(1, size):
        for c in range(1, size):
            index[r, c] = mesh.add_point(inner[r][c])
            uv[r, c] = lerp(uv_of[patch[r][c]], middle_uv, 0.75)
    for r in range(size):
        for c in range(size):
            positions = ((r, c), (r, c + 1), (r + 1, c + 1), (r + 1, c))
            put(tuple(index[p] for p in positions), tuple(uv[p] for p in positions), inner_material(r, c))
