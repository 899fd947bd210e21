"""Gravity and force fields of the scene."""

from mathutils import Vector

KINDS = {"WIND": "uniform", "FORCE": "radial", "VORTEX": "vortex", "DRAG": "drag"}
# What the format's fields have no place for: setting, what it is called, value at which it does nothing.
LEFT_OUT = (("noise", "noise", 0.0), ("use_min_distance", "the least distance", False), ("z_direction", "one side alone", "BOTH"),
            ("falloff_type", "falloff as a tube or cone", "SPHERE"), ("use_absorption", "absorption", False),
            ("use_2d_force", "force across Z alone", False), ("use_gravity_falloff", "gravitation", False))
SPEEDLESS = 1e-6


def write_surroundings(writer):
    scene, environment = writer.scene, writer.asset.environment
    gravity = Vector(scene.gravity) if scene.use_gravity else Vector()
    environment.gravity = writer.space.direction(gravity)
    felt = None
    for source in writer.objects:
        field = source.field
        if field is None or field.type in ("NONE", "GUIDE"):
            continue
        if field.type not in KINDS:
            writer.findings.info(f"a force field of the kind {field.type.capitalize()} has no counterpart and is left out",
                                 object_name=source.name)
            continue
        felt = felt or felt_by_softness(writer)
        tell(writer, source, field)
        if field.type == "DRAG":
            add_field(writer, source, field, "drag", field.quadratic_drag * (felt[1] or 1.0))
            continue
        add_field(writer, source, field, KINDS[field.type], field.strength * felt[0])
        if abs(field.flow * felt[1]) > SPEEDLESS:  # a flow holds back what moves through it
            add_field(writer, source, field, "drag", field.flow * felt[1], "flow")


def add_field(writer, source, field, kind, strength, part=""):
    """One of the file's fields; `part`: what of Blender's, where it is not the whole."""
    name = f"{source.name} {part}" if part else source.name
    axis = source.matrix_world.to_3x3() @ Vector((0, 0, 1))
    writer.asset.environment.add(
        "fields", name=name, id=writer.identifiers.of("field", name, name, "" if part else source.soft_body_format.field_identity),
        kind=kind, position=writer.space.point(source.matrix_world.translation),
        direction=writer.space.direction(axis.normalized()), strength=strength,
        radius=field.distance_max * writer.space.unit_m if field.use_max_distance else 0, falloff=max(field.falloff_power, 0.0))


def tell(writer, source, field):
    """What of a field the file does not have."""
    left_out = [label for name, label, idle in LEFT_OUT if getattr(field, name, idle) != idle]
    near = field.falloff_power > 0 or field.use_max_distance
    if field.shape != "POINT" and (field.type == "FORCE" or near or field.shape in ("SURFACE", "POINTS")):
        left_out.append(f"the shape {field.shape.capitalize()}: it acts from its centre")
    if field.type == "DRAG" and field.linear_drag:
        left_out.append("what it calls Linear, which in Blender brakes by the square of the speed; what it calls Quadratic brakes by the "
                        "speed, and stays")
    if field.type == "VORTEX":
        left_out.append("that it is stronger farther out: the file's is everywhere as at one metre" + ("; inflow" if field.inflow else ""))
    if left_out:
        writer.findings.info(f"of its force field is left out: {'; '.join(left_out)}", object_name=source.name)


def felt_by_softness(writer):
    """(m/s² of a strength of 1, 1/s of a drag of 1) as what Blender itself simulates softly in this scene takes them; (1, 0) where that
    is nothing. The format's fields are accelerations alike for all bodies, Blender's depend on their mass: where bodies differ the
    first one counts."""
    felt = writer.felt_fields
    if not felt:
        return 1.0, 0.0
    name, first = next(iter(felt.items()))
    others = [other for other, one in felt.items() if abs(one[0] - first[0]) > 0.01 * abs(first[0])]
    if others:
        writer.findings.info(f"force fields push it by {first[0]:.3g} m/s² for a strength of 1, and {', '.join(others)} otherwise; the "
                             "file's fields push all alike, as this one", object_name=name)
    return first
