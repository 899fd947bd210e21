"""IK constraints of pose bones: chains with pole, stiffness as comfort."""

from ..sbfmt.document import Record


class IkConstraints:
    def __init__(self, writer, armature):
        self.writer, self.armature = writer, armature

    def write(self):
        for pose in self.armature.pose.bones:
            for one in pose.constraints:
                if one.type == "IK" and not one.mute and one.influence > 0:
                    self.chain(pose, one)

    def chain(self, pose, one):
        """The tail of the constrained bone reaches; here that is the head of a bone that begins there."""
        writer, bone = self.writer, self.armature.data.bones[pose.name]
        end = next((child for child in bone.children if (child.head_local - bone.tail_local).length < 1e-4), None)
        if end is None:
            writer.findings.warning("its IK constraint is left out: no bone begins at its tail, which is what reaches; add one there",
                                    object_name=self.armature.name, bone_name=pose.name)
            return
        bones = [bone]
        while bones[-1].parent is not None and (one.chain_count == 0 or len(bones) < one.chain_count):
            bones.append(bones[-1].parent)
        if any(chain.end == writer.skeleton.id(self.armature, end.name) for chain in writer.asset.ik_chains):
            return  # the gait has it already
        made = writer.asset.add("ik_chains", id=self.chain_id(end), name=one.name, end=self.id(end),
                                root=self.id(bones[-1]), solver="two_bone" if len(bones) == 2 else "ccd",
                                iterations=min(one.iterations, 100), copy_rotation=1.0 if one.use_rotation else 0.0)
        if one.pole_target is not None:
            self.pole(made, one)
        for link in bones:
            self.comfort(made, link)

    def chain_id(self, end):
        return self.writer.identifiers.of("ik", (self.armature.name, end.name), end.name, end.soft_body_format.chain_identity)

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
        """A stiff bone prefers its rest pose: the largest of its three stiffnesses is the weight."""
        pose = self.armature.pose.bones[bone.name]
        weight = max(pose.ik_stiffness_x, pose.ik_stiffness_y, pose.ik_stiffness_z)
        if weight > 0:
            made.comforts.append(Record("comfort", bone=self.id(bone), weight=weight))
