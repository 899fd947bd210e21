"""How stiffly a cloth bends: the rigidity with which a sheet of the format turns as hard at its sides as Blender's does."""

import numpy

from .blender_units import hinge_torque


def flexural_rigidity(geometry, bending):
    """N·m. Blender turns polygons about the sides that they share; the format the triangles that they are cut into, by D L² over the
    area of both. D is the one that makes the sum of all sides' stiffnesses the same."""
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
    """Of every side of every polygon: its two points in order, its length, the torque of the polygon about it, and the area of the
    triangle that it is part of."""
    places, points = geometry.positions.astype(numpy.float64), geometry.polygon_points.astype(numpy.int64)
    sizes = geometry.polygon_sizes.astype(numpy.int64)
    owner = numpy.repeat(numpy.arange(len(sizes)), sizes)
    first = numpy.repeat(numpy.cumsum(sizes) - sizes, sizes)
    size, place = sizes[owner], numpy.arange(len(points)) - first
    begin, end = points, points[first + (place + 1) % size]
    third = points[first + numpy.select([place == 0, place == size - 1], [2, size - 2], 0)]  # of the fan from the first corner
    middle = numpy.stack([numpy.bincount(owner, places[points, axis], len(sizes)) for axis in range(3)], axis=1) / sizes[:, None]
    way = places[end] - places[begin]
    length = numpy.linalg.norm(way, axis=1)
    distance = numpy.linalg.norm(numpy.cross(way, middle[owner] - places[begin]), axis=1) / numpy.maximum(length, 1e-12)
    area = numpy.linalg.norm(numpy.cross(way, places[third] - places[begin]), axis=1) / 2
    return numpy.sort(numpy.stack((begin, end), axis=1), axis=1), length, hinge_torque(bending, length, distance), area
