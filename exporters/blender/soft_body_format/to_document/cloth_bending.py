"""Computes the flexural rigidity with which a sheet of the format bends as stiffly as Blender's cloth."""

import numpy

from .blender_units import hinge_torque


def flexural_rigidity(geometry, bending):
    """Flexural rigidity D in N·m. Blender's cloth bends where polygons share a side. The format's bends where triangles do, with
    stiffness D L² over the area of both. D makes the sums of both stiffnesses over all sides equal."""
    sides, lengths, torques, areas = sides_of(geometry, bending)
    shared, which, counts = numpy.unique(sides, axis=0, return_inverse=True, return_counts=True)
    if not len(shared):
        return 0.0
    which = which.reshape(-1)
    two = counts == 2
    torque = numpy.bincount(which, torques, len(shared))[two] / 2  # of both polygons the mean
    area = numpy.bincount(which, areas, len(shared))[two]
    length = numpy.bincount(which, lengths, len(shared))[two] / 2
    turned = float((length**2 / numpy.maximum(area, 1e-12)).sum())
    return float(torque.sum()) / turned if turned > 0 else 0.0


def sides_of(geometry, bending):
    """Arrays over all sides of all polygons: the two points in order, the length, the polygon's torque about the side, and the area
    of the triangle at the side."""
    positions, points = geometry.positions.astype(numpy.float64), geometry.polygon_points.astype(numpy.int64)
    sizes = geometry.polygon_sizes.astype(numpy.int64)
    owner = numpy.repeat(numpy.arange(len(sizes)), sizes)
    first = numpy.repeat(numpy.cumsum(sizes) - sizes, sizes)
    size, index = sizes[owner], numpy.arange(len(points)) - first
    begin, end = points, points[first + (index + 1) % size]
    third = points[first + numpy.select([index == 0, index == size - 1], [2, size - 2], 0)]  # of the fan from the first corner
    middle = numpy.stack([numpy.bincount(owner, positions[points, axis], len(sizes)) for axis in range(3)], axis=1) / sizes[:, None]
    edge = positions[end] - positions[begin]
    length = numpy.linalg.norm(edge, axis=1)
    distance = numpy.linalg.norm(numpy.cross(edge, middle[owner] - positions[begin]), axis=1) / numpy.maximum(length, 1e-12)
    area = numpy.linalg.norm(numpy.cross(edge, positions[third] - positions[begin]), axis=1) / 2
    return numpy.sort(numpy.stack((begin, end), axis=1), axis=1), length, hinge_torque(bending, length, distance), area
