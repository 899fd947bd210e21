"""Gravity and force fields of the scene."""

from mathutils import Vector

KINDS = {"WIND": "uniform", "FORCE": "radial", "VORTEX": "vortex", "DRAG": "drag"}


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
        if felt is None:
            felt = acceleration_of_strength(writer)
        if field.type == "VORTEX":
            writer.findings.info("a vortex of Blender's is stronger farther out; the file's is everywhere as at one metre",
                                 object_name=source.name)
        axis = source.matrix_world.to_3x3() @ Vector((0, 0, 1))
        environment.add("fields", name=source.name, id=writer.identifiers.of(
            "field", source.name, source.name, source.soft_body_format.field_identity),
                        kind=KINDS[field.type], position=writer.space.point(source.matrix_world.translation),
                        direction=writer.space.direction(axis.normalized()), strength=field.strength * (1 if field.type == "DRAG" else felt),
                        radius=field.distance_max * writer.space.unit_m if field.use_max_distance else 0,
                        falloff=max(field.falloff_power, 0.0) if field.type == "FORCE" else 0)


def acceleration_of_strength(writer):
    """m/s² that a field of strength 1 gives what Blender itself simulates softly in this scene; 1 where that is nothing. The format's
    fields are accelerations alike for all bodies, Blender's depend on their mass: where bodies differ the first one counts."""
    felt = writer.field_accelerations
    if not felt:
        return 1.0
    name, first = next(iter(felt.items()))
    others = [other for other, one in felt.items() if abs(one - first) > 0.01 * abs(first)]
    if others:
        writer.findings.info(f"force fields push it by {first:.3g} m/s² for a strength of 1, and {', '.join(others)} otherwise; the file's "
                             "fields push all alike, as this one", object_name=name)
    return first
