"""Writes Blender's Cloth modifier as a layer with thickness, in SI units, and writes its pin group."""

import numpy

from ..sbfmt.document import Record
from . import cloth_springs
from ..space import frame_rate
from .blender_units import FORCE_UNIT_N, cloth_damping, cloth_layer, cloth_stiffness, drag_on_cloth, field_on_cloth, friction
from .cloth_bending import flexural_rigidity
from .pins import group_by_bone
from .roles import modifier
from .soft_bodies import area_of, mean_edge, weights_of

THICKNESS_M = 0.001  # Blender's cloth has no thickness; only modulus times thickness matters
# Weight maps: the format's property, the vertex group's slider, the slider at weight 0 and at weight 1.
MAPS = (("young_modulus", "vertex_group_structural_stiffness", "tension_stiffness", "tension_stiffness_max"),
        ("bending_stiffness", "vertex_group_bending", "bending_stiffness", "bending_stiffness_max"))
# Settings that the format does not have: slider, its name in messages, value at which it has no effect.
LEFT_OUT = (("use_sewing_springs", "sewing", False), ("shrink_min", "shrinking", 0.0), ("time_scale", "speed", 1.0),
            ("fluid_density", "fluid density", 0.0), ("vertex_group_shrink", "the group of shrinking", ""), ("use_dynamic_mesh", "the dynamic mesh", False),
            ("bending_model", "springs that bend by length", "ANGULAR"), ("bending_damping", "damping of bending", 0.5))

LEFT_OUT_OF_COLLISION = (("damping", "damping of collisions", 0.0), ("impulse_clamp", "the impulse clamp of collisions", 0.0),
                         ("self_impulse_clamp", "the impulse clamp of self collision", 0.0), ("self_friction", "friction with itself", 5.0))


def settings_of(source):
    return modifier(source, "CLOTH")


def fill_from_cloth(writer, body, source, geometry, found):
    """Converts tension, shear, bending and mass per vertex to modulus, Poisson's ratio, rigidity and mass per area."""
    cloth, count = found.settings, len(geometry.positions)
    edge = mean_edge(geometry)
    scale = writer.space.unit_m * source.matrix_world.median_scale
    attributes = body.attributes
    attributes.area_density = cloth.mass * count / max(area_of(geometry.mesh, scale), 1e-12)
    writer.field_effects[source.name] = (field_on_cloth(attributes.area_density, frame_rate(writer.scene)),
                                       drag_on_cloth(attributes.area_density))
    attributes.thickness = THICKNESS_M
    attributes.density = attributes.area_density / THICKNESS_M
    stiffness, attributes.poisson_ratio = cloth_layer(cloth.tension_stiffness, cloth.shear_stiffness, edge)
    attributes.young_modulus = stiffness / THICKNESS_M
    attributes.bending_stiffness = flexural_rigidity(geometry, cloth.bending_stiffness)
    attributes.media_friction = friction(cloth.air_damping) / cloth.mass
    attributes.stiffness_damping = damping_time(cloth, edge)
    attributes.damping_ratio = 0
    attributes.gravity_scale = cloth.effector_weights.gravity
    if cloth.use_pressure:
        attributes.pressure_mode = "volume" if cloth.use_pressure_volume else "gas"
        attributes.pressure = FORCE_UNIT_N * cloth.uniform_pressure_force
    collision = found.collision_settings
    body.collision.self = collision.use_self_collision
    body.collision.particle_radius = collision.self_distance_min * writer.space.unit_m
    body.collision.outer_thickness = collision.distance_min * writer.space.unit_m
    attributes.friction = min(collision.friction / 10, 2.0)
    weights = weights_of(source, geometry.mesh, cloth.vertex_group_mass)
    if weights is not None:
        write_pins(writer, body, source, geometry, weights, cloth)
    add_maps(body, source, geometry, cloth)
    if cloth_springs.wanted(cloth):
        cloth_springs.write_level(writer, body, source, geometry, cloth)
    report_unsupported(writer, source, cloth, collision)


def add_maps(body, source, geometry, cloth):
    """Painted stiffness: the slider at weight 0, its maximum at weight 1. Painted pressure is a fraction of the slider."""
    for name, group, low, high in MAPS:
        weights = weights_of(source, geometry.mesh, getattr(cloth, group))
        if weights is not None and getattr(cloth, low) > 0:
            ratio = max(getattr(cloth, high), getattr(cloth, low)) / getattr(cloth, low)
            body.add("weight_maps", property=name, values=(1 + (ratio - 1) * weights).astype(numpy.float32))
    weights = weights_of(source, geometry.mesh, cloth.vertex_group_pressure) if cloth.use_pressure else None
    if weights is not None:
        body.add("weight_maps", property="pressure", values=weights.astype(numpy.float32))


def report_unsupported(writer, source, cloth, collision):
    """Reports settings that the format does not have, and dampings that differ from the one that it has."""
    springs = cloth_springs.wanted(cloth)
    others = [name for name in ("compression", "shear") if not (springs and name == "shear") and
              abs(getattr(cloth, f"{name}_damping") - cloth.tension_damping) > 0.01 * max(cloth.tension_damping, 1)]
    if others:
        writer.findings.info(f"cloth damping of {' and '.join(others)} differs from that of tension ({cloth.tension_damping:g}), which is "
                             "taken for it too", object_name=source.name)
    if cloth.vertex_group_shear_stiffness and not springs:
        writer.findings.info("its group of shear stiffness is left out: a layer has one ratio of shear to tension (a compression other than "
                             "its tension makes springs of it, which have the group)", object_name=source.name)
    left_out = [label for owner, idles in ((cloth, LEFT_OUT), (collision, LEFT_OUT_OF_COLLISION)) for name, label, idle in idles
                if getattr(owner, name, idle) != idle]
    if left_out:
        writer.findings.info(f"cloth settings without a counterpart are left out: {', '.join(left_out)}", object_name=source.name)


def damping_time(cloth, edge):
    """A spring's damping over its stiffness, in s."""
    return cloth_damping(cloth.tension_damping) / max(cloth_stiffness(cloth.tension_stiffness, edge), 1e-6)


def write_pins(writer, body, source, geometry, weights, cloth):
    pinned = numpy.flatnonzero(weights > 0)
    for bone, points in group_by_bone(writer, source, geometry.mesh, pinned):
        body.pins.append(Record("pin_set", name=cloth.vertex_group_mass, bone=bone, points=points,
                                weights=weights[points].astype(numpy.float32),
                                stiffness=FORCE_UNIT_N * cloth.pin_stiffness))
