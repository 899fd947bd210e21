"""The lizard's bones, their limits, and the bone of each section."""

import math

import modelling_path  # noqa: F401
from lizard_shape import LEGS, SPINE, across_middle, on_spine
from model_files import Bone
from quad_mesh import scale

BONE_OF_PART = {"UpperArm": "upper_arm", "LowerArm": "lower_arm", "Hand": "hand",
                "UpperLeg": "upper_leg", "LowerLeg": "lower_leg", "Foot": "foot"}


def bone_of_section(name):
    stem, point, side = name.partition(".")
    return BONE_OF_PART.get(stem, stem.lower()) + point + side


def limits(swing_y, swing_z, twist):
    """Limits in radians from degrees; a single number is the limit in both directions."""
    def pair(value):
        low, high = value if isinstance(value, tuple) else (-value, value)
        return round(math.radians(low), 4), round(math.radians(high), 4)

    return {"swing_y": pair(swing_y), "swing_z": pair(swing_z), "twist": pair(twist)}


def build_bones():
    """Parents before children."""
    side = (1.0, 0.0, 0.0)
    tail_tip = (0.0, SPINE[0][1] + 0.003, SPINE[0][0] - 0.010)
    nose = (0.0, 0.218, 0.469)
    bones = [
        Bone("root", None, (0.0, 0.0, 0.0), (0.0, 0.1, 0.0), side),
        Bone("pelvis", "root", on_spine(-0.205), on_spine(-0.070), side, limits(20, 20, 15)),
        Bone("spine", "pelvis", on_spine(-0.070), on_spine(0.055), side, limits(25, 15, 15)),
        Bone("chest", "spine", on_spine(0.055), on_spine(0.170), side, limits(25, 15, 15)),
        Bone("neck", "chest", on_spine(0.170), on_spine(0.240), side, limits(35, 30, 20)),
        Bone("head", "neck", on_spine(0.240), nose, side, limits(40, (-35, 30), 25)),
        Bone("head_end", "head", nose, None, None),
    ]
    tail = [*map(on_spine, (-0.205, -0.305, -0.405, -0.505, -0.600)), tail_tip]
    for i in range(5):
        bones.append(Bone(f"tail{i + 1}", f"tail{i}" if i else "pelvis", tail[i], tail[i + 1], side,
                          limits(30 + 3 * i, 25 + 3 * i, 10)))
    bones.append(Bone("tail5_end", "tail5", tail_tip, None, None))
    for leg in LEGS:
        for letter in "LR":
            bones += leg_bones(leg, letter)
    return bones


def leg_bones(leg, letter):
    points, hinge = [*leg.joints, leg.toes], leg.hinge
    if letter == "R":
        # the mirrored bone turns its +X over: its frame stays right-handed, and swing_z means the same on both sides
        points, hinge = [across_middle(p) for p in points], scale(across_middle(hinge), -1.0)
    names = [f"{BONE_OF_PART[part]}.{letter}" for part in leg.names]
    parents = [leg.parent, *names]
    bounds = (limits(50, 55, 40), limits(8, (-60, 65), 12), limits(25, 50, 20))
    bones = [Bone(names[i], parents[i], points[i], points[i + 1], hinge, bounds[i]) for i in range(3)]
    return [*bones, Bone(names[2] + "_end", names[2], points[3], None, None)]
