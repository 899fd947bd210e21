"""Makes complete characters by script, as artists make them. Each function fills the scene; tests compare exports with its settings."""

import bmesh
import bpy
import fixtures
from mathutils import Vector


def limbs(name, parts):
    """One mesh of closed tubes, each along a bone; {bone: its vertices}. `parts`: (bone, head, tail, radius)."""
    made, of_bone = bmesh.new(), {}
    for bone, head, tail, radius in parts:
        head, tail = Vector(head), Vector(tail)
        turn = (tail - head).to_track_quat("Z", "Y").to_matrix().to_4x4()
        turn.translation = (head + tail) / 2
        first = len(made.verts)
        bmesh.ops.create_cone(made, cap_ends=True, segments=8, radius1=radius, radius2=0.8 * radius, depth=(tail - head).length,
                              matrix=turn)
        of_bone[bone] = range(first, len(made.verts))
    return fixtures.finish(name, made), of_bone


def shade(made, *names):
    for name in names:
        material, shader = fixtures.shaded(name)
        shader.inputs["Base Color"].default_value = (0.5, 0.25, 0.125, 1)
        shader.inputs["Roughness"].default_value = 0.75
        made.data.materials.append(material)
    return made


# ---- A biped: one skin, joints of every origin, a gait of two legs ----

BIPED_BONES = [("hips", None, (0, 0, 1.0), (0, 0, 1.15), 0), ("spine", "hips", (0, 0, 1.15), (0, 0, 1.35), 10),
               ("chest", "spine", (0, 0, 1.35), (0, 0, 1.5), 20), ("head", "chest", (0, 0, 1.5), (0, 0, 1.75), -30)] + [
    bone for side, x in (("L", 1), ("R", -1)) for bone in (
        (f"thigh.{side}", "hips", (0.12 * x, 0, 1.0), (0.12 * x, -0.03, 0.55), 5 * x),
        (f"shin.{side}", f"thigh.{side}", (0.12 * x, -0.03, 0.55), (0.12 * x, 0.02, 0.12), 0),
        (f"foot.{side}", f"shin.{side}", (0.12 * x, 0.02, 0.12), (0.12 * x, -0.18, 0.02), 0),
        (f"arm.{side}", "chest", (0.2 * x, 0, 1.45), (0.5 * x, 0, 1.4), 15 * x),
        (f"hand.{side}", f"arm.{side}", (0.5 * x, 0, 1.4), (0.75 * x, -0.05, 1.38), 0))]
BIPED_CONE, BIPED_KNEE, BIPED_ELBOW = 0.75, (-2.25, 0.125), (-0.5, 2.0)


def biped():
    rig = fixtures.armature("biped", BIPED_BONES)
    parts = [(name, head, tail, 0.09 if name in ("hips", "spine", "chest") else 0.05) for name, _, head, tail, _ in BIPED_BONES]
    skin, of_bone = limbs("skin", parts)
    weights = {name: {vertex: 1.0 for vertex in vertices} for name, vertices in of_bone.items()}
    for name, parent, *_ in BIPED_BONES:  # the first ring of each limb is shared with its parent
        if parent:
            for vertex in list(of_bone[name])[:8]:
                weights[name][vertex], weights[parent][vertex] = 0.625, 0.375
    fixtures.bind(skin, rig, weights)
    shade(skin, "skin", "cloth")
    skin.data.polygons[3].material_index = 1
    for polygon in skin.data.polygons:
        polygon.use_smooth = True
    for side in "LR":
        joint = rig.data.bones[f"thigh.{side}"].soft_body_format.joint
        joint.kind, joint.use_cone, joint.cone, joint.use_mass, joint.mass = "spherical", True, BIPED_CONE, True, 8
        knee = rig.pose.bones[f"shin.{side}"].constraints.new("LIMIT_ROTATION")
        knee.owner_space = "LOCAL"
        knee.use_limit_x = knee.use_limit_y = knee.use_limit_z = True
        knee.min_x, knee.max_x = BIPED_KNEE
        elbow = rig.pose.bones[f"hand.{side}"]
        elbow.use_ik_limit_z, elbow.ik_min_z, elbow.ik_max_z = True, *BIPED_ELBOW
        elbow.lock_ik_x = elbow.lock_ik_y = True
    gait = bpy.context.scene.soft_body_format.gait
    gait.use, gait.armature, gait.body, gait.hips, gait.chest, gait.head = True, rig, "hips", "hips", "chest", "head"
    gait.step_height, gait.step_duration, gait.walk_speed = 0.0625, 0.375, 0.75
    for group, side in enumerate("LR"):
        leg = gait.legs.add()
        leg.root, leg.end, leg.group = f"thigh.{side}", f"foot.{side}", group
    follower = gait.followers.add()
    follower.bone, follower.frequency, follower.damping_ratio, follower.response = "head", 3, 0.5, -0.5
    weight = gait.followers.add()
    weight.bone, weight.channel, weight.response, weight.strength, weight.limit = "hips", "weight", 2, 0.25, 0.125


