#!/usr/bin/env python3
"""Models the example pudding, which hops: writes pudding.glb beside this file. See modelling/character.py."""

import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from character import Character, main  # noqa: E402
from implicit import Body, beyond, both_of, mesh_of, paint, refine, within  # noqa: E402
from model_files import Bone, Material  # noqa: E402
from skin_files import smooth_weights  # noqa: E402

CELL_M = 0.021
MATERIALS = [Material("custard", (0.86, 0.55, 0.12), 0.35), Material("caramel", (0.28, 0.09, 0.03), 0.2),
             Material("eye", (0.01, 0.01, 0.012), 0.1), Material("cherry", (0.62, 0.02, 0.05), 0.15)]
EYE = (0.052, 0.135, 0.128)
CHERRY = (0.0, 0.292, 0.0)


def build_body():
    body = Body()
    body.cone((0.0, 0.150, 0.0), (0.0, 0.190, 0.0), 0.150, 0.100, melt=0.02)
    body.ball((0.0, 0.050, 0.0), (0.180, 0.050, 0.180), melt=0.03)                        # its foot
    body.both(body.ball, EYE, 0.020, melt=0.004)
    body.ball(CHERRY, 0.030, melt=0.006)
    return body


def paint_rules():
    return [("caramel", beyond((0.0, 0.215, 0.0), (0.0, 1.0, 0.0))), ("cherry", within(CHERRY, 0.037)),
            ("eye", both_of(within(EYE, 0.030), beyond((0.0, 0.0, 0.131), (0.0, 0.0, 1.0))))]


def build_bones():
    side = (1.0, 0.0, 0.0)
    return [Bone("body", None, (0.0, 0.0, 0.0), (0.0, 0.24, 0.0), side),
            Bone("cherry", "body", (0.0, 0.262, 0.0), (0.0, 0.322, 0.0), side)]


def build():
    body = build_body()
    mesh = paint(refine(mesh_of(body, CELL_M, "pudding"), body, within(EYE, 0.035)), body, paint_rules(), "custard")
    mesh.stand().round_points()
    bones = build_bones()
    return Character("pudding", "Pudding: an example character of sbfmt that hops", mesh, bones,
                     smooth_weights(mesh.points, bones, 0.02), MATERIALS)


if __name__ == "__main__":
    sys.exit(main(build, FOLDER))
