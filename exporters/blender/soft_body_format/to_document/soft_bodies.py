"""Writes Blender's Soft Body modifier: edges as a level of springs and the goal as pins, in SI units."""

import math

import numpy

from ..sbfmt.document import Record
from ..space import frame_rate
from .blender_units import PINNED_GOAL, TIME_UNIT_S, air_density, drag_on_soft_body, edge_stiffness, field_on_soft_body, friction, goal_of, \
    goal_stiffness, push_ratio
from .pins import group_by_bone
from .roles import modifier

FRICTION_ALONE = 1e-3  # N/m of a goal with friction and no stiffness: nearly 0, because 0 means the body's own stiffness
DEFAULT_ERROR = 0.1  # Blender's error limit, in its units
DEFAULT_STEPS = (10, 300)  # per frame, minimum and maximum
STIFF_QUAD_LIMIT = 1e-4  # below it diagonals from Blender's shear slider have no effect


def settings_of(source):
    found = modifier(source, "SOFT_BODY")
    return found.settings if found is not None else None


def fill_from_soft_body(writer, body, source, geometry, soft):
    """Writes all settings of the modifier, and reports those without a counterpart."""
    count = len(geometry.positions)
    masses = vertex_masses(source, geometry.mesh, soft)
    attributes = body.attributes
    attributes.mass = float(masses.sum())
    attributes.media_friction = friction(soft.friction) / (attributes.mass / count)
    point_kg = attributes.mass / count
    writer.field_effects[source.name] = (field_on_soft_body(point_kg, frame_rate(writer.scene)), drag_on_soft_body(point_kg))
    attributes.damping_ratio = 0
    attributes.gravity_scale = soft.effector_weights.gravity
    if soft.plastic:
        attributes.yield_strain, attributes.yield_flow = 0.05, soft.plastic / 100
    if soft.use_self_collision:
        body.collision.self = True
        body.collision.particle_radius = ball_radius(soft, geometry, writer.space.unit_m)
        if (soft.ball_stiff, soft.ball_damp) != (1.0, 0.5):
            writer.findings.info("stiffness and dampening of its self collision are left out: contact in the file is rigid",
                                 object_name=source.name)
    if soft.use_edges:
        write_level(writer, body, source, geometry, soft, masses)
    if soft.use_goal:
        write_goal(writer, body, source, geometry, soft)
    if soft.use_edges and not soft.pull and soft.push:
        writer.findings.warning(f"its edges push ({soft.push:.2f}) and do not pull, which springs of the format can't: give them a little "
                                "pull", object_name=source.name)
    if soft.use_edges and soft.use_stiff_quads:
        report_large_polygons(writer, source, geometry)
    if soft.aero and soft.use_edges:
        add_air(writer, source, geometry, soft)


def add_air(writer, source, geometry, soft):
    """Writes aerodynamics as the medium of the environment. There is one medium: the densest that a body needs."""
    area = area_of(geometry.mesh, writer.space.unit_m * source.matrix_world.median_scale)
    density = air_density(soft.aero, len(geometry.mesh.edges), max(area, 1e-12))
    environment = writer.asset.environment
    if environment.media_density and abs(environment.media_density - density) > 0.01 * density:
        writer.findings.info(f"its aerodynamics need a medium of {density:.3g} kg/m³ and another body's for "
                             f"{environment.media_density:.3g}; the scene gets the denser one", object_name=source.name)
    environment.media_density = max(environment.media_density, density)


def area_of(mesh, world_scale):
    return sum(polygon.area for polygon in mesh.polygons) * world_scale**2


def report_large_polygons(writer, source, geometry):
    """Reports polygons for which stiff quads do nothing: larger polygons still shear. Triangles are stiff by themselves."""
    large = numpy.flatnonzero(geometry.polygon_sizes > 4)
    if len(large):
        first = numpy.cumsum(geometry.polygon_sizes.astype(numpy.int64)) - geometry.polygon_sizes
        corners = {int(geometry.polygon_points[first[one] + at]) for one in large for at in range(geometry.polygon_sizes[one])}
        writer.findings.warning(f"{len(large)} polygons have more than four corners, so stiff quads do nothing for them: cut them "
                                "into quads (select them, then K, or Face > Triangulate)", object_name=source.name,
                                vertices=sorted(corners))


