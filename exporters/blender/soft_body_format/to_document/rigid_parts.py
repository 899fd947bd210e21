"""Writes rigid bodies of bones and the joints between them, from the bone panel, limit constraints or IK limits."""

from dataclasses import dataclass, field

from mathutils import Matrix

from ..sbfmt.document import Record
from .armatures import parent_in_file

# Columns: where a joint's X, Y and Z lie in its bone's frame. X is the twist axis.
BALL = Matrix(((0, 0, 1), (1, 0, 0), (0, 1, 0)))
ABOUT = {"X": Matrix.Identity(3), "Y": BALL, "Z": Matrix(((0, 1, 0), (0, 0, 1), (1, 0, 0)))}
# The joint coordinates for rotation about, and displacement along, each of the bone's axes.
OF_AXIS = {"X": "swing_z", "Y": "twist", "Z": "swing_y"}
ALONG_AXIS = {"X": "linear_z", "Y": "linear_x", "Z": "linear_y"}
UNBOUNDED_M = 1e4  # the missing bound of a displacement that is limited at one end only


@dataclass
class JointLimits:
    """A joint that a setting defines: kind, axis, bounds as (coordinate, min, max), and the setting."""

    kind: str
    axis: str = "Y"
    bounds: list = field(default_factory=list)


def joint_limits_of(armature, bone, findings, scale_m=1.0):
    """The joint of a bone to its parent, or None. `scale_m` is the length of the armature's unit in metres."""
    joint = bone.soft_body_format.joint
    if joint.kind != "NONE":
        return of_panel(joint)
    pose = armature.pose.bones[bone.name]
    turns = of_constraints(armature, pose, findings) or of_ik_limits(pose)
    slides = of_locations(armature, pose, findings, scale_m)
    if any(high - low > 1e-9 for low, high in slides.values()):
        return as_slide(turns, slides)
    return limits_from_bounds(turns) if turns or slides else None


def of_panel(joint):
    if joint.kind == "spherical":
        names = ("twist", "swing_y", "swing_z")
        bounds = [("swing", 0.0, joint.cone)] if joint.use_cone else []
    else:
        names, bounds = {"revolute": ("twist", ), "prismatic": ("slide", ), "cylindrical": ("twist", "slide")}.get(joint.kind, ()), []
    for name in names:
        if getattr(joint, f"use_{name}"):
            bounds.append(("linear_x" if name == "slide" else name, getattr(joint, f"{name}_min"), getattr(joint, f"{name}_max")))
    return JointLimits(joint.kind, "Y" if joint.kind in ("spherical", "fixed") else joint.axis, bounds)


def of_constraints(armature, pose, findings):
    """{axis: (min, max)} of the enabled limit rotation constraints; several are intersected."""
    bounds = {}
    for one in local_limits(armature, pose, "LIMIT_ROTATION", findings):
        for axis in "XYZ":
            if getattr(one, f"use_limit_{axis.lower()}"):
                cut(bounds, axis, getattr(one, f"min_{axis.lower()}"), getattr(one, f"max_{axis.lower()}"), 7.0)
    return bounds


def of_locations(armature, pose, findings, scale_m):
    """{axis: (min, max)} in metres, for all three axes, of the enabled limit location constraints; {} if there is none."""
    bounds = {}
    for one in local_limits(armature, pose, "LIMIT_LOCATION", findings):
        if pose.bone.use_connect:
            findings.info(f"the constraint {one.name} bounds nothing: the bone is connected and does not slide",
                          object_name=armature.name, bone_name=pose.name)
            continue
        for axis in "XYZ":
            name = axis.lower()
            cut(bounds, axis, getattr(one, f"min_{name}") * scale_m if getattr(one, f"use_min_{name}") else -UNBOUNDED_M,
                getattr(one, f"max_{name}") * scale_m if getattr(one, f"use_max_{name}") else UNBOUNDED_M, UNBOUNDED_M)
    return bounds


def local_limits(armature, pose, kind, findings):
    """Enabled constraints of a kind that use the bone's own frame."""
    for one in pose.constraints:
        if one.type != kind or one.mute or one.influence == 0:
            continue
        if one.owner_space in ("LOCAL", "LOCAL_WITH_PARENT"):
            yield one
        else:
            findings.warning(f"the constraint {one.name} limits in {one.owner_space.lower()} space, which is no joint's: set its "
                             "owner to Local Space", object_name=armature.name, bone_name=pose.name)


def cut(bounds, axis, low, high, limit):
    old = bounds.get(axis, (-limit, limit))
    bounds[axis] = (max(low, old[0]), min(high, old[1]))


def of_ik_limits(pose):
    bounds = {}
    for axis in "XYZ":
        name = axis.lower()
        if getattr(pose, f"lock_ik_{name}"):
            bounds[axis] = (0.0, 0.0)
        elif getattr(pose, f"use_ik_limit_{name}"):
            bounds[axis] = (getattr(pose, f"ik_min_{name}"), getattr(pose, f"ik_max_{name}"))
    return bounds


def locked_of(bounds):
    return [axis for axis, (low, high) in bounds.items() if high - low < 1e-6 and abs(low) < 1e-6]


