"""Trunk, tail, neck and legs of the lizard: lofted pieces of its skin from joint to joint."""

import math

import modelling_path  # noqa: F401
from lizard_shape import BODY, METRES_AT, PROFILE
from loft import Cap, loft
from quad_mesh import sub


def both_sides(half):
    """Takes angles in degrees from the bottom up the +x side to the top. Returns radians, with the other side added."""
    return [math.radians(a) for a in half] + [math.radians(360.0 - a) for a in half[-2:0:-1]]


def spaced(start, end, rows):
    return [start + (end - start) * i / rows for i in range(rows + 1)]


TRUNK_ANGLES = both_sides([0.0, 22.5, 45.0, 67.5, 90.0, 112.5, 135.0, 157.5, 180.0])
TAIL_JOINTS = [METRES_AT[z] for z in (-0.715, -0.600, -0.505, -0.405, -0.305, -0.205)]


def trunk_material(s, k):
    """Cream below, a pale line along the flank, a dark stripe down the back."""
    return ("belly", "belly", "belly", "flank", "back", "back", "back", "stripe")[min(k, 15 - k)]


def tail_material(s, k):
    """Like the trunk, with a dark band around the middle of each piece."""
    name = trunk_material(s, k)
    banded = any(0.75 * a + 0.25 * b < s < 0.25 * a + 0.75 * b for a, b in zip(TAIL_JOINTS, TAIL_JOINTS[1:]))
    return "stripe" if banded and name in ("back", "flank") else name


def piece(name, start_z, end_z, rows, material, loops):
    """A piece of the trunk or tail between two joints."""
    start, end = METRES_AT[start_z], METRES_AT[end_z]
    caps = [Cap(0.85 * PROFILE(s)[0], loops) for s in (start, end)]
    return loft(name, BODY, spaced(start, end, rows), lambda s: TRUNK_ANGLES, caps[0], caps[1], material)


def trunk_and_tail():
    start, end = METRES_AT[-0.715], METRES_AT[-0.600]
    tip = loft("Tail5", BODY, spaced(start, end, 4), lambda s: TRUNK_ANGLES,
               Cap(0.010, (), 2.0), Cap(0.85 * PROFILE(end)[0]), tail_material)
    return [
        piece("Pelvis", -0.205, -0.070, 4, trunk_material, (0.25, 0.65)),
        piece("Spine", -0.070, 0.055, 4, trunk_material, (0.25, 0.65)),
        piece("Chest", 0.055, 0.170, 4, trunk_material, (0.25, 0.65)),
        piece("Neck", 0.170, 0.240, 3, trunk_material, (0.3,)),
        piece("Tail1", -0.305, -0.205, 4, tail_material, (0.3,)),
        piece("Tail2", -0.405, -0.305, 4, tail_material, (0.3,)),
        piece("Tail3", -0.505, -0.405, 4, tail_material, (0.3,)),
        piece("Tail4", -0.600, -0.505, 4, tail_material, (0.3,)),
        tip,
    ]


LEG_ANGLES = [math.radians(30.0 * k) for k in range(12)]


def leg_material(leg):
    """Cream on the four faces that look down along the upper leg and inward along the lower."""
    def side(s, k):
        return sub(leg.tube.point(s, math.radians(30.0 * k + 15.0)), leg.tube.centre(s))

    upper, lower = 0.5 * leg.knee_at, 0.5 * (leg.knee_at + leg.ankle_at)
    ranked = sorted(range(12), key=lambda k: side(upper, k)[1] + side(lower, k)[0])
    return lambda s, k: "belly" if k in ranked[:4] else "back"


def upper_and_lower(leg):
    """The two lofted sections of a left leg; rows are close together where the skin bends most."""
    def radius(s):
        return leg.tube.profile(s)[0]

    out, knee, ankle, material = leg.skin.at, leg.knee_at, leg.ankle_at, leg_material(leg)
    joint = Cap(0.9 * radius(knee), power=2.0, grid=2)
    upper = loft(leg.names[0] + ".L", leg.skin,
                 [0.0, out, out + 0.010, out + 0.024, out + 0.045, knee - 0.014, knee], lambda s: LEG_ANGLES,
                 Cap(0.5 * radius(0.0), grid=2), joint, material)
    lower = loft(leg.names[1] + ".L", leg.tube,
                 [knee, knee + 0.014, *spaced(knee + 0.034, ankle, 3)], lambda s: LEG_ANGLES,
                 joint, Cap(0.65 * radius(ankle), (0.5,), 2.0, 2), material)
    return [upper, lower]
