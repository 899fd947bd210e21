"""Makes rigged files whose OBJ has another pose than the rig's mesh: hanging arms, legs in mid-stride."""

import math
import os

from bundle_file import Bundle, apply, inverse, matrix_of, product
from rigged_weights import clip_motions, posed, weights_by_vertex
from sbfmt_program import ROOT, shared
from skinned_glb import SkinnedGlb

# Examples and, where it is there, ../shared/zoo. File, and degrees about an axis of the asset for the bones of its left side: those of the right are their mirror
# image. "x", "y" and "z" turn forwards, about the vertical and sidewards; "stride" forwards, and backwards on the right.
POSES = [
    ("zoo/modular_men/Casual.glb", {"UpperArm": ("z", -45)}),
    ("zoo/modular_women/Formal.glb", {"UpperArm": ("z", -50), "LowerArm": ("y", -20)}),
    ("zoo/modular_men/Worker.glb", {"UpperArm": ("z", -30), "UpperLeg": ("stride", 20)}),
    ("zoo/modular_women/Witch.glb", {"UpperArm": ("z", -40), "LowerArm": ("y", -30), "UpperLeg": ("z", 15)}),
    ("zoo/godot_demos/mannequiny.glb", {"upperarm": ("z", -60), "thigh": ("z", 15)}),
    ("zoo/single_knight_pack/KnightCharacter.glb", {"UpperArm": ("z", -45)}),
    ("zoo/platformer_game_pack/Character.glb", {"UpperArm": ("z", -40)}),
    ("zoo/cyberpunk_pack/Character.glb", {"UpperArm": ("z", -45), "LowerArm": ("y", -40)}),
    ("zoo/mech_pack/George.glb", {"UpperArm": ("z", -40)}),
    ("zoo/animals_pack/Horse.glb", {"FrontUpperLeg": ("stride", 30), "BackLeg": ("stride", -25)}),
    ("zoo/animals_pack/Husky.glb", {"FrontUpperLeg": ("x", 25), "FrontLowerLeg": ("x", 30), "BackLeg": ("x", 20)}),
    ("zoo/animals_pack/Stag.glb", {"FrontUpperLeg": ("stride", 25), "BackLeg": ("stride", 25), "Neck1": ("x", 25)}),
    ("zoo/dinosaurs_pack/Triceratops.glb", {"FrontUpLeg": ("stride", 25), "BackUpLeg": ("stride", 20)}),
    ("zoo/easy_enemies_pack/Frog.glb", {"FrontUpLeg": ("z", 30)}),
    ("zoo/platformer_game_pack/Bee.glb", {"Wing1": ("z", 30)}),
    ("zoo/animals_pack/Alpaca.glb", {"FrontUpperLeg": ("stride", 30), "BackLeg": ("stride", -25)}),
    ("examples/calf/calf.glb", {"fore_upper": ("stride", 30), "hind_upper": ("stride", 30)}),
    ("examples/pup/pup.glb", {"fore_upper": ("x", 30), "fore_lower": ("x", 40), "hind_upper": ("x", -25)}),
    ("examples/yeti/yeti.glb", {"upper_arm": ("z", 45)}),
    ("examples/spider/spider.glb", {"leg1_upper": ("z", 25), "leg4_upper": ("z", -20)}),
]


STILL = matrix_of()  # of nodes above the bones, which become bones where no skin says which nodes are


def path_of(name):
    return os.path.join(ROOT, name) if name.startswith("examples") else shared("..", name)


def side_of(name):
    """The name without its side, and 1 for left, -1 for right, 0 for neither."""
    stem, dot, side = name.rpartition(".")
    return (stem, {"l": 1, "r": -1}[side.lower()]) if dot and side.lower() in "lr" else (name, 0)


def rotation_of(axis, degrees, side):
    turn, sign = math.radians(degrees) / 2, side or 1
    if axis == "stride":
        axis, turn = "x", turn * sign
    elif axis != "x":
        turn *= sign
    return [math.sin(turn) * (a == axis) for a in "xyz"] + [math.cos(turn)]


