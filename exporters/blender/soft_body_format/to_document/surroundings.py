"""Writes gravity and force fields of the scene."""

from mathutils import Vector

KINDS = {"WIND": "uniform", "FORCE": "radial", "VORTEX": "vortex", "DRAG": "drag"}
# Settings that the format's fields do not have: setting, its name in messages, value at which it has no effect.
LEFT_OUT = (("noise", "noise", 0.0), ("use_min_distance", "the minimum distance", False), ("z_direction", "one side alone", "BOTH"),
            ("falloff_type", "falloff as a tube or cone", "SPHERE"), ("use_absorption", "absorption", False),
            ("use_2d_force", "force across Z alone", False), ("use_gravity_falloff", "gravitation", False))
NEGLIGIBLE_FLOW = 1e-6


def write_surroundings(writer):
    scene, environment = writer.scene, writer.asset.environment
    gravity = Vector(scene.gravity) if scene.use_gravity else Vector()
    environment.gravity = writer.space.direction(gravity)
    effect = None
    for source in writer.objects:
        field = source.field
        if field is None or field.type in ("NONE", "GUIDE"):
            continue
        if field.type not in KINDS:
            writer.findings.info(f"a force field of the kind {field.type.capitalize()} has no counterpart and is left out",
                                 object_name=source.name)
            continue
        effect = effect or field_effect_on_soft_bodies(writer)
        report_unsupported(writer, source, field)
        if field.type == "DRAG":
            add_field(writer, source, field, "drag", field.quadratic_drag * (effect[1] or 1.0))
            continue
        add_field(writer, source, field, KINDS[field.type], field.strength * effect[0])
        if abs(field.flow * effect[1]) > NEGLIGIBLE_FLOW:  # a flow slows down objects in it
            add_field(writer, source, field, "drag", field.flow * effect[1], "flow")


def add_field(writer, source, field, kind, strength, part=""):
    """Adds a field to the file. `part` names the part of Blender's field, if it is not the whole."""
    name = f"{source.name} {part}" if part else source.name
    axis = source.matrix_world.to_3x3() @ Vector((0, 0, 1))
    writer.asset.environment.add(
        "fields", name=name, id=writer.identifiers.of("field", name, name, "" if part else source.soft_body_format.field_identity),
        kind=kind, position=writer.space.point(source.matrix_world.translation),
        direction=writer.space.direction(axis.normalized()), strength=strength,
        radius=field.distance_max * writer.space.unit_m if field.use_max_distance else 0, falloff=max(field.falloff_power, 0.0))


def report_unsupported(writer, source, field):
    """Reports settings of a field that the format does not have."""
    left_out = [label for name, label, idle in LEFT_OUT if getattr(field, name, idle) != idle]
    near = field.falloff_power > 0 or field.use_max_distance
    if field.shape != "POINT" and (field.type == "FORCE" or near or field.shape in ("SURFACE", "POINTS")):
        left_out.append(f"the shape {field.shape.capitalize()}: it acts from its centre")
    if field.type == "DRAG" and field.linear_drag:
        left_out.append("Linear, which in Blender grows with the square of the speed; Quadratic grows with the "
                        "speed, and stays")
    if field.type == "VORTEX":
        left_out.append("its growth with distance: the file's field has the strength at one metre everywhere" + ("; inflow" if field.inflow else ""))
    if left_out:
        writer.findings.info(f"of its force field is left out: {'; '.join(left_out)}", object_name=source.name)


def field_effect_on_soft_bodies(writer):
    """(m/s² for a strength of 1, 1/s for a drag of 1) of the scene's soft body and cloth modifiers; (1, 0) without any. The format's
    fields give all bodies the same acceleration; Blender's depend on mass. If bodies differ, the first one counts."""
    effect = writer.field_effects
    if not effect:
        return 1.0, 0.0
    name, first = next(iter(effect.items()))
    others = [other for other, one in effect.items() if abs(one[0] - first[0]) > 0.01 * abs(first[0])]
    if others:
        writer.findings.info(f"force fields push it by {first[0]:.3g} m/s² for a strength of 1, and {', '.join(others)} otherwise; the "
                             "file's fields push all alike, as this one", object_name=name)
    return first
