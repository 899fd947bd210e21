#!/usr/bin/env python3
"""Models the example yeti, a stout biped: writes yeti.glb beside this file. See modelling/character.py."""

import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from character import Character, main  # noqa: E402
from implicit import Body, along, beyond, both_of, either_of, mesh_of, paint, refine, smile_about, within  # noqa: E402
from model_files import Bone, Material  # noqa: E402
from skin_files import planted, smooth_weights  # noqa: E402

CELL_M = 0.034
MATERIALS = [Material("fur", (0.62, 0.74, 0.86), 0.9), Material("skin", (0.16, 0.30, 0.50), 0.6),
             Material("belly", (0.90, 0.93, 0.96), 0.9), Material("horn", (0.84, 0.70, 0.46), 0.5),
             Material("white", (0.96, 0.96, 0.94), 0.3), Material("eye", (0.02, 0.02, 0.03), 0.15)]
LEG = ((0.145, 0.550, 0.000), (0.155, 0.330, 0.070), (0.155, 0.105, -0.015), (0.155, 0.050, 0.110))
ARM = ((0.235, 0.960, 0.000), (0.415, 0.790, -0.020), (0.570, 0.620, 0.040), (0.630, 0.540, 0.070))
EYE = (0.092, 1.262, 0.215)
HORN = ((0.160, 1.380, 0.020), (0.235, 1.460, 0.015), (0.252, 1.550, 0.045))


def build_body():
    body = Body()
    body.ball((0.0, 0.700, 0.015), (0.255, 0.250, 0.225), melt=0.08)                     # belly
    body.ball((0.0, 0.930, 0.000), (0.230, 0.190, 0.180), melt=0.10)                     # chest
    body.both(body.ball, (0.115, 0.575, -0.010), (0.140, 0.130, 0.150), melt=0.08)        # haunches
    body.ball((0.0, 1.245, 0.030), (0.245, 0.220, 0.205), melt=0.08)                     # head
    body.cone((0.0, 1.020, 0.000), (0.0, 1.160, 0.020), 0.170, 0.150, melt=0.08)          # neck
    body.ball((0.0, 1.135, 0.150), (0.140, 0.080, 0.085), melt=0.06)                     # jaw
    body.ball((0.0, 1.195, 0.250), (0.042, 0.029, 0.026), melt=0.02)                     # nose
    body.both(body.ball, EYE, 0.056, melt=0.006)
    body.ball((0.0, 1.345, 0.180), (0.165, 0.036, 0.050), melt=0.05)                     # brow
    body.both(body.cone, HORN[0], HORN[1], 0.050, 0.040, melt=0.02)
    body.both(body.cone, HORN[1], HORN[2], 0.040, 0.017, melt=0.01)
    body.both(body.cone, ARM[0], ARM[1], 0.108, 0.092, melt=0.08)
    body.both(body.cone, ARM[1], ARM[2], 0.092, 0.098, melt=0.04)
    body.both(body.ball, (0.612, 0.566, 0.062), (0.078, 0.090, 0.075), melt=0.03, tilt=(0, 0, 40))
    body.both(body.cone, (0.575, 0.590, 0.105), (0.560, 0.560, 0.165), 0.034, 0.030, melt=0.02)  # thumb
    body.both(body.cone, LEG[0], LEG[1], 0.140, 0.105, melt=0.08)
    body.both(body.cone, LEG[1], LEG[2], 0.105, 0.102, melt=0.04)
    body.both(body.ball, (0.158, 0.066, 0.070), (0.112, 0.066, 0.160), melt=0.05)
    for x in (-0.068, 0.0, 0.068):
        body.both(body.ball, (0.158 + x, 0.048, 0.212 - 2.2 * x * x), (0.042, 0.046, 0.050), melt=0.014)
    return body


def paint_rules():
    face = either_of(within((0.070, 1.255, 0.220), 0.118), along((0.0, 1.240, 0.230), (0.0, 1.125, 0.235), 0.120, 0.095))
    toes = both_of(beyond((0.0, 0.0, 0.165), (0.0, 0.0, 1.0)), beyond((0.0, 0.200, 0.0), (0.0, -1.0, 0.0)))
    hands = beyond((0.590, 0.600, 0.060), (0.65, -0.75, 0.25))
    hands = both_of(hands, beyond((0.0, 0.720, 0.0), (0.0, -1.0, 0.0)), beyond((0.36, 0.0, 0.0), (1.0, 0.0, 0.0)))
    thumbs = along((0.572, 0.584, 0.120), (0.560, 0.560, 0.175), 0.055)
    mouth = smile_about((0.0, 1.172, 0.262), 0.080, 0.066, 1.136)
    return [("belly", along((0.0, 0.600, 0.210), (0.0, 0.930, 0.190), 0.175, 0.130)),
            ("skin", either_of(face, toes, hands, thumbs)),
            ("horn", either_of(along(HORN[0], HORN[1], 0.062, 0.055), along(HORN[1], HORN[2], 0.06))),
            ("eye", either_of(within((0.0, 1.200, 0.266), 0.040, both=False), mouth)),
            ("white", within(EYE, 0.0572)), ("eye", within((EYE[0] - 0.010, EYE[1], EYE[2] + 0.052), 0.030))]


def build_bones():
    side = (1.0, 0.0, 0.0)
    bones = [Bone("hips", None, (0.0, 0.600, 0.0), (0.0, 0.720, 0.0), side),
             Bone("spine", "hips", (0.0, 0.720, 0.0), (0.0, 0.860, 0.0), side),
             Bone("chest", "spine", (0.0, 0.860, 0.0), (0.0, 1.040, 0.0), side),
             Bone("neck", "chest", (0.0, 1.040, 0.0), (0.0, 1.130, 0.02), side),
             Bone("head", "neck", (0.0, 1.130, 0.02), (0.0, 1.420, 0.02), side)]
    for letter, s in (("L", 1.0), ("R", -1.0)):
        for parent, names, joints in (("chest", ("upper_arm", "forearm", "hand"), ARM),
                                      ("hips", ("thigh", "shin", "foot"), LEG)):
            points = [(s * x, y, z) for x, y, z in joints]
            names = [f"{name}.{letter}" for name in names]
            bones += [Bone(names[k], names[k - 1] if k else parent, points[k], points[k + 1], side) for k in range(3)]
    return bones


def build():
    body, bones = build_body(), build_bones()
    fine = either_of(within(EYE, 0.070), smile_about((0.0, 1.172, 0.262), 0.090, 0.056, 1.145),
                     within((0.0, 1.195, 0.250), 0.046))
    mesh = paint(refine(mesh_of(body, CELL_M, "yeti"), body, fine), body, paint_rules(), "fur")
    mesh.stand().round_points()
    weights = planted(mesh.points, bones, smooth_weights(mesh.points, bones, 0.075), 0.085)
    return Character("yeti", "Yeti: an example character of sbfmt on two legs", mesh, bones, weights, MATERIALS)


if __name__ == "__main__":
    sys.exit(main(build, FOLDER))
