"""Gravity and force fields of the scene."""

from mathutils import Vector

KINDS = {"WIND": "uniform", "FORCE": "radial", "VORTEX": "vortex", "DRAG": "drag"}


def write_surroundings(writer):
    scene, environment = writer.scene, writer.asset.environment
    gravity = Vector(scene.gravity) if scene.use_gravity else Vector()
    environment.gravity = writer.space.direction(gravity)
    for source in writer.objects:
        field = source.field
        if field is None or field.type in ("NONE", "GUIDE"):
            continue
        if field.type not in KINDS:
            writer.findings.info(f"a force field of the kind {field.type.capitalize()} has no counterpart and is left out",
                                 object_name=source.name)
            continue
        axis = source.matrix_world.to_3x3() @ Vector((0, 0, 1))
        environment.add("fields", name=source.name, id=writer.identifiers.of(
            "field", source.name, source.name, source.soft_body_format.field_identity),
                        kind=KINDS[field.type], position=writer.space.point(source.matrix_world.translation),
                        direction=writer.space.direction(axis.normalized()), strength=field.strength,
                        radius=field.distance_max * writer.space.unit_m if field.use_max_distance else 0,
                        falloff=max(field.falloff_power, 0.0) if field.type == "FORCE" else 0)
