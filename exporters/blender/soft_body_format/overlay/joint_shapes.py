"""Shapes of joint limits: cones and arcs as lines and triangles, in the joint's own frame.

+X is the axis of the twist; a ball joint's bone points along it. Coordinates are those of spec/sbf.md: swing is a rotation vector
(0, y, z), twist an angle about X. Lengths are fractions of the bone's length."""

import math

import numpy

STEPS = 12  # points a side of the rim, or an eighth of a turn
CONE, TWIST, SWING_Y, SWING_Z, SLIDE = "cone", "twist", "swing_y", "swing_z", "slide"


class Shape:
    """Lines and filled triangles of each part: {part: (n, 3) line ends or triangle corners}."""

    def __init__(self):
        self.lines, self.triangles = {}, {}

    def add_line(self, part, points, closed=False):
        points = numpy.asarray(points, dtype=float).reshape(-1, 3)
        if closed:
            points = numpy.concatenate([points, points[:1]])
        pairs = numpy.stack([points[:-1], points[1:]], axis=1).reshape(-1, 3)
        self.lines[part] = numpy.concatenate([self.lines[part], pairs]) if part in self.lines else pairs

    def add_fan(self, part, middle, points, closed=False):
        points = numpy.asarray(points, dtype=float).reshape(-1, 3)
        if closed:
            points = numpy.concatenate([points, points[:1]])
        fan = numpy.stack([numpy.broadcast_to(middle, points[:-1].shape), points[:-1], points[1:]], axis=1).reshape(-1, 3)
        self.triangles[part] = numpy.concatenate([self.triangles[part], fan]) if part in self.triangles else fan


def swing_direction(y, z):
    """The direction of +X after the swing (y, z)."""
    angle = math.hypot(y, z)
    rate = math.sin(angle) / angle if angle > 1e-9 else 1.0
    return (math.cos(angle), rate * z, -rate * y)


def rim(bounds):
    """The swings on the boundary of the limits, in order; empty if every swing is allowed."""
    if not any(name in bounds for name in ("swing", SWING_Y, SWING_Z)):
        return []
    cone = bounds.get("swing", (0.0, math.pi))[1]
    (y0, y1), (z0, z1) = (bounds.get(name, (-math.pi, math.pi)) for name in (SWING_Y, SWING_Z))
    corners = [(y0, z0), (y1, z0), (y1, z1), (y0, z1)]
    points = [(a[0] + (b[0] - a[0]) * i / (2 * STEPS), a[1] + (b[1] - a[1]) * i / (2 * STEPS))
              for a, b in zip(corners, corners[1:] + corners[:1]) for i in range(2 * STEPS)]
    if y0 <= 0 <= y1 and z0 <= 0 <= z1:  # without a cone the boundary is a box
        sizes = [max(math.hypot(*one), 1e-12) for one in points]
        points = [(y * min(1, cone / size), z * min(1, cone / size)) for (y, z), size in zip(points, sizes)]
    return points


def arc(low, high, position):
    """Points from one angle to the other by `position`, at most a full turn."""
    high = min(high, low + 2 * math.pi)
    count = max(2, 1 + math.ceil((high - low) / (math.pi / 4) * STEPS))
    return [position(low + (high - low) * i / (count - 1)) for i in range(count)]


def shape_of(kind, bounds, along=(1.0, 0.0, 0.0), slide_scale=1.0):
    """The Shape of a joint with `bounds` {coordinate: (min, max)}. `along` is the bone's direction in the joint's frame. `slide_scale`
    converts metres to fractions of the bone's length."""
    shape = Shape()
    if kind == "spherical":
        add_cone(shape, bounds)
        if TWIST in bounds:
            add_arc(shape, TWIST, bounds[TWIST], 0.5, 0.25, lambda angle: (0.0, math.cos(angle), math.sin(angle)))
    elif kind in ("revolute", "cylindrical") and TWIST in bounds:
        add_turn(shape, bounds[TWIST], along)
    if kind in ("prismatic", "cylindrical") and "linear_x" in bounds:
        low, high = (slide_scale * one for one in bounds["linear_x"])
        shape.add_line(SLIDE, [(low, 0, 0), (high, 0, 0)])
        for end in (low, high):
            shape.add_line(SLIDE, [(end, -0.08, 0), (end, 0.08, 0)])
            shape.add_line(SLIDE, [(end, 0, -0.08), (end, 0, 0.08)])
    return shape


def add_cone(shape, bounds):
    points = [swing_direction(*one) for one in rim(bounds)]
    if points:
        shape.add_line(CONE, points, closed=True)
        shape.add_fan(CONE, (0.0, 0.0, 0.0), points, closed=True)
        for index in range(0, len(points), STEPS):
            shape.add_line(CONE, [(0, 0, 0), points[index]])
    for name, position in ((SWING_Y, lambda angle: swing_direction(angle, 0.0)), (SWING_Z, lambda angle: swing_direction(0.0, angle))):
        if name in bounds:
            add_arc(shape, name, bounds[name], 0.0, 0.6, position)


def add_arc(shape, part, bound, at, radius, position):
    """A filled arc about a point of the X axis."""
    middle = numpy.array((at, 0.0, 0.0))
    points = [middle + radius * numpy.array(one) for one in arc(*bound, position)]
    shape.add_line(part, points)
    shape.add_fan(part, middle, points)
    for end in (points[0], points[-1]):
        shape.add_line(part, [middle, end])


def add_turn(shape, bound, along):
    """A hinge's arc: the bone's path as it turns about X. A bone along X gets the arc of a ball joint's twist."""
    side = numpy.array((0.0, along[1], along[2]))
    size = float(numpy.linalg.norm(side))
    if size < 1e-3:
        add_arc(shape, TWIST, bound, 0.5, 0.25, lambda angle: (0.0, math.cos(angle), math.sin(angle)))
        return
    first = side / size
    second = numpy.cross((1.0, 0.0, 0.0), first)
    add_arc(shape, TWIST, bound, 0.0, 0.8, lambda angle: math.cos(angle) * first + math.sin(angle) * second)


def measure(w, x, y, z):
    """{coordinate: angle} of a rotation of the joint's frame from rest, decomposed as the runtime does."""
    if w < 0:
        w, x, y, z = -w, -x, -y, -z
    size = math.hypot(w, x)
    if size < 1e-9:
        half = math.pi / max(math.hypot(y, z), 1e-15)
        return {TWIST: 0.0, SWING_Y: y * half, SWING_Z: z * half, "swing": math.pi}
    c, s = w / size, x / size
    twist = 2 * math.atan2(s, c)
    twist -= 2 * math.pi if twist > math.pi else 0
    swing_y, swing_z = c * y - s * z, c * z + s * y
    sine = math.hypot(swing_y, swing_z)
    rate = 2 * math.atan2(sine, size) / sine if sine > 1e-7 else 2.0
    return {TWIST: twist, SWING_Y: swing_y * rate, SWING_Z: swing_z * rate, "swing": sine * rate}


def is_within(found, bounds, tolerance=1e-3):
    """Whether the angles are within the bounds."""
    return all(low - tolerance <= found[name] <= high + tolerance for name, (low, high) in bounds.items() if name in found)
