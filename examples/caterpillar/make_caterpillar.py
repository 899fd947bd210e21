#!/usr/bin/env python3
"""Models the example caterpillar, a chain on fourteen feet: writes caterpillar.glb beside this file. See
modelling/character.py."""

import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from character import Character, main  # noqa: E402
from implicit import Body, along, beyond, both_of, either_of, mesh_of, paint, refine, smile_about, within  # noqa: E402
from model_files import Bone, Material  # noqa: E402
from skin_files import planted, smooth_weights  # noqa: E402

CELL_M = 0.014
MATERIALS = [Material("green", (0.36, 0.66, 0.10), 0.6), Material("belly", (0.90, 0.86, 0.42), 0.6),
             Material("spot", (0.06, 0.40, 0.42), 0.6), Material("foot", (0.88, 0.38, 0.10), 0.6),
             Material("face", (0.95, 0.55, 0.16), 0.6), Material("white", (0.95, 0.95, 0.93), 0.3),
             Material("eye", (0.02, 0.02, 0.03), 0.15)]
SEGMENTS, STEP = 7, 0.104
HEAD = (0.0, 0.182, 0.425)
EYE = (0.050, 0.212, 0.497)
FEELER = ((0.034, 0.265, 0.430), (0.056, 0.325, 0.440), (0.066, 0.372, 0.470))


def middle(i):
    """The middle of segment i, from the head on."""
    return (0.0, 0.128, 0.300 - STEP * i)


def radius(i):
    return 0.077 - 0.0035 * max(0, i - 3) ** 1.35


def leg(i):
    x, z = 0.060 - 0.0025 * max(0, i - 4), middle(i)[2]
    return ((x * 0.72, 0.092, z), (x * 1.18, 0.060, z + 0.012), (x * 1.08, 0.024, z), (x * 1.08, 0.010, z + 0.018))


def build_body():
    body = Body()
    for i in range(SEGMENTS):
        size = radius(i)
        body.ball(middle(i), (size, size * 0.98, size * 0.92), melt=0.020)
    body.ball((0.0, 0.120, middle(SEGMENTS - 1)[2] - 0.065), 0.036, melt=0.04)
    body.ball((0.0, 0.148, 0.365), 0.062, melt=0.03)                                     # neck
    body.ball(HEAD, (0.098, 0.090, 0.088), melt=0.03)
    body.both(body.ball, (0.056, 0.160, 0.472), (0.036, 0.032, 0.030), melt=0.03)         # cheeks
    body.ball((0.0, 0.172, 0.512), (0.017, 0.014, 0.014), melt=0.010)                     # nose
    body.both(body.ball, EYE, (0.029, 0.034, 0.022), melt=0.003)
    body.both(body.tube, [*FEELER], (0.016, 0.0135, 0.0135), melt=0.012)
    body.both(body.ball, FEELER[2], 0.021, melt=0.008)
    for i in range(SEGMENTS):
        hip, knee, ankle, _ = leg(i)
        body.both(body.cone, hip, knee, 0.030, 0.022, melt=0.020)
        body.both(body.cone, knee, ankle, 0.021, 0.019, melt=0.012)
        body.both(body.ball, (ankle[0], 0.017, ankle[2] + 0.006), (0.023, 0.017, 0.026), melt=0.008)
    return body


def paint_rules():
    spots = either_of(*(within((0.046, middle(i)[1] + 0.052, middle(i)[2]), 0.030 - 0.0016 * i) for i in range(SEGMENTS)))
    under = either_of(*(along((0.0, 0.045, middle(i)[2] + 0.03), (0.0, 0.045, middle(i)[2] - 0.03), 0.058)
                        for i in range(SEGMENTS)))
    feet = both_of(beyond((0.0, 0.046, 0.0), (0.0, -1.0, 0.0)), beyond((0.036, 0.0, 0.0), (1.0, 0.0, 0.0)))
    smile = smile_about((0.0, 0.176, 0.512), 0.050, 0.042, 0.152)
    pupil = (EYE[0] - 0.004, EYE[1] + 0.003, EYE[2] + 0.024)
    return [("belly", under), ("spot", spots), ("foot", either_of(feet, within(FEELER[2], 0.026),
                                                                    within((0.0, 0.172, 0.520), 0.019))),
            ("face", along(HEAD, (0.0, 0.182, 0.520), 0.080, 0.100)), ("foot", within((0.0, 0.172, 0.520), 0.0175)),
            ("white", both_of(within(EYE, 0.0335), beyond(EYE, (0.0, 0.0, 1.0)))), ("eye", either_of(within(pupil, 0.0175), smile))]


def build_bones():
    side = (1.0, 0.0, 0.0)
    positions = [HEAD[2] - 0.045, *(middle(i)[2] + 0.5 * STEP for i in range(1, SEGMENTS))]
    positions.append(middle(SEGMENTS - 1)[2] - 0.085)
    names = [f"segment{i + 1}" for i in range(SEGMENTS)]
    bones = [Bone(names[i], names[i - 1] if i else None, (0.0, 0.128, positions[i]), (0.0, 0.128, positions[i + 1]), side)
             for i in range(SEGMENTS)]
    bones.append(Bone("head", "segment1", (0.0, 0.150, 0.365), (0.0, 0.190, 0.500), side))
    for i in range(SEGMENTS):
        for letter, s in (("L", 1.0), ("R", -1.0)):
            points = [(s * x, y, z) for x, y, z in leg(i)]
            parts = [f"leg{i + 1}_{part}.{letter}" for part in ("upper", "lower", "foot")]
            bones += [Bone(parts[k], parts[k - 1] if k else names[i], points[k], points[k + 1], side) for k in range(3)]
    for letter, s in (("L", 1.0), ("R", -1.0)):
        points = [(s * x, y, z) for x, y, z in FEELER]
        bones += [Bone(f"feeler{k + 1}.{letter}", f"feeler{k}.{letter}" if k else "head", points[k], points[k + 1], side)
                  for k in range(2)]
    return bones


def build():
    body, bones = build_body(), build_bones()
    fine = either_of(within(EYE, 0.042), smile_about((0.0, 0.176, 0.512), 0.056, 0.036, 0.155),
                     within((0.0, 0.172, 0.512), 0.018))
    mesh = paint(refine(mesh_of(body, CELL_M, "caterpillar"), body, fine), body, paint_rules(), "green")
    mesh.stand().round_points()
    weights = planted(mesh.points, bones, smooth_weights(mesh.points, bones, 0.028), 0.022)
    return Character("caterpillar", "Caterpillar: an example character of sbfmt, a chain with feet", mesh, bones, weights,
                     MATERIALS)


if __name__ == "__main__":
    sys.exit(main(build, FOLDER))
