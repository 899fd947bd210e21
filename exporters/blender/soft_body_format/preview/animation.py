"""Samples the armature's animation as a clip for the preview. Samples the pose of each frame, so drivers and constraints count."""

from ..sbfmt.document import Record
from ..space import frame_rate
from ..to_document.armatures import parent_in_file

NAME = "soft_body_format_preview"


def is_animated(armature):
    """Whether the armature is animated, by keys, drivers or constraints."""
    animation = armature.animation_data
    return animation is not None and (animation.action is not None or bool(animation.nla_tracks) or bool(animation.drivers)) or \
        any(len(bone.constraints) > 0 for bone in armature.pose.bones)


def add_clip(context, whole):
    """Adds a clip to the document with a key for each frame of the scene's range. Returns its id, or None if nothing moves."""
    writer, scene = whole.writer, context.scene
    armatures = [one for one in writer.of_type("ARMATURE") if is_animated(one)]
    if not armatures:
        return None
    rate, kept = frame_rate(scene), scene.frame_current
    frames = range(scene.frame_start, scene.frame_end + 1)
    sampled = {}
    try:
        for frame in frames:
            scene.frame_set(frame)
            depsgraph = context.evaluated_depsgraph_get()
            for armature in armatures:
                sample(armature.evaluated_get(depsgraph), armature.name, writer, sampled)
    finally:
        scene.frame_set(kept)
    clip = Record("clip", id=NAME, name="Preview", duration=(len(frames) - 1) / rate, loop=False)
    times = [(frame - frames[0]) / rate for frame in frames]
    for identity, (positions, rotations) in sampled.items():
        clip.add("tracks", bone=identity, property="translation", times=times, values=positions)
        clip.add("tracks", bone=identity, property="rotation", times=times, values=rotations)
    whole.document.clips.append(clip)
    return NAME


def sample(armature, name, writer, sampled):
    """Appends each bone's transform, relative to its parent's or to asset space; lengths in metres."""
    world, space = armature.matrix_world, writer.space
    for pose in armature.pose.bones:
        identity = writer.skeleton.ids.get((name, pose.name))
        if identity is None:
            continue
        over = parent_in_file(pose.bone)
        if over is None:
            frame = world @ pose.matrix
            position, rotation = space.point(frame.translation), space.rotation(frame.to_quaternion())
        else:
            frame = armature.pose.bones[over.name].matrix.inverted_safe() @ pose.matrix
            position = tuple(frame.translation * world.median_scale * space.unit_m)
            quaternion = frame.to_quaternion()
            rotation = (quaternion.x, quaternion.y, quaternion.z, quaternion.w)
        positions, rotations = sampled.setdefault(identity, ([], []))
        if rotations and sum(a * b for a, b in zip(rotations[-4:], rotation)) < 0:
            rotation = tuple(-one for one in rotation)  # the shorter rotation
        positions.extend(position)
        rotations.extend(rotation)
