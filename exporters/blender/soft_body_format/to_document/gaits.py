"""Writes the gait of the scene's panel, with its inverse kinematics chains, tails and followers."""

import numpy
from mathutils import Vector

from ..sbfmt.document import Record
from .armatures import parent_in_file


GROUND_TOLERANCE = 0.05  # largest distance of a standing foot from the ground, as a fraction of the character's height


def heights_by_bone(asset):
    """The minimum y of the mesh points of which each bone has the largest weight, infinite without points; and the maximum y of all
    these points, or of the bones."""
    lowest, highest = numpy.full(len(asset.bones), numpy.inf), -numpy.inf
    number = {bone.id: index for index, bone in enumerate(asset.bones)}
    for record in (*asset.render_meshes, *asset.soft_bodies):
        skin = getattr(record, "skin", None) if record.element.name == "render_mesh" else None
        shown = record.mesh if record.element.name == "render_mesh" else record.surface
        heights = numpy.asarray(shown.positions, dtype=numpy.float32).reshape(-1, 3)[:, 1]
        if skin is not None:
            counts = numpy.asarray(skin.influence_counts, dtype=numpy.uint32)
            vertex = numpy.repeat(numpy.arange(len(counts)), counts)
            # The last entry of each vertex has the largest weight.
            order = numpy.lexsort((numpy.asarray(skin.weights, dtype=numpy.float32), vertex))
            last = order[numpy.flatnonzero(numpy.diff(vertex, append=len(counts)))] if len(vertex) else order
            highest = max(highest, heights[vertex].max(initial=highest))
            numpy.minimum.at(lowest, numpy.asarray(skin.bones, dtype=numpy.uint32)[last], heights[vertex[last]])
        elif record.bone in number and len(heights):
            lowest[number[record.bone]] = min(lowest[number[record.bone]], heights.min())
            highest = max(highest, heights.max())
    return lowest, highest if numpy.isfinite(highest) else max(bone.head[1] for bone in asset.bones)


class GaitWriter:
    def __init__(self, writer, gait):
        self.writer, self.gait, self.armature = writer, gait, writer.exported(gait.armature)
        self.bones = gait.armature.data.bones

    def id(self, kind, settings, name):
        return self.writer.identifiers.of(kind, name, name, settings.identity)

    def fault(self, message, bone=""):
        self.writer.findings.error(f"{message}, in Scene > Soft body format > Gait", object_name=self.armature.name, bone_name=bone)

    def bone(self, name, what):
        """The id of a bone that the panel names; an error if it does not exist."""
        found = self.writer.skeleton.id(self.armature, name)
        if found is None:
            self.fault(f"{what} names the bone {name!r}, which is not there: choose another one")
        return found

    def optional(self, name, what):
        return self.bone(name, what) if name else None

    def chain(self, root, end, what):
        """The bones from root to end, or None with an error."""
        found, bone = [], self.bones.get(end)
        while bone is not None:
            found.insert(0, bone)
            if bone.name == root:
                return found
            bone = parent_in_file(bone)
        self.fault(f"{what} goes from {root!r} to {end!r}, but the second is no descendant of the first: choose others")
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
        self.lowest, self.highest = heights_by_bone(writer.asset)
        for leg in gait.legs:
            self.leg(record, leg)
        self.check_feet_on_ground(record)
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
        """The height of the foot bone's head above the lowest mesh point of it and its descendants. Without mesh points: above the lowest
        of their tails."""
        below = [foot, *foot.children_recursive]
        low = min(self.lowest[self.writer.skeleton.number(self.armature, bone.name)] for bone in below)
        if not numpy.isfinite(low):
            low = min(self.writer.space.point(self.armature.matrix_world @ bone.tail_local)[1] for bone in below)
        return max(0.0, home[1] - float(low))

    def check_feet_on_ground(self, record):
        """Warns about feet above or below the ground, because they would walk there."""
        if not record.legs:
            return
        low = min(leg.home[1] - leg.sole for leg in record.legs)
        if abs(low) > GROUND_TOLERANCE * (self.highest - low):
            space = self.writer.space
            self.writer.findings.warning(
                f"its feet are {abs(low):.3g} m {'above' if low > 0 else 'below'} the ground: set Stands at to "
                f"{space.ground + low / space.unit_m:.4g}, in Scene > Soft body format", object_name=self.armature.name, code="GAIT_GROUND")

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