def as_slide(turns, slides):
    """A slider or a cylinder where one axis slides and no other turns, else all six coordinates with their bounds."""
    turning = [axis for axis in "XYZ" if axis not in locked_of(turns)]
    sliding = [axis for axis in "XYZ" if axis not in locked_of(slides)]
    if len(sliding) == 1 and turning in ([], sliding):
        axis = sliding[0]
        bounds = [("linear_x", *slides[axis])] + [("twist", *turns[axis]) for _ in turning if axis in turns]
        return JointLimits("cylindrical" if turning else "prismatic", axis, bounds)
    return JointLimits("six_dof", "Y", [(ALONG_AXIS[axis], *slides[axis]) for axis in "YZX"
                                 if slides[axis] != (-UNBOUNDED_M, UNBOUNDED_M)] +
                [(OF_AXIS[axis], *turns[axis]) for axis in "YZX" if axis in turns])


def limits_from_bounds(bounds):
    """A hinge where two axes are locked, else a ball."""
    locked = locked_of(bounds)
    free = [axis for axis in "XYZ" if axis not in locked]
    if len(free) == 0:
        return JointLimits("fixed")
    if len(free) == 1:
        turn = [("twist", *bounds[free[0]])] if free[0] in bounds else []
        return JointLimits("revolute", free[0], turn)
    return JointLimits("spherical", "Y", [(OF_AXIS[axis], *bounds[axis]) for axis in "YZX" if axis in bounds])


class RigidParts:
    """The rigid bodies of bones, made as joints ask for them, and the joints."""

    def __init__(self, writer):
        self.writer = writer

    def body(self, armature, bone):
        """The rigid body of a bone. A build makes its hull around the bone's sections."""
        writer, key = self.writer, (armature.name, bone.name)
        known = writer.identifiers.known("rigid", key)
        if known:
            return writer.asset.find("rigid_bodies", known)
        joint = bone.soft_body_format.joint
        middle = armature.matrix_world @ ((bone.head_local + bone.tail_local) / 2)
        return writer.asset.add("rigid_bodies", id=writer.identifiers.of("rigid", key, bone.name), name=bone.name,
                                bone=writer.skeleton.id(armature, bone.name), center=writer.space.point(middle),
                                motion="dynamic" if joint.simulated else "kinematic", mass=joint.mass if joint.use_mass else 0)

    def write(self, armature):
        scale_m = self.writer.space.unit_m * armature.matrix_world.median_scale
        limits_by_bone = {bone.name: joint_limits_of(armature, bone, self.writer.findings, scale_m) for bone in armature.data.bones}
        wanted = {name for name, limits in limits_by_bone.items() if limits is not None}
        wanted |= {bone.name for bone in armature.data.bones
                   if bone.soft_body_format.joint.simulated or bone.soft_body_format.joint.use_mass}
        for bone in armature.data.bones:
            if bone.name in wanted:
                self.body(armature, bone)
            if limits_by_bone[bone.name] is not None and parent_in_file(bone) is not None:
                self.joint(armature, bone, limits_by_bone[bone.name], self.above(armature, bone, wanted))

    def above(self, armature, bone, wanted):
        """The rigid body that a bone is jointed to: that of the nearest ancestor with one, else that of its parent."""
        parent = parent_in_file(bone)
        while parent is not None and parent.name not in wanted and \
                not self.writer.identifiers.known("rigid", (armature.name, parent.name)):
            parent = parent_in_file(parent)
        return self.body(armature, parent if parent is not None else parent_in_file(bone))

    def joint(self, armature, bone, limits, above):
        writer = self.writer
        below = self.body(armature, bone)
        frame = armature.matrix_world @ bone.matrix_local
        turn = frame.to_3x3().normalized() @ ABOUT[limits.axis]
        rotation = writer.space.rotation(turn.to_quaternion())
        position = writer.space.point(frame.translation)
        made = writer.asset.add("joints", id=writer.identifiers.of("joint", (armature.name, bone.name), bone.name),
                                name=bone.name, kind=limits.kind, body_a=above.id, body_b=below.id)
        for record, part in ((made.frame_a, above), (made.frame_b, below)):
            record.position = tuple(a - b for a, b in zip(position, part.center))
            record.rotation = rotation
        settings = bone.soft_body_format.joint
        for target, low, high in limits.bounds:
            if low > high:
                writer.findings.error(f"the minimum {target} ({low:.3g}) is above the maximum ({high:.3g}): exchange them",
                                      object_name=armature.name, bone_name=bone.name, code="LIMIT_ORDER")
                continue
            made.limits.append(Record("limit", target=target, min=low, max=high, stiffness=settings.limit_stiffness,
                                      damping=settings.limit_damping))
        if settings.use_drive:
            for target in {"spherical": ("twist", "swing_y", "swing_z"), "revolute": ("twist", )}.get(limits.kind, ()):
                made.drives.append(Record("drive", target=target, stiffness=settings.drive_stiffness,
                                          damping=settings.drive_damping, maximum=settings.drive_maximum))