# ---- A quadruped: parts on bones, four legs, a tail ----

QUADRUPED_BONES = [("pelvis", None, (0, 0.4, 0.6), (0, 0.1, 0.62), 0), ("back", "pelvis", (0, 0.1, 0.62), (0, -0.35, 0.62), 0),
                   ("neck", "back", (0, -0.35, 0.62), (0, -0.6, 0.8), 0), ("skull", "neck", (0, -0.6, 0.8), (0, -0.85, 0.78), 0),
                   ("tail1", "pelvis", (0, 0.4, 0.6), (0, 0.6, 0.58), 0), ("tail2", "tail1", (0, 0.6, 0.58), (0, 0.8, 0.55), 0),
                   ("tail3", "tail2", (0, 0.8, 0.55), (0, 1.0, 0.5), 0)] + [
    bone for end, parent, y in (("hind", "pelvis", 0.35), ("fore", "back", -0.3)) for side, x in (("L", 0.15), ("R", -0.15))
    for bone in ((f"{end}1.{side}", parent, (x, y, 0.6), (x, y + 0.06, 0.33), 0),
                 (f"{end}2.{side}", f"{end}1.{side}", (x, y + 0.06, 0.33), (x, y, 0.08), 0),
                 (f"{end}3.{side}", f"{end}2.{side}", (x, y, 0.08), (x, y - 0.1, 0.02), 0))]


def quadruped():
    """Its parts are made where their bones are, and hung on them with an offset that Blender keeps apart."""
    rig = fixtures.armature("quadruped", QUADRUPED_BONES)
    for name, _, head, tail, _ in QUADRUPED_BONES:
        part, _ = limbs(f"part of {name}", [(name, head, tail, 0.12 if name in ("pelvis", "back") else 0.045)])
        fixtures.hang(shade(part, "fur"), rig, name)
        part.soft_body_format.attributes.preset = "flesh"
    gait = bpy.context.scene.soft_body_format.gait
    gait.use, gait.armature, gait.body, gait.hips, gait.chest, gait.head = True, rig, "pelvis", "pelvis", "back", "skull"
    for name, group in (("hind3.L", 0), ("hind3.R", 1), ("fore3.L", 1), ("fore3.R", 0)):
        leg = gait.legs.add()
        leg.root, leg.end, leg.group = name.replace("3", "1"), name, group
        leg.use_pole, leg.pole = True, (0.15 if name.endswith("L") else -0.15, 2 if name.startswith("hind") else -2, 0.3)
    tail = gait.tails.add()
    tail.root, tail.frequency = "tail1", 1.5


# ---- A cape of cloth, held at its collar ----

