"""Writes IK constraints of pose bones as chains, with their pole and their stiffness (the format's comfort)."""

from ..sbfmt.document import Record
from .armatures import parent_in_file


class IkConstraints:
    def __init__(self, writer, armature):
        self.writer, self.armature = writer, armature

    def write(self):
        for pose in self.armature.pose.bones:
            for one in pose.constraints:
                if one.type == "IK" and not one.mute and one.influence > 0:
                    self.chain(pose, one)

    def chain(self, pose, one):
        """The end of the chain: a bone whose head is at the tail (or head) of the constrained bone, which reaches for the target."""
        writer, bone = self.writer, self.armature.data.bones[pose.name]
        last = bone if one.use_tail else parent_in_file(bone)
        if last is None:
            writer.findings.warning("its IK constraint is left out: it does not use the tail, and there is no bone above it to turn",
                                    object_name=self.armature.name, bone_name=pose.name)
            return
        end = self.end_of(bone) if one.use_tail else bone.name
        bones = [last]
        while parent_in_file(bones[-1]) is not None and (one.chain_count == 0 or len(bones) < one.chain_count):
            bones.append(parent_in_file(bones[-1]))
        if any(chain.end == writer.skeleton.id(self.armature, end) for chain in writer.asset.ik_chains):
            return  # the gait already has this chain
        made = writer.asset.add("ik_chains", id=self.chain_id(end), name=one.name,
                                end=writer.skeleton.id(self.armature, end),
                                root=self.id(bones[-1]), solver="two_bone" if len(bones) == 2 else "ccd",
                                iterations=min(one.iterations, 100), copy_rotation=1.0 if one.use_rotation else 0.0)
        if one.pole_target is not None:
            self.pole(made, one)
        for link in bones:
            self.comfort(made, link)

    def end_of(self, bone):
        """The name of a bone that begins at the tail. Adds one to the file if there is none."""
        found = next((child for child in bone.children if (child.head_local - bone.tail_local).length < 1e-4), None)
        if found is not None:
            return found.name
        writer, name = self.writer, f"{bone.name} tip"
        key = (self.armature.name, name)
        if writer.skeleton.id(self.armature, name) is None:
            frame, above = self.armature.matrix_world @ bone.matrix_local, writer.asset.find("bones", self.id(bone))
            writer.skeleton.ids[key] = writer.identifiers.of("bone", key, name)
            writer.skeleton.numbers[key] = len(writer.asset.bones)
            writer.asset.add("bones", id=writer.skeleton.ids[key], name=name, parent=above.id, length=0.1 * above.length,
                             head=writer.space.point(self.armature.matrix_world @ bone.tail_local),
                             rotation=writer.space.rotation(frame.to_quaternion()))
        return name

    def chain_id(self, end):
        bone = self.armature.data.bones.get(end)
        return self.writer.identifiers.of("ik", (self.armature.name, end), end, bone.soft_body_format.chain_identity if bone else "")

    def id(self, bone):
        return self.writer.skeleton.id(self.armature, bone.name)

    def pole(self, made, one):
        target = one.pole_target
        world = target.matrix_world.translation
        if target.type == "ARMATURE" and one.pole_subtarget in target.data.bones:
            world = target.matrix_world @ target.data.bones[one.pole_subtarget].head_local
            made.pole_bone = self.writer.skeleton.id(target, one.pole_subtarget)
        made.has_pole, made.pole = True, self.writer.space.point(world)

    def comfort(self, made, bone):
        """A stiff bone prefers its rest pose. The largest of its three stiffnesses is the weight; the others are fractions of it. Chains
        of more than two bones use Blender's solver, which applies the stiffness at any distance to the target."""
        pose = self.armature.pose.bones[bone.name]
        stiffness = (pose.ik_stiffness_x, pose.ik_stiffness_y, pose.ik_stiffness_z)
        weight = max(stiffness)
        if weight > 0:
            made.comforts.append(Record("comfort", bone=self.id(bone), weight=weight, axes=[one / weight for one in stiffness]))
            if made.solver == "ccd":
                made.solver = "damped_least_squares"
