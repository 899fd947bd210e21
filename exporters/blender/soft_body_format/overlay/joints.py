"""Draws joint limits over armatures: a cone for swing, arcs for twist and each axis, red where the pose violates a limit."""

import bpy
import gpu
import numpy
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix, Vector

from ..findings import Findings
from ..space import Space
from ..to_document.armatures import parent_in_file
from ..to_document.rigid_parts import ABOUT, joint_limits_of
from . import joint_shapes
from .joint_shapes import CONE, SLIDE, SWING_Y, SWING_Z, TWIST
from .view_drawing import ViewDrawing, flat_shader

BROKEN, POINTER = "broken", "pointer"
# The theme's colour of each part: (group of the theme, name, colour for Blender versions without it).
COLORS = {CONE: ("view_3d", "bone_pose_active", (0.55, 0.8, 1.0)), TWIST: ("user_interface", "axis_y", (0.55, 0.86, 0.0)),
          SWING_Y: ("user_interface", "axis_z", (0.17, 0.56, 1.0)), SWING_Z: ("user_interface", "axis_x", (1.0, 0.2, 0.32)),
          SLIDE: ("view_3d", "bone_pose", (0.31, 0.78, 1.0)), BROKEN: ("info", "info_error", (1.0, 0.15, 0.15)),
          POINTER: ("view_3d", "object_active", (1.0, 0.67, 0.25))}
LINE_ALPHA, FILL_ALPHA = 0.9, 0.12


def color_of(part, alpha):
    group, name, otherwise = COLORS[part]
    theme = bpy.context.preferences.themes[0]
    found = getattr(getattr(theme, group, None), name, None)
    return (*(tuple(found)[:3] if found is not None else otherwise), alpha)


def is_selected(pose):
    """Whether the bone is selected. Blender 5 stores this in the pose bone; earlier versions store it in the bone."""
    return pose.select if hasattr(pose, "select") else pose.bone.select


def bones_of(context, which):
    """[(armature object, pose bone)] to draw."""
    found = []
    for source in context.view_layer.objects:
        if source.type != "ARMATURE" or source.mode == "EDIT" or not source.visible_get(view_layer=context.view_layer):
            continue
        active = source == context.view_layer.objects.active
        for pose in source.pose.bones:
            if which == "ALL" or active and (is_selected(pose) or pose.bone == source.data.bones.active):
                found.append((source, pose))
    return found


def frame_at_rest(source, pose):
    """The bone's matrix if only this bone were at rest. Its joint's limits are relative to it."""
    bone, over = pose.bone, parent_in_file(pose.bone)
    if over is None:
        return source.matrix_world @ bone.matrix_local
    above = source.pose.bones[over.name]
    return source.matrix_world @ above.matrix @ above.bone.matrix_local.inverted_safe() @ bone.matrix_local


def joint_shape(source, pose, unit_m):
    """(Shape, its 4x4 world matrix, whether the pose is within the limits, the bone's direction in the shape), or None."""
    limits = joint_limits_of(source, pose.bone, Findings())
    if limits is None or limits.kind == "fixed":
        return None
    turn = ABOUT[limits.axis]
    along = turn.inverted() @ Vector((0, 1, 0))
    bounds = {name: (low, high) for name, low, high in limits.bounds if low <= high}
    length_m = pose.bone.length * source.matrix_world.median_scale * unit_m
    shape = joint_shapes.shape_of(limits.kind, bounds, tuple(along), 1 / max(length_m, 1e-9))
    if not shape.lines:
        return None
    rest = frame_at_rest(source, pose)
    size = pose.bone.length * source.matrix_world.median_scale
    position = Matrix.Translation(rest.translation) @ (rest.to_quaternion().to_matrix() @ turn).to_4x4() @ Matrix.Scale(size, 4)
    off = rest.to_quaternion().inverted() @ (source.matrix_world @ pose.matrix).to_quaternion()
    off = (turn.inverted() @ off.to_matrix() @ turn).to_quaternion()
    within = joint_shapes.is_within(joint_shapes.measure(off.w, off.x, off.y, off.z), bounds)
    return shape, position, within, off.to_matrix() @ along


def collect(context):
    """{part: (line ends, triangle corners)} in world space, of all joints to draw."""
    settings = context.scene.soft_body_format
    lines, triangles = {}, {}
    unit = Space.of_scene(context.scene).unit_m
    for source, pose in bones_of(context, settings.show_joints):
        made = joint_shape(source, pose, unit)
        if made is None:
            continue
        shape, position, within, pointer = made
        matrix = numpy.array(position)
        for found, kept in ((shape.lines, lines), (shape.triangles, triangles)):
            for part, points in found.items():
                kept.setdefault(part if within else BROKEN, []).append(points @ matrix[:3, :3].T + matrix[:3, 3])
        ends = numpy.array([(0, 0, 0), tuple(pointer)])
        lines.setdefault(POINTER, []).append(ends @ matrix[:3, :3].T + matrix[:3, 3])
    return {part: (numpy.concatenate(lines[part]).astype(numpy.float32),
                   numpy.concatenate(triangles[part]).astype(numpy.float32) if part in triangles else None) for part in lines}


def draw():
    context = bpy.context
    if context.scene.soft_body_format.show_joints == "NONE" or not context.space_data.overlay.show_overlays:
        return
    flat, thick = flat_shader(), flat_shader(polyline=True)
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("NONE")
    for part, (lines, triangles) in collect(context).items():
        if triangles is not None:
            flat.bind()
            flat.uniform_float("color", color_of(part, FILL_ALPHA))
            batch_for_shader(flat, "TRIS", {"pos": triangles}).draw(flat)
        thick.bind()
        thick.uniform_float("color", color_of(part, LINE_ALPHA))
        thick.uniform_float("viewportSize", (context.region.width, context.region.height))
        thick.uniform_float("lineWidth", 2.5 if part == POINTER else 1.5)
        batch_for_shader(thick, "LINES", {"pos": lines}).draw(thick)
    gpu.state.blend_set("NONE")


_drawing = ViewDrawing(draw)
register, unregister = _drawing.register, _drawing.unregister
