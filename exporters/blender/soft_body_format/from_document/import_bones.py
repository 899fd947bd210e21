"""Imports bones as an armature. Joints and masses of bones become settings of the bone panels."""

import bpy
from mathutils import Matrix, Quaternion, Vector

from ..to_document.rigid_parts import ABOUT

MIN_LENGTH_M = 1e-4  # Blender removes bones shorter than it can draw


def make_armature(document, space, collection, context):
    """The armature object, or None without bones. Blender numbers repeated names."""
    if not document.bones:
        return None
    data = bpy.data.armatures.new(document.info.title or "Skeleton")
    made = bpy.data.objects.new(data.name, data)
    collection.objects.link(made)
    context.view_layer.objects.active = made
    bpy.ops.object.mode_set(mode="EDIT")
    names = {}
    try:
        for bone in document.bones:
            names[bone.id] = make_bone(data.edit_bones, bone, names, space)
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
    for order, bone in enumerate(document.bones):
        fill_bone(data.bones[names[bone.id]], bone, order)
    return made, names


def make_bone(edit_bones, bone, names, space):
    made = edit_bones.new(bone.name or bone.id)
    made.head, made.tail = (0, 0, 0), (0, 1, 0)
    frame = space.rotation_back(bone.rotation).to_matrix()
    made.matrix = Matrix.Translation(space.point_back(bone.head)) @ frame.to_4x4()
    made.length = max(bone.length, MIN_LENGTH_M) / space.unit_m
    if bone.parent:
        made.parent = edit_bones[names[bone.parent]]
    return made.name


def fill_bone(made, bone, order):
    made.use_inherit_rotation = bone.inherit_rotation
    made.inherit_scale = "FULL" if bone.inherit_scale else "NONE"
    settings = made.soft_body_format
    settings.identity, settings.order = bone.id, order + 1


def fill_joints(document, armature, names, joined):
    """Fills in joints between rigid bodies of bones that have no constraint yet. Other joints are only kept in memory."""
    bodies = {body.id: body for body in document.rigid_bodies}
    for joint in document.joints:
        below, above = bodies.get(joint.body_b), bodies.get(joint.body_a)
        if joint.id in joined or below is None or above is None or not below.bone or not above.bone or joint.derived:
            continue
        bone = armature.data.bones[names[below.bone]]
        settings = bone.soft_body_format.joint
        if joint.kind not in ("spherical", "revolute", "prismatic", "cylindrical", "fixed"):
            continue
        settings.kind = joint.kind
        settings.axis = axis_of(joint, document, below)
        fill_limits(settings, joint)
        settings.use_mass, settings.simulated = below.mass > 0, below.motion == "dynamic"
        if below.mass > 0:
            settings.mass = below.mass
        if joint.drives:
            drive = joint.drives[0]
            settings.use_drive, settings.drive_stiffness = True, drive.stiffness
            settings.drive_damping, settings.drive_maximum = drive.damping, drive.maximum


def axis_of(joint, document, below):
    """The axis of the bone that is closest to the joint's X axis."""
    def turn(xyzw):
        return Quaternion((xyzw[3], *xyzw[:3]))

    bone = document.find("bones", below.bone)
    along = turn(bone.rotation).inverted() @ (turn(joint.frame_b.rotation) @ Vector((1, 0, 0)))
    return max("XYZ", key=lambda axis: (ABOUT[axis] @ Vector((1, 0, 0))).dot(along))


def fill_limits(settings, joint):
    names = {"linear_x": "slide", "twist": "twist", "swing_y": "swing_y", "swing_z": "swing_z"}
    for limit in joint.limits:
        if limit.target == "swing":
            settings.use_cone, settings.cone = True, limit.max
        elif limit.target in names:
            name = names[limit.target]
            setattr(settings, f"use_{name}", True)
            setattr(settings, f"{name}_min", limit.min)
            setattr(settings, f"{name}_max", limit.max)
        settings.limit_stiffness, settings.limit_damping = limit.stiffness, limit.damping
