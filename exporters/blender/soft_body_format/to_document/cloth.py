"""Blender's Cloth modifier: a layer with thickness, in SI units, and its pin group."""

import numpy

from ..sbfmt.document import Record
from .blender_units import FORCE_UNIT_N, TIME_UNIT_S, cloth_stiffness, friction
from .pins import by_holder
from .roles import modifier
from .soft_bodies import mean_edge, weights_of

THICKNESS_M = 0.001  # Blender's cloth has none; modulus times thickness is what counts


def settings_of(source):
    return modifier(source, "CLOTH")


def area_of(mesh, world_scale):
    return sum(polygon.area for polygon in mesh.polygons) * world_scale**2


def fill_from_cloth(writer, body, source, geometry, found):
    """Tension, bending and mass a vertex become modulus, rigidity and mass an area; its collision thickness stays."""
    cloth, count = found.settings, len(geometry.positions)
    edge = mean_edge(geometry)
    area = area_of(geometry.mesh, writer.space.unit_m * source.matrix_world.median_scale)
    attributes = body.attributes
    attributes.area_density = cloth.mass * count / area
    attributes.thickness = THICKNESS_M
    attributes.density = attributes.area_density / THICKNESS_M
    # Springs an edge apart: a sheet's tension per width is the spring's stiffness.
    attributes.young_modulus = cloth_stiffness(cloth.tension_stiffness, edge) / THICKNESS_M
    attributes.poisson_ratio = 0.25
    attributes.bending_stiffness = FORCE_UNIT_N * cloth.bending_stiffness * edge * 1e-3
    attributes.media_friction = friction(cloth.air_damping) / cloth.mass
    attributes.stiffness_damping = damping_time(cloth)
    attributes.damping_ratio = 0
    attributes.gravity_scale = cloth.effector_weights.gravity
    if cloth.use_pressure:
        attributes.pressure_mode = "volume" if cloth.use_pressure_volume else "gas"
        attributes.pressure = FORCE_UNIT_N * cloth.uniform_pressure_force
    body.collision.self = found.collision_settings.use_self_collision
    body.collision.particle_radius = found.collision_settings.self_distance_min
    body.collision.outer_thickness = found.collision_settings.distance_min
    attributes.friction = min(found.collision_settings.friction / 10, 2.0)
    weights = weights_of(source, geometry.mesh, cloth.vertex_group_mass)
    if weights is not None:
        write_pins(writer, body, source, geometry, weights, cloth)
    for name, label in (("compression_stiffness", "compression"), ("shear_stiffness", "shear")):
        if abs(getattr(cloth, name) - cloth.tension_stiffness) > 0.01 * cloth.tension_stiffness:
            writer.findings.info(f"cloth {label} ({getattr(cloth, name):g}) differs from its tension "
                                 f"({cloth.tension_stiffness:g}); the format's layer has one modulus, that of the tension",
                                 object_name=source.name)
    if cloth.use_internal_springs:
        writer.findings.info("internal springs of the cloth are left to the build, which makes its own", object_name=source.name)


def damping_time(cloth):
    """s: Blender damps a spring by damping / stiffness of it, in its own unit of time."""
    return TIME_UNIT_S * 0.01 * cloth.tension_damping / max(cloth.tension_stiffness, 1e-6)


def write_pins(writer, body, source, geometry, weights, cloth):
    held = numpy.flatnonzero(weights > 0)
    for bone, points in by_holder(writer, source, geometry.mesh, held):
        body.pins.append(Record("pin_set", name=cloth.vertex_group_mass, bone=bone, points=points,
                                weights=weights[points].astype(numpy.float32),
                                stiffness=FORCE_UNIT_N * cloth.pin_stiffness))
