"""Imports inverse kinematics chains that no leg uses as IK constraints, with empties as targets."""

import bpy
from mathutils import Vector


def fill_chains(maker):
    """Adds one constraint for each chain, to the bone before the chain's end. Its target is an empty at the end's rest position."""
    document, armature = maker.document, maker.armature
    legs = {leg.ik for gait in document.gaits[:1] for leg in gait.legs}
    for chain in document.ik_chains:
        if armature is None or chain.id in legs:
            continue
        end = armature.data.bones[maker.names[chain.end]]
        bones = [end]
        while bones[-1].parent is not None and bones[-1].name != maker.names[chain.root]:
            bones.append(bones[-1].parent)
        if len(bones) < 2:
            continue
        end.soft_body_format.chain_identity = chain.id
        make_constraint(maker, chain, bones[1:], end)
        for comfort in chain.comforts:
            pose = armature.pose.bones[maker.names[comfort.bone]]
            pose.ik_stiffness_x, pose.ik_stiffness_y, pose.ik_stiffness_z = (min(comfort.weight * fraction, 0.99) for fraction in comfort.axes)


def make_constraint(maker, chain, bones, end):
    made = maker.armature.pose.bones[bones[0].name].constraints.new("IK")
    made.name, made.chain_count, made.iterations = chain.name or chain.id, len(bones), max(chain.iterations, 1)
    made.use_rotation = chain.copy_rotation > 0.5
    made.target = make_empty(maker, f"{end.name} target", maker.armature.matrix_world @ end.head_local)
    made.target.rotation_euler = (maker.armature.matrix_world @ bones[0].matrix_local).to_euler()
    if chain.has_pole:
        made.pole_angle = pole_angle(bones[-1], bones[0], maker.space.point_back(chain.pole))
        if chain.pole_bone:
            made.pole_target, made.pole_subtarget = maker.armature, maker.names[chain.pole_bone]
        else:
            made.pole_target = make_empty(maker, f"{end.name} pole", maker.space.point_back(chain.pole))


def make_empty(maker, name, position):
    made = bpy.data.objects.new(name, None)
    made.location, made.empty_display_size = position, 0.1 * max(maker.armature.dimensions) or 0.1
    maker.collection.objects.link(made)
    return made


def pole_angle(root, last, pole):
    """The angle about the root bone from its X axis to the plane of the chain and the pole. It keeps the chain in its rest pose."""
    along = root.tail_local - root.head_local
    normal = (last.tail_local - root.head_local).cross(Vector(pole) - root.head_local)
    wanted, across = normal.cross(along), root.matrix_local.to_3x3() @ Vector((1, 0, 0))
    if wanted.length < 1e-9 or along.length < 1e-9:
        return 0.0
    angle = across.angle(wanted)
    return angle if across.cross(wanted).dot(along) < 0 else -angle