def cape():
    rig = fixtures.armature("wearer", [("chest", None, (0, 0, 1.2), (0, 0, 1.5), 0), ("neck", "chest", (0, 0, 1.5), (0, 0, 1.6), 0)])
    fixtures.hang(fixtures.box("torso", (0.4, 0.2, 0.4), (0, 0, 1.3)), rig, "chest")
    columns, rows = 9, 13
    places = [(0.1 * i - 0.4, 0.15 + 0.01 * j, 1.5 - 0.1 * j) for j in range(rows) for i in range(columns)]
    faces = [(j * columns + i, j * columns + i + 1, (j + 1) * columns + i + 1, (j + 1) * columns + i)
             for j in range(rows - 1) for i in range(columns - 1)]
    made = fixtures.mesh_object("cape", places, faces)
    made.vertex_groups.new(name="collar").add(list(range(columns)), 1.0, "REPLACE")
    fixtures.hang(made, rig, "neck")
    found = made.modifiers.new("Cloth", "CLOTH")
    cloth = found.settings
    cloth.mass, cloth.tension_stiffness, cloth.shear_stiffness, cloth.bending_stiffness = 0.005, 12, 4, 0.25
    cloth.vertex_group_mass, cloth.air_damping = "collar", 0.5
    found.collision_settings.use_self_collision = True


# ---- A soft blob with a goal that fades ----

def blob():
    made = fixtures.ball("blob", 0.4, (0, 0, 0.5), 12, 8)
    group = made.vertex_groups.new(name="goal")
    for vertex in made.data.vertices:
        group.add([vertex.index], max(0.0, min(1.0, 0.9 - vertex.co.z)), "REPLACE")
    made.modifiers.new("Softbody", "SOFT_BODY")
    soft = made.soft_body
    soft.mass, soft.pull, soft.push, soft.damping, soft.bend = 0.02, 0.8, 0.8, 2, 2
    soft.vertex_group_goal, soft.goal_default, soft.goal_spring, soft.goal_friction = "goal", 0.75, 0.5, 5
    soft.use_stiff_quads, soft.shear = True, 0.5


# ---- A ragdoll: rigid bodies and constraints of several kinds ----

RAGDOLL_PARTS = {"torso": ((0.4, 0.2, 0.6), (0, 0, 1.2), 30), "head": ((0.2, 0.2, 0.25), (0, 0, 1.65), 5),
                 "upper.L": ((0.3, 0.1, 0.1), (0.37, 0, 1.4), 2), "lower.L": ((0.3, 0.08, 0.08), (0.69, 0, 1.4), 1.5),
                 "thigh.L": ((0.14, 0.14, 0.4), (0.12, 0, 0.68), 7), "shin.L": ((0.12, 0.12, 0.4), (0.12, 0, 0.26), 4)}
RAGDOLL_JOINTS = {"neck": ("POINT", "torso", "head", (0, 0, 1.51)), "shoulder.L": ("GENERIC", "torso", "upper.L", (0.21, 0, 1.4)),
                  "elbow.L": ("HINGE", "upper.L", "lower.L", (0.53, 0, 1.4)), "hip.L": ("GENERIC", "torso", "thigh.L", (0.12, 0, 0.89)),
                  "knee.L": ("HINGE", "thigh.L", "shin.L", (0.12, 0, 0.47))}
RAGDOLL_BOUNDS = (-0.5, 1.25)


def ragdoll():
    for name, (size, center, mass) in RAGDOLL_PARTS.items():
        made = fixtures.box(name, size)
        made.location = center
        bpy.context.view_layer.objects.active = made
        bpy.ops.rigidbody.object_add()
        made.rigid_body.mass, made.rigid_body.friction, made.rigid_body.collision_shape = mass, 0.625, "BOX"
    for name, (kind, above, below, position) in RAGDOLL_JOINTS.items():
        made = fixtures.link(bpy.data.objects.new(name, None))
        made.location = position
        bpy.context.view_layer.objects.active = made
        bpy.ops.rigidbody.constraint_add(type=kind)
        joint = made.rigid_body_constraint
        joint.object1, joint.object2 = bpy.data.objects[above], bpy.data.objects[below]
        for axis in ("z", ) if kind == "HINGE" else "xyz" if kind == "GENERIC" else ():
            setattr(joint, f"use_limit_ang_{axis}", True)
            setattr(joint, f"limit_ang_{axis}_lower", RAGDOLL_BOUNDS[0])
            setattr(joint, f"limit_ang_{axis}_upper", RAGDOLL_BOUNDS[1])
        for axis in "xyz" if kind == "GENERIC" else ():
            setattr(joint, f"use_limit_lin_{axis}", True)
            setattr(joint, f"limit_lin_{axis}_lower", 0)
            setattr(joint, f"limit_lin_{axis}_upper", 0)


