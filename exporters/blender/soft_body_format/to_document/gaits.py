"""The gait of the scene's panel, and what rests on it: chains of inverse kinematics, tails, followers."""

from mathutils import Vector

from ..sbfmt.document import Record


class GaitWriter:
    def __init__(self, writer, gait):
        self.writer, self.gait, self.armature = writer, gait, writer.exported(gait.armature)
        self.bones = gait.armature.data.bones

    def id(self, kind, settings, name):
        return self.writer.identifiers.of(kind, name, name, settings.identity)

    def fault(self, message, bone=""):
        self.writer.findings.error(f"{message}, in Scene > Soft body format > Gait", object_name=self.armature.name, bone_name=bone)

    def bone(self, name, what):
        """The id of a bone that the panel names; an error where it is gone."""
        found = self.writer.skeleton.id(self.armature, name)
        if found is None:
            self.fault(f"{what} names the bone {name!r}, which is not there: choose another one")
        return found

    def optional(self, name, what):
        return self.bone(name, what) if name else None

    def chain(self, root, end, what):
        """Bones from root to end, or None with an error."""
        found, bone = [], self.bones.get(end)
        while bone is not None:
            found.insert(0, bone)
            if bone.name == root:
                return found
            bone = bone.parent
        self.fault(f"{what} goes from {root!r} to {end!r}, but the second does not hang below the first: choose others")
        return None

    def write(self):
        writer, gait = self.writer, self.gait
        if not self.bones or writer.skeleton.number(self.armature, self.bones[0].name) is None:
            self.fault("the armature of the gait is not exported: export it too")
            return
        body = self.bone(gait.body or self.bones[0].name, "the body")
        record = writer.asset.add("gaits", id=self.id("gait", self.gait, self.armature.name), name=self.armature.name, body=body,
                                  hips=self.optional(gait.hips, "the hips"), chest=self.optional(gait.chest, "the chest"))
        for name in ("step_height", "step_width", "step_trigger"):
            setattr(record, name, getattr(gait, name) * writer.space.unit_m)
        for name in ("step_duration", "walk_speed", "hip_tilt", "body_tilt"):
            setattr(record, name, getattr(gait, name))
        for leg in gait.legs:
            self.leg(record, leg)
        if gait.head:
            record.add("head", bone=self.bone(gait.head, "the head"), lead=gait.head_lead, limit=gait.head_limit)
        for tail in gait.tails:
            self.tail(record, tail)
        for follower in gait.followers:
            writer.asset.add("followers", id=self.id("follower", follower, follower.bone),
                             bone=self.bone(follower.bone, "a follower"), channel=follower.channel,
                             frequency=follower.frequency, damping_ratio=follower.damping_ratio, response=follower.response,
                             axis=follower.axis, strength=follower.strength, limit=follower.limit)

    def leg(self, record, leg):
        writer = self.writer
        bones = self.chain(leg.root, leg.end, "a leg")
        if bones is None:
            return
        foot = self.armature.matrix_world @ bones[-1].head_local
        chain = writer.asset.add("ik_chains", id=self.id("ik", leg, leg.end), name=leg.end, solver=leg.solver,
                                 root=writer.skeleton.id(self.armature, leg.root), end=writer.skeleton.id(self.armature, leg.end))
        if leg.use_pole:
            chain.has_pole, chain.pole = True, writer.space.point(Vector(leg.pole))
        home = writer.space.point(Vector(leg.home) if leg.use_home else foot)
        record.legs.append(Record("leg", name=leg.end, ik=chain.id, home=home, sole=self.sole(bones[-1], home), group=leg.group))

    def sole(self, foot, home):
        """How far the foot bone's head is above the lowest of the foot: the head's and the tails' of the bones below it."""
        points = [foot.tail_local] + [bone.tail_local for bone in foot.children_recursive]
        heights = [self.writer.space.point(self.armature.matrix_world @ point)[1] for point in points]
        return max(0.0, home[1] - min(heights))

    def tail(self, record, tail):
        end, bone = tail.end, self.bones.get(tail.root)
        while not end and bone is not None:
            bone, end = (bone.children[0], "") if len(bone.children) == 1 else (None, bone.name)
        bones = self.chain(tail.root, end, "a tail")
        if bones is None:
            return
        writer = self.writer
        chain = writer.asset.add("chains", id=self.id("chain", tail, tail.root), name=tail.root, kind="lag",
                                 bones=[writer.skeleton.number(self.armature, one.name) for one in bones])
        record.tails.append(Record("tail", chain=chain.id, frequency=tail.frequency, damping_ratio=tail.damping_ratio,
                                   limit=tail.limit))
