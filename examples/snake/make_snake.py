#!/usr/bin/env python3
"""Models the example snake, a chain without limbs: writes snake.glb beside this file. See modelling/character.py."""

import math
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from character import Character, main  # noqa: E402
from implicit import Body, along, beyond, both_of, either_of, mesh_of, outside, paint, refine, within  # noqa: E402
from model_files import Bone, Material  # noqa: E402
from skin_files import smooth_weights  # noqa: E402

CELL_M = 0.0155
MATERIALS = [Material("back", (0.05, 0.28, 0.10), 0.45), Material("band", (0.72, 0.58, 0.10), 0.45),
             Material("belly", (0.88, 0.82, 0.56), 0.5), Material("tongue", (0.70, 0.05, 0.10), 0.5),
             Material("iris", (0.95, 0.72, 0.06), 0.2), Material("eye", (0.01, 0.01, 0.012), 0.1)]
LINKS, STEP, NECK_Z = 18, 0.105, 0.78
EYE = (0.042, 0.083, 0.885)


def radius_at(i):
    """Radius where link i begins."""
    t = i / LINKS
    return 0.034 + 0.026 * math.sin(math.pi * min(1.0, t * 1.15) ** 0.75) - 0.028 * t ** 5 * 1.0


def joint_at(i):
    return (0.0, radius_at(i) * 0.86, NECK_Z - STEP * i)


def build_body():
    body = Body()
    for i in range(LINKS):
        body.cone(joint_at(i), joint_at(i + 1), radius_at(i), radius_at(i + 1) if i + 1 < LINKS else 0.010, melt=0.01)
    body.ball((0.0, 0.056, 0.850), (0.056, 0.038, 0.078), melt=0.03)                     # skull
    body.ball((0.0, 0.047, 0.915), (0.040, 0.027, 0.052), melt=0.03)                     # snout
    body.both(body.ball, EYE, 0.0175, melt=0.004)
    body.both(body.ball, (0.036, 0.092, 0.868), (0.020, 0.010, 0.030), melt=0.012)        # brows
    return body


def paint_rules():
    diamonds = either_of(*(along((0.0, 2.2 * radius_at(i), joint_at(i)[2] - 0.05), (radius_at(i), 1.0 * radius_at(i), joint_at(i)[2] - 0.05),
                                 0.95 * radius_at(i), 0.2 * radius_at(i)) for i in range(LINKS - 1)))
    stripe = both_of(along((0.030, 0.070, 0.945), (0.060, 0.062, 0.760), 0.016, 0.012), outside(within(EYE, 0.010)))
    belly = either_of(along((0.0, -0.040, 0.960), (0.0, -0.050, -0.60), 0.080, 0.078),
                      along((0.0, -0.050, -0.60), (0.0, -0.020, -1.10), 0.078, 0.024))
    return [("band", either_of(diamonds, stripe)), ("belly", belly),
            ("tongue", both_of(within((0.0, 0.034, 0.968), 0.016, both=False), beyond((0.0, 0.046, 0.0), (0.0, -1.0, 0.0)))),
            ("iris", within(EYE, 0.0183)), ("eye", within((EYE[0] + 0.012, EYE[1] + 0.003, EYE[2] + 0.008), 0.0105))]


def build_bones():
    side = (1.0, 0.0, 0.0)
    bones = [Bone("head", None, joint_at(0), (0.0, 0.050, 0.965), side)]
    for i in range(LINKS):
        bones.append(Bone(f"body{i + 1}", f"body{i}" if i else "head", joint_at(i), joint_at(i + 1), side))
    return bones


def build():
    body, bones = build_body(), build_bones()
    fine = either_of(within(EYE, 0.024), within((0.0, 0.034, 0.968), 0.020, both=False))
    mesh = paint(refine(mesh_of(body, CELL_M, "snake"), body, fine), body, paint_rules(), "back")
    mesh.stand().round_points()
    return Character("snake", "Snake: an example character of sbfmt without legs", mesh, bones,
                     smooth_weights(mesh.points, bones, 0.075), MATERIALS)


if __name__ == "__main__":
    sys.exit(main(build, FOLDER))
