"""Imports gravity as the scene's, and force fields as empties."""

import bpy
from mathutils import Vector

from ..to_document.surroundings import KINDS

TYPES = {kind: type_ for type_, kind in KINDS.items()}


def fill_surroundings(maker):
    scene, environment = maker.context.scene, maker.document.environment
    gravity = maker.space.direction_back(environment.gravity)
    if (gravity - Vector(scene.gravity)).length > 1e-5 or not scene.use_gravity and gravity.length > 0:
        maker.findings.info(f"the scene's gravity is now that of the file: {', '.join(f'{one:.4g}' for one in gravity)} m/s²")
        scene.use_gravity, scene.gravity = True, gravity
    for record in environment.fields:
        made = bpy.data.objects.new(record.name or record.id, None)
        maker.collection.objects.link(made)
        made.location = maker.space.point_back(record.position)
        direction = maker.space.direction_back(record.direction)
        if direction.length > 0:
            made.rotation_euler = direction.to_track_quat("Z", "Y").to_euler()
        made.soft_body_format.field_identity = record.id
        maker.act_on(made, bpy.ops.object.forcefield_toggle)
        field = made.field
        field.type, field.flow = TYPES[record.kind], 0
        setattr(field, "quadratic_drag" if record.kind == "drag" else "strength", record.strength)
        if record.kind == "drag":
            field.linear_drag = 0  # Blender's linear drag grows with the square of the speed
        field.use_max_distance, field.distance_max = record.radius > 0, record.radius / maker.space.unit_m
        field.falloff_power, field.shape = record.falloff, "POINT"
