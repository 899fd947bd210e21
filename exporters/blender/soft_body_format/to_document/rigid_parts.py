"""Rigid bodies of bones, and the joints between them: as the panel, the limit constraints or the IK limits say."""

from dataclasses import dataclass, field

from mathutils import Matrix

from ..sbfmt.document import Record

# Columns: where a joint's X, Y and Z lie in its bone's frame. X is the twist axis.
BALL = Matrix(((0, 0, 1), (1, 0, 0), (0, 1, 0)))
ABOUT = {"X": Matrix.Identity(3), "Y": BALL, "Z": Matrix(((0, 1, 0), (0, 0, 1), (1, 0, 0)))}
# The coordinate of a ball joint for each of the bone's axes.
OF_AXIS = {"X": "swing_z", "Y": "twist", "Z": "swing_y"}


@dataclass
class Wish:
    """A joint somebody asked for: kind, axis, bounds as (coordinate, least, most), and where it was said."""

    kind: str
    axis: str = "Y"
    bounds: list = field(default_factory=list)


def wish_of(armature, bone, findings):
    """The joint of a bone to the one above it, or None."""
    joint = bone.soft_body_format.joint
    if joint.kind != "NONE":
        return of_panel(joint)
    pose = armature.pose.bones[bone.name]
    bounds = of_constraints(armature, pose, findings) or of_ik_limits(pose)
    return as_wish(bounds) if bounds else None


def of_panel(joint):
    if joint.kind == "spherical":
        names = ("twist", "swing_y", "swing_z")
        bounds = [("swing", 0.0, joint.cone)] if joint.use_cone else []
    else:
        names, bounds = {"revolute": ("twist", ), "prismatic": ("slide", ), "cylindrical": ("twist", "slide")}.get(joint.kind, ()), []
    for name in names:
        if getattr(joint, f"use_{name}"):
            bounds.append(("linear_x" if name == "slide" else name, getattr(joint, f"{name}_min"), getattr(joint, f"{name}_max")))
    return Wish(joint.kind, "Y" if joint.kind in ("spherical", "fixed") else joint.axis, bounds)


def of_constraints(armature, pose, findings):
    """{axis: (least, most)} of the limit rotation constraints that are on; several cut each other down."""
    bounds = {}
    for one in pose.constraints:
        if one.type == "LIMIT_LOCATION" and not one.mute:
            findings.info("a Limit Location constraint is left out: joints of bones turn; choose a slider in Bone > Soft body format",
                          object_name=armature.name, bone_name=pose.name)
        if one.type != "LIMIT_ROTATION" or one.mute or one.influence == 0:
            continue
        if one.owner_space not in ("LOCAL", "LOCAL_WITH_PARENT"):
            findings.warning(f"the constraint {one.name} limits in {one.owner_space.lower()} space, which is no joint's: set its "
                             "owner to Local Space", object_name=armature.name, bone_name=pose.name)
            continue
        for axis in "XYZ":
            if getattr(one, f"use_limit_{axis.lower()}"):
                low, high = getattr(one, f"min_{axis.lower()}"), getattr(one, f"max_{axis.lower()}")
                old = bounds.get(axis, (-7.0, 7.0))
                bounds[axis] = (max(low, old[0]), min(high, old[1]))
    return bounds


def of_ik_limits(pose):
    bounds = {}
    for axis in "XYZ":
        name = axis.lower()
        if getattr(pose, f"lock_ik_{name}"):
            bounds[axis] = (0.0, 0.0)
        elif getattr(pose, f"use_ik_limit_{name}"):
            bounds[axis] = (getattr(pose, f"ik_min_{name}"), getattr(pose, f"ik_max_{name}"))
    return bounds


def as_wish(bounds):
    """A hinge where two axes are locked, else a ball."""
    locked = [axis for axis, (low, high) in bounds.items() if high - low < 1e-6 and abs(low) < 1e-6]
    free = [axis for axis in "XYZ" if axis not in locked]
    if len(free) == 0:
        return Wish("fixed")
    if len(free) == 1:
        turn = [("twist", *bounds[free[0]])] if free[0] in bounds else []
        return Wish("revolute", free[0], turn)
    return Wish("spherical", "Y", [(OF_AXIS[axis], *bounds[axis]) for axis in "YZX" if axis in bounds])


class RigidParts:
    """The rigid bodies of bones, made as joints ask for them, and the joints."""

    def __init__(self, writer):
        self.writer = writer

    def body(self, armature, bone):
        """The rigid body of a bone; its hull is what the build finds around the bone's sections."""
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
        wishes = {bone.name: wish_of(armature, bone, self.writer.findings) for bone in armature.data.bones}
        wanted = {name for name, wish in wishes.items() if wish is not None}
        wanted |= {bone.name for bone in armature.data.bones
                   if bone.soft_body_format.joint.simulated or bone.soft_body_format.joint.use_mass}
        for bone in armature.data.bones:
            if bone.name in wanted:
                self.body(armature, bone)
            if wishes[bone.name] is not None and bone.parent is not None:
                self.joint(armature, bone, wishes[bone.name], self.above(armature, bone, wanted))

    def above(self, armature, bone, wanted):
        """The rigid body a bone hangs on: of the nearest bone above that has one, else of its parent."""
        parent = bone.parent
        while parent is not None and parent.name not in wanted and \
                not self.writer.identifiers.known("rigid", (armature.name, parent.name)):
            parent = parent.parent
        return self.body(armature, parent if parent is not None else bone.parent)

    def joint(self, armature, bone, wish, above):
        writer = self.writer
        below = self.body(armature, bone)
        frame = armature.matrix_world @ bone.matrix_local
        turn = frame.to_3x3().normalized() @ ABOUT[wish.axis]
        rotation = writer.space.rotation(turn.to_quaternion())
        place = writer.space.point(frame.translation)
        made = writer.asset.add("joints", id=writer.identifiers.of("joint", (armature.name, bone.name), bone.name),
                                name=bone.name, kind=wish.kind, body_a=above.id, body_b=below.id)
        for record, holder in ((made.frame_a, above), (made.frame_b, below)):
            record.position = tuple(a - b for a, b in zip(place, holder.center))
            record.rotation = rotation
        settings = bone.soft_body_format.joint
        for target, low, high in wish.bounds:
            if low > high:
                writer.findings.error(f"the least {target} ({low:.3g}) is above the most ({high:.3g}): exchange them",
                                      object_name=armature.name, bone_name=bone.name)
                continue
            made.limits.append(Record("limit", target=target, min=low, max=high, stiffness=settings.limit_stiffness,
                                      damping=settings.limit_damping))
        if settings.use_drive:
            for target in {"spherical": ("twist", "swing_y", "swing_z"), "revolute": ("twist", )}.get(wish.kind, ()):
                made.drives.append(Record("drive", target=target, stiffness=settings.drive_stiffness,
                                          damping=settings.drive_damping, maximum=settings.drive_maximum))