def vertex_masses(source, mesh, soft):
    """kg of each vertex: the modifier's mass, scaled by its mass group."""
    masses = numpy.full(len(mesh.vertices), soft.mass, dtype=numpy.float64)
    weights = weights_of(source, mesh, soft.vertex_group_mass)
    return masses if weights is None else masses * numpy.maximum(weights, 1e-3)


def weights_of(source, mesh, group_name):
    """The weight of every vertex in a group, 0 outside it; None if there is no such group."""
    group = source.vertex_groups.get(group_name) if group_name else None
    if group is None:
        return None
    weights = numpy.zeros(len(mesh.vertices))
    for vertex in mesh.vertices:
        for one in vertex.groups:
            if one.group == group.index:
                weights[vertex.index] = one.weight
    return weights


def mean_edge(geometry):
    ends = edges_of(geometry)
    return float(lengths(geometry, ends).mean()) if len(ends) else 0.0


def ball_radius(soft, geometry, unit_m):
    """The radius of collision around vertices in m. Blender computes one per vertex from its edges; the format has one per body."""
    found = lengths(geometry, edges_of(geometry)) if len(geometry.mesh.edges) else numpy.zeros(1)
    edge = {"MANUAL": unit_m, "MINIMAL": found.min(), "MAXIMAL": found.max(), "MINMAX": (found.min() + found.max()) / 2}
    return float(soft.ball_size * edge.get(soft.collision_type, found.mean()))


def edges_of(geometry):
    ends = numpy.empty(2 * len(geometry.mesh.edges), dtype=numpy.uint32)
    geometry.mesh.edges.foreach_get("vertices", ends)
    return ends.reshape(-1, 2)


def lengths(geometry, ends):
    positions = geometry.positions.astype(numpy.float64)
    return numpy.maximum(numpy.linalg.norm(positions[ends[:, 0]] - positions[ends[:, 1]], axis=1), 1e-9)


def diagonals_of(geometry):
    """Both diagonals of every quad."""
    first = numpy.cumsum(geometry.polygon_sizes.astype(numpy.int64)) - geometry.polygon_sizes
    corners = first[geometry.polygon_sizes == 4]
    points = geometry.polygon_points
    pairs = [numpy.stack((points[corners + a], points[corners + a + 2]), axis=1) for a in (0, 1)]
    return numpy.concatenate(pairs).astype(numpy.uint32) if len(corners) else numpy.zeros((0, 2), numpy.uint32)


def second_neighbours(ends, joined, count):
    """Pairs of vertices two edges apart that no spring joins yet, once each. Blender's bending springs join them."""
    neighbours = [[] for _ in range(count)]
    for a, b in ends.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    already = {(min(a, b), max(a, b)) for a, b in ends.tolist() + joined.tolist()}
    pairs = {(a, b) for middle in neighbours for a in middle for b in middle if a < b} - already
    return numpy.array(sorted(pairs), dtype=numpy.uint32).reshape(-1, 2)


def add_level(writer, body, source, geometry, name, masses):
    """A level over the surface's own points, which a build does not change."""
    level = body.add("levels", name=name, positions=geometry.positions, masses=masses.astype(numpy.float32))
    mesh = writer.identifiers.known("mesh", source.name)
    if mesh is not None:
        level.add("embeddings", render_mesh=mesh, weights=[(1, 0, 0, 0)] * len(geometry.positions),
                  points=numpy.repeat(numpy.arange(len(geometry.positions), dtype=numpy.uint32)[:, None], 4, axis=1))
    return level