def pose_motions(bundle_path, turns):
    """How each bone moves from rest, by name, where those of `turns` are turned about their joints."""
    bundle, motions = Bundle(bundle_path), []
    for i, name in enumerate(bundle.bone_names()):
        parent = bundle.parents[i]
        motion = motions[parent] if parent is not None else matrix_of()
        stem, side = side_of(name)
        if stem in turns:
            joint = tuple(row[3] for row in bundle.rest[i])
            turn = matrix_of((0, 0, 0), rotation_of(*turns[stem], side))
            about = product(matrix_of(joint), product(turn, matrix_of(tuple(-x for x in joint))))
            motion = product(motion, about)
        motions.append(motion)
    return dict(zip(bundle.bone_names(), motions))


def pose_of(original, turns):
    """The original's OBJ in that pose, and the motions that took it there."""
    motions = pose_motions(original.bundle, turns)
    return posed(original, motions), motions


def skin_errors(original, variant, path, motions):
    """Distances, in shares of the longest side, between points of the rig's own mesh as the weights found for them move
    them and as its own weights do, by motions of its bones from the pose that they were bound in, in ascending order."""
    size = longest_side(original)
    errors = []
    for vertex, (weights, _) in weights_by_vertex(path).items():
        origins = variant.origins[vertex]
        expected, position = original.expected(origins), original.places[origins[0]]
        if not expected:
            continue
        for motion in motions:
            there, wanted = (tuple(sum(apply(motion.get(b, STILL), position)[k] * w for b, w in of.items()) for k in range(3))
                             for of in (weights, expected))
            errors.append(math.dist(there, wanted) / size)
    return sorted(errors)


def motions_to_compare(original, turns):
    """Moments of the file's clips; without any, the pose the other way round."""
    back = {name: (axis, -degrees) for name, (axis, degrees) in turns.items()}
    return clip_motions(original.bundle, 2, 3) or [pose_motions(original.bundle, back)]


def longest_side(original):
    return max(max(p[k] for p in original.places) - min(p[k] for p in original.places) for k in range(3))


def joint_error(original, path, motions):
    """The farthest that a joint whose bone moves points lies from where the pose took it, in shares of the longest
    side: the whole may be elsewhere, as on its ground."""
    rig, found = Bundle(original.bundle), Bundle(path)
    used = {bone for weights in original.weights for bone, weight in weights.items() if weight > 0.05}
    joints = {name: tuple(row[3] for row in rest) for name, rest in zip(found.bone_names(), found.rest)}
    offsets = []
    for name, rest in zip(rig.bone_names(), rig.rest):
        if name in used and name in joints:
            wanted = apply(motions[name], tuple(row[3] for row in rest))
            offsets.append(tuple(a - b for a, b in zip(joints[name], wanted)))
    middle = [sorted(o[k] for o in offsets)[len(offsets) // 2] for k in range(3)]
    return max(math.dist(o, middle) for o in offsets) / longest_side(original)


def write_bones(path, bones_path):
    """The file without its meshes."""
    file = SkinnedGlb.of(path)
    drawn = {i for i, node in enumerate(file.json["nodes"]) if "mesh" in node and not node.get("children")}
    for parent in [*file.json["nodes"], *file.json["scenes"]]:
        key = "children" if "children" in parent else "nodes"
        if key in parent:
            parent[key] = [i for i in parent[key] if i not in drawn]
            if not parent[key]:
                del parent[key]
    for node in file.json["nodes"]:
        node.pop("mesh", None)
        node.pop("skin", None)
    file.json.pop("meshes", None)
    file.json.pop("skins", None)
    file.write(bones_path)


def write_rest_bones(bundle_path, bones_path):
    """The bones of a bundle at rest, where their skin was bound, as a binary glTF without meshes."""
    bundle, file = Bundle(bundle_path), SkinnedGlb()
    frame, nodes = file.node("Armature"), []
    for name, parent, rest in zip(bundle.bone_names(), bundle.parents, bundle.rest):
        local = rest if parent is None else product(inverse(bundle.rest[parent]), rest)
        nodes.append(file.node(name, frame if parent is None else nodes[parent], local))
    file.write(bones_path)
