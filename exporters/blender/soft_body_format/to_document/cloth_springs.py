"""Cloth with internal springs: a level of springs as Blender makes them, since a layer's modulus says nothing of what is inside it.

Blender's springs of a cloth pull by their slider times the strain over the mesh's mean edge, whatever their own length."""

import numpy
from mathutils.bvhtree import BVHTree

from .blender_units import TIME_UNIT_S, cloth_stiffness
from .soft_bodies import add_level, diagonals_of, edges_of, mean_edge, weights_of


def write_level(writer, body, source, geometry, cloth):
    """Edges, diagonals, and springs through the inside; bending is the layer's own."""
    edge = mean_edge(geometry)
    masses = numpy.full(len(geometry.positions), cloth.mass)
    level = add_level(writer, body, source, geometry, "Cloth", masses)
    for kind, ends, slider, damping in (
            ("structural", edges_of(geometry), cloth.tension_stiffness, cloth.tension_damping),
            ("shear", diagonals_of(geometry), cloth.shear_stiffness, cloth.shear_damping),
            ("internal", inner_pairs(writer, source, geometry, cloth), cloth.internal_tension_stiffness, cloth.tension_damping)):
        if len(ends):
            stiffness = cloth_stiffness(slider, edge)
            factors = group_factors(source, geometry, cloth, ends) if kind == "internal" else numpy.ones(len(ends))
            level.add("springs", kind=kind, ends=ends, stiffness=(stiffness * factors).astype(numpy.float32),
                      damping=[stiffness * TIME_UNIT_S * 0.01 * damping / max(slider, 1e-6)])


def group_factors(source, geometry, cloth, ends):
    """From the slider at weight 0 to its maximum at weight 1, the mean of both ends."""
    weights = weights_of(source, geometry.mesh, cloth.vertex_group_intern)
    if weights is None or cloth.internal_tension_stiffness <= 0:
        return numpy.ones(len(ends))
    ratio = max(cloth.internal_tension_stiffness_max / cloth.internal_tension_stiffness, 1.0)
    return 1 + (ratio - 1) * (weights[ends[:, 0]] + weights[ends[:, 1]]) / 2


def inner_pairs(writer, source, geometry, cloth):
    """Each vertex and the nearest corner of what lies straight inwards from it, within the greatest length; each pair once."""
    mesh, positions = geometry.mesh, geometry.positions.astype(float)
    polygons = numpy.split(geometry.polygon_points, numpy.cumsum(geometry.polygon_sizes.astype(numpy.int64))[:-1])
    tree = BVHTree.FromPolygons(positions.tolist(), [one.tolist() for one in polygons])
    own = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
    mesh.vertices.foreach_get("normal", own)
    inwards = -writer.space.normals(own.reshape(-1, 3), source.matrix_world).astype(float) * (-1 if geometry.mirrored else 1)
    longest = cloth.internal_spring_max_length * writer.space.unit_m or 1e6
    weights = weights_of(source, mesh, cloth.vertex_group_intern)
    start, pairs = 1e-4 * mean_edge(geometry), set()
    for index, (place, way) in enumerate(zip(positions, inwards)):
        if weights is not None and weights[index] <= 0:
            continue
        _, normal, number, _ = tree.ray_cast((place + start * way).tolist(), way.tolist(), longest)
        if number is None or cloth.internal_spring_normal_check and normal.dot(way) < 0 and not geometry.mirrored:
            continue
        other = min(polygons[number].tolist(), key=lambda corner: ((positions[corner] - place)**2).sum())
        if other != index and ((positions[other] - place)**2).sum() <= longest**2:
            pairs.add((min(index, other), max(index, other)))
    return numpy.array(sorted(pairs), dtype=numpy.uint32).reshape(-1, 2)
