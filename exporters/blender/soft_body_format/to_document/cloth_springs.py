"""Writes cloth as a level of springs like Blender's. This is needed where one modulus is not enough: with internal springs, or if
compression and tension differ.

The force of Blender's cloth springs is the slider times the strain over the mesh's mean edge, independent of their own length."""

import numpy
from mathutils.bvhtree import BVHTree

from .blender_units import cloth_damping, cloth_stiffness
from .soft_bodies import add_level, diagonals_of, edges_of, mean_edge, weights_of


# Kind, tension slider, compression slider (None: Blender's springs only pull), damping, vertex group that scales up to the maximum.
KINDS = (("structural", "tension_stiffness", "compression_stiffness", "tension_damping", "vertex_group_structural_stiffness"),
         ("shear", "shear_stiffness", None, "shear_damping", "vertex_group_shear_stiffness"),
         ("internal", "internal_tension_stiffness", "internal_compression_stiffness", "tension_damping", "vertex_group_intern"))


def wanted(cloth):
    return cloth.use_internal_springs or differ(cloth.compression_stiffness, cloth.tension_stiffness)


def write_level(writer, body, source, geometry, cloth):
    """Writes springs along edges, diagonals and through the inside. The layer itself resists bending."""
    edge = mean_edge(geometry)
    masses = numpy.full(len(geometry.positions), cloth.mass)
    level = add_level(writer, body, source, geometry, "Cloth", masses)
    pairs = {"structural": edges_of(geometry), "shear": diagonals_of(geometry),
             "internal": inner_pairs(writer, source, geometry, cloth) if cloth.use_internal_springs else ()}
    for kind, drawing, pressing, damping, group in KINDS:
        ends, drawn, pressed = pairs[kind], getattr(cloth, drawing), getattr(cloth, pressing) if pressing else 0.0
        if not len(ends) or not drawn:
            continue
        factors = group_factors(weights_of(source, geometry.mesh, getattr(cloth, group)), ends, drawn, getattr(cloth, f"{drawing}_max"))
        level.add("springs", kind=kind, ends=ends, stiffness=(cloth_stiffness(drawn, edge) * factors).astype(numpy.float32),
                  damping=[cloth_damping(getattr(cloth, damping))], compression_ratio=[pressed / drawn] if differ(pressed, drawn) else [])


def differ(one, other):
    """Whether two values differ by more than 1 %."""
    return abs(one - other) > 0.01 * max(one, other)


def group_factors(weights, ends, slider, max_slider):
    """Factors from the slider at weight 0 to its maximum at weight 1; the mean of both ends."""
    if weights is None:
        return numpy.ones(len(ends))
    return 1 + (max(max_slider / slider, 1.0) - 1) * (weights[ends[:, 0]] + weights[ends[:, 1]]) / 2


def inner_pairs(writer, source, geometry, cloth):
    """Pairs of each vertex and the nearest corner of the polygon that a ray inwards hits within the largest length. Each pair once."""
    mesh, positions = geometry.mesh, geometry.positions.astype(float)
    polygons = numpy.split(geometry.polygon_points, numpy.cumsum(geometry.polygon_sizes.astype(numpy.int64))[:-1])
    tree = BVHTree.FromPolygons(positions.tolist(), [one.tolist() for one in polygons])
    own = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
    mesh.vertices.foreach_get("normal", own)
    inwards = -writer.space.normals(own.reshape(-1, 3), source.matrix_world).astype(float) * (-1 if geometry.mirrored else 1)
    longest = cloth.internal_spring_max_length * writer.space.unit_m or 1e6
    weights = weights_of(source, mesh, cloth.vertex_group_intern)
    start, pairs = 1e-4 * mean_edge(geometry), set()
    for index, (position, inward) in enumerate(zip(positions, inwards)):
        if weights is not None and weights[index] <= 0:
            continue
        _, normal, number, _ = tree.ray_cast((position + start * inward).tolist(), inward.tolist(), longest)
        if number is None or cloth.internal_spring_normal_check and normal.dot(inward) < 0 and not geometry.mirrored:
            continue
        other = min(polygons[number].tolist(), key=lambda corner: ((positions[corner] - position)**2).sum())
        if other != index and ((positions[other] - position)**2).sum() <= longest**2:
            pairs.add((min(index, other), max(index, other)))
    return numpy.array(sorted(pairs), dtype=numpy.uint32).reshape(-1, 2)
