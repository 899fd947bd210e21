"""The armature's own animation as a clip, for the preview: its pose frame by frame, whatever keys, drivers and constraints make it."""

from ..sbfmt.document import Record
from ..space import frame_rate
from ..to_document.armatures import hung_on

NAME = "soft_body_format_preview"


def is_animated(armature):
    """Whether anything but the artist's hand moves it."""
    animation = armature.animation_data
    return animation is not None and (animation.action is not None or bool(animation.nla_tracks) or bool(animation.drivers)) or \
        any(len(bone.constraints) > 0 for bone in armature.pose.bones)


def add_clip(context, whole):
    """A clip at the end of the document's, with a key a frame of the scene's range; its id, or None where nothing moves."""
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
    for identity, (places, turns) in sampled.items():
        clip.add("tracks", bone=identity, property="translation", times=times, values=places)
        clip.add("tracks", bone=identity, property="rotation", times=times, values=turns)
    whole.document.clips.append(clip)
    return NAME


def sample(armature, name, writer, sampled):
    """Appends each bone's frame in its parent's, or in asset space; lengths in metres."""
    world, space = armature.matrix_world, writer.space
    for pose in armature.pose.bones:
        identity = writer.skeleton.ids.get((name, pose.name))
        if identity is None:
            continue
        over = hung_on(pose.bone)
        if over is None:
            frame = world @ pose.matrix
            place, turn = space.point(frame.translation), space.rotation(frame.to_quaternion())
        else:
            frame = armature.pose.bones[over.name].matrix.inverted_safe() @ pose.matrix
            place = tuple(frame.translation * world.median_scale * space.unit_m)
            quaternion = frame.to_quaternion()
            turn = (quaternion.x, quaternion.y, quaternion.z, quaternion.w)
        places, turns = sampled.setdefault(identity, ([], []))
        if turns and sum(a * b for a, b in zip(turns[-4:], turn)) < 0:
            turn = tuple(-one for one in turn)  # the near way round
        places.extend(place)
        turns.extend(turn)