def write_level(writer, body, source, geometry, soft, masses):
    level = add_level(writer, body, source, geometry, "Soft Body", masses)
    ends = edges_of(geometry)
    scale = (soft.spring_length or 100) / 100
    factors = weights_of(source, geometry.mesh, soft.vertex_group_spring)
    add_springs(level, "structural", geometry, ends, soft, scale, factors)
    diagonals = diagonals_of(geometry) if soft.use_stiff_quads and soft.shear > STIFF_QUAD_LIMIT else ends[:0]
    add_springs(level, "shear", geometry, diagonals, soft, scale, factors, soft.shear**2)
    if soft.bend > 0:
        add_springs(level, "flexion", geometry, second_neighbours(ends, diagonals, len(geometry.positions)), soft, scale, factors,
                    soft.bend)
    write_steps(writer, level.simulation, soft)


def write_steps(writer, simulation, soft):
    """Writes Blender's own scheme, with as many steps as its error control needs. A setting with Blender's default value is ignored,
    because it would be too coarse."""
    simulation.scheme = "heun"
    if abs(soft.error_threshold - DEFAULT_ERROR) > 1e-6:
        simulation.step_error = soft.error_threshold * writer.space.unit_m
    frames = writer.asset.environment.control_tick / TIME_UNIT_S  # Blender's simulation time per control tick
    if soft.step_min != DEFAULT_STEPS[0]:
        simulation.substeps_least = math.ceil(soft.step_min * frames)
    if soft.step_max != DEFAULT_STEPS[1]:
        simulation.substeps_most = max(math.ceil(soft.step_max * frames), 1)


def add_springs(level, kind, geometry, ends, soft, scale, factors, fraction=1.0):
    if not len(ends):
        return
    rest, ratio = lengths(geometry, ends) * scale, push_ratio(soft)
    stiffness = numpy.array([edge_stiffness(soft.pull, length) for length in rest]) * fraction
    if factors is not None:
        stiffness *= ((factors[ends[:, 0]] + factors[ends[:, 1]]) / 2)**4
    level.add("springs", kind=kind, ends=ends, rest_lengths=rest.astype(numpy.float32) if scale != 1 else [],
              stiffness=stiffness.astype(numpy.float32), damping=[friction(soft.damping)],
              compression_ratio=[ratio] if abs(ratio - 1) > 1e-4 and math.isfinite(ratio) else [])


def write_goal(writer, body, source, geometry, soft):
    """Writes pins with the stiffness of the goal. The set has the largest stiffness; weights are fractions of it. Points that Blender
    pins rigidly are pinned rigidly. Blender's friction is the same for every goal; if stiffnesses differ it needs its own set."""
    weights = weights_of(source, geometry.mesh, soft.vertex_group_goal)
    if weights is None:
        weights = numpy.ones(len(geometry.positions))
    pulls = numpy.array([goal_stiffness(weight, soft) for weight in weights]) / writer.space.unit_m
    fast = numpy.array([goal_of(weight, soft) >= PINNED_GOAL for weight in weights])
    for bone, points in group_by_bone(writer, source, geometry.mesh, numpy.flatnonzero(fast)):
        if len(points):
            body.pins.append(Record("pin_set", name="Goal", bone=bone, points=points))
    drawn = numpy.flatnonzero((pulls > 0) & ~fast)
    loose = numpy.flatnonzero(~fast)
    uniform = len(drawn) == len(loose) and len(set(pulls[drawn])) == 1
    goal_damping = friction(soft.goal_friction)
    if len(drawn):
        add_goal(writer, body, source, geometry, drawn, pulls, goal_damping if uniform else 0.0)
    if goal_damping and not uniform:
        add_goal(writer, body, source, geometry, loose, numpy.full(len(pulls), FRICTION_ALONE), goal_damping)


def add_goal(writer, body, source, geometry, points, pulls, damping):
    max_stiffness = float(pulls[points].max()) * 1.0001  # the factor keeps weights below 1, which would be kinematic
    for bone, found in group_by_bone(writer, source, geometry.mesh, points):
        body.pins.append(Record("pin_set", name="Goal" if pulls[found].max() > FRICTION_ALONE else "Goal friction", bone=bone, points=found,
                                weights=(pulls[found] / max_stiffness).astype("f4"), stiffness=max_stiffness, damping=damping))