# ---- Names, several rigs, duplicates, mirrors ----

NAMES = {"rig": "Костяк «один»", "bone": "хвост 🦎", "mesh": "Löwe 猫 <&>'\"", "material": "кожа", "group": "привязка ☂", "uv": "développé",
         "key": "улыбка"}


def names_beyond_ascii():
    rig = fixtures.armature(NAMES["rig"], [(NAMES["bone"], None, (0, 0, 0), (0, 0, 1), 0)])
    made = shade(fixtures.ball(NAMES["mesh"], 0.4, (0, 0, 0.5)), NAMES["material"])
    made.data.uv_layers.new(name=NAMES["uv"])
    made.shape_key_add(name="Basis")
    made.shape_key_add(name=NAMES["key"]).data[0].co.z += 0.1
    made.vertex_groups.new(name=NAMES["group"]).add([0, 1], 1.0, "REPLACE")
    fixtures.hang(made, rig, NAMES["bone"])
    pin = made.soft_body_format.pins.add()
    pin.group, pin.armature, pin.bone = NAMES["group"], rig, NAMES["bone"]


def two_armatures():
    """A rider and a mount whose bones have the same names."""
    for name, x in (("mount", 0.0), ("rider", 0.25)):
        rig = fixtures.armature(name, [("root", None, (x, 0, 0), (x, 0, 1), 0), ("top", "root", (x, 0, 1), (x, 0, 2), 0)])
        rig.location = (0, 3 * x, 0)
        for bone, height in (("root", 0.5), ("top", 1.5)):
            fixtures.hang(fixtures.ball(f"{name} {bone}", 0.3, (x, 3 * x, height)), rig, bone)


DUPLICATES = {"one": ((0, 0, 0), 0, 1), "two": ((2, 0, 0), 0.5, 1), "three": ((4, 1, 0), 1.5, 0.5)}


def linked_duplicates():
    shared = fixtures.ball("one", 0.4, (0, 0, 0.5)).data
    for name, (position, turn, scale) in DUPLICATES.items():
        made = bpy.data.objects.get(name) or fixtures.link(bpy.data.objects.new(name, shared))
        made.location, made.rotation_euler, made.scale = position, (0, 0, turn), (scale, ) * 3


def mirrored_objects():
    """A half with a mirror modifier, one mirrored by its scale, and one mirrored twice, which is a turn."""
    half = fixtures.box("half", (1, 1, 1), (0.5, 0, 0))
    half.modifiers.new("Mirror", "MIRROR")
    half.modifiers["Mirror"].use_mirror_merge = False
    for name, scale, x in (("mirrored", (-1, 1, 1), 3), ("turned", (-1, -1, 1), 5)):
        made = fixtures.box(name, (1, 2, 1), (0.25, 0, 0))
        made.scale, made.location = scale, (x, 0, 0)


ALL = {"biped": biped, "quadruped": quadruped, "cape": cape, "blob": blob, "ragdoll": ragdoll, "names": names_beyond_ascii,
       "two_armatures": two_armatures, "duplicates": linked_duplicates, "mirrored": mirrored_objects}


def closed_volume(positions, sizes, corners):
    """Enclosed by polygons, by fans of each; negative where they face inwards."""
    places = [Vector(positions[i:i + 3]) for i in range(0, len(positions), 3)]
    total, first = 0.0, 0
    for size in sizes:
        around = [places[i] for i in corners[first:first + size]]
        total += sum(around[0].dot(around[i].cross(around[i + 1])) / 6 for i in range(1, size - 1))
        first += size
    return total


def asset_space(position):
    x, y, z = position
    return (x, z, -y)
