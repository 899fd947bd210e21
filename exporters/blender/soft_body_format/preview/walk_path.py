"""A path on the ground, and speeds that follow it by steering to a point ahead on the path ("pure pursuit").

Ground coordinates are asset space's (x, z) in metres; a heading of 0 faces +z and grows to the left, towards +x, as the runtime's."""

import math

import bpy
import numpy

GAIN, MAX_TURN = 2.5, 2.5  # 1/s, rad/s


def wrapped(angle):
    return (angle + math.pi) % (2 * math.pi) - math.pi


class WalkPath:
    """A polyline. A closed one ends at its first point."""

    def __init__(self, points, closed):
        points = numpy.asarray(points, dtype=float).reshape(-1, 2)
        if closed:
            points = numpy.concatenate([points, points[:1]])
        steps = numpy.linalg.norm(numpy.diff(points, axis=0), axis=1)
        kept = numpy.concatenate([[True], steps > 1e-9])
        self.points, self.closed = points[kept], closed
        self.along = numpy.concatenate([[0.0], numpy.cumsum(steps[steps > 1e-9])])

    @property
    def length(self):
        return float(self.along[-1])

    def at(self, along):
        along = along % self.length if self.closed else min(max(along, 0.0), self.length)
        return numpy.array([numpy.interp(along, self.along, self.points[:, axis]) for axis in (0, 1)])

    def heading(self, along):
        here, there = self.at(along), self.at(along + max(1e-3 * self.length, 1e-4))
        if numpy.allclose(here, there):
            here = self.at(along - max(1e-3 * self.length, 1e-4))
        return math.atan2(there[0] - here[0], there[1] - here[1])


class Walker:
    """Follows a path: stores the distance along it, and steers to the next point."""

    def __init__(self, path, size_m):
        self.path, self.size_m, self.pass_name = path, size_m, 0.0

    def begin(self):
        self.pass_name = 0.0

    def drive(self, position, heading, speed):
        """(forward speed, turn rate) for a character at `position`; zeros at the end of the path."""
        window = max(self.size_m, 2 * speed / 10)
        near = self.pass_name + numpy.linspace(0, window, 33)
        if not self.path.closed:
            near = numpy.minimum(near, self.path.length)
        gaps = [float(numpy.linalg.norm(self.path.at(one) - position)) for one in near]
        self.pass_name = float(near[int(numpy.argmin(gaps))])
        if not self.path.closed and self.path.length - self.pass_name < 0.05 * self.size_m:
            return 0.0, 0.0
        target = self.path.at(self.pass_name + max(0.4 * self.size_m, 0.5 * speed))
        to = target - position
        off = wrapped(math.atan2(to[0], to[1]) - heading)
        return speed * max(0.1, math.cos(off)), max(-MAX_TURN, min(MAX_TURN, GAIN * off))


def path_of(curve, space, depsgraph):
    """The first spline of a curve object at its resolution, seen from above; None if it is not a line."""
    data = curve.data.copy()
    data.bevel_depth = data.extrude = 0
    data.bevel_object = None
    temporary = bpy.data.objects.new(curve.name, data)
    try:
        mesh = temporary.to_mesh()
        positions = [vertex.co.copy() for vertex in mesh.vertices]
        edges = [tuple(edge.vertices) for edge in mesh.edges]
        temporary.to_mesh_clear()
    finally:
        bpy.data.objects.remove(temporary)
        bpy.data.curves.remove(data)
    order, closed = chain(edges, len(positions))
    if len(order) < 2:
        return None
    world = curve.evaluated_get(depsgraph).matrix_world
    points = [space.point(world @ positions[index]) for index in order]
    path = WalkPath([(x, z) for x, _, z in points], closed)
    return path if path.length > 0 else None


def chain(edges, count):
    """The vertices of the first chain of edges, in order, and whether the chain is closed."""
    beside = {}
    for one, other in edges:
        beside.setdefault(one, []).append(other)
        beside.setdefault(other, []).append(one)
    order, before, here = [], None, 0 if count else None
    while here is not None and here in beside:
        order.append(here)
        onward = [one for one in beside[here] if one != before]
        before, here = here, onward[0] if onward else None
        if here == order[0]:
            return order, len(order) > 2
    return order, False
