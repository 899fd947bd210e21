#!/usr/bin/env python3
"""Models the example pup, a young dog with loose ears: writes pup.glb beside this file. See modelling/character.py."""

import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from character import Character, main  # noqa: E402
from implicit import Body, along, beyond, both_of, either_of, mesh_of, paint, refine, within  # noqa: E402
from model_files import Bone, Material  # noqa: E402
from skin_files import planted, smooth_weights  # noqa: E402

CELL_M = 0.02
MATERIALS = [Material("coat", (0.66, 0.33, 0.12), 0.8), Material("cream", (0.93, 0.84, 0.70), 0.8),
             Material("ear", (0.30, 0.13, 0.055), 0.8), Material("nose", (0.035, 0.03, 0.03), 0.25),
             Material("white", (0.95, 0.95, 0.93), 0.3), Material("eye", (0.03, 0.018, 0.012), 0.15)]

# The left legs: hip, knee, ankle, ball of the foot, tip
FORE = ((0.085, 0.335, 0.190), (0.098, 0.195, 0.160), (0.098, 0.062, 0.178), (0.098, 0.030, 0.225))
HIND = ((0.080, 0.335, -0.200), (0.098, 0.205, -0.150), (0.098, 0.082, -0.225), (0.098, 0.030, -0.165))
TAIL = ((0.0, 0.400, -0.270), (0.0, 0.452, -0.345), (0.0, 0.520, -0.400), (0.0, 0.600, -0.430), (0.0, 0.665, -0.425))
EAR = ((0.100, 0.715, 0.330), (0.176, 0.640, 0.322), (0.196, 0.545, 0.335))
HEAD, EYE, NOSE = (0.0, 0.655, 0.355), (0.078, 0.683, 0.460), (0.0, 0.640, 0.566)


def build_body():
    body = Body()
    body.ball((0.0, 0.360, 0.160), (0.125, 0.135, 0.145))                                 # chest
    body.cone((0.0, 0.365, 0.120), (0.0, 0.360, -0.180), 0.118, 0.106, melt=0.08)         # trunk
    body.ball((0.0, 0.355, -0.195), (0.112, 0.115, 0.110), melt=0.06)                     # rump
    body.cone((0.0, 0.420, 0.225), (0.0, 0.590, 0.325), 0.098, 0.088, melt=0.07)          # neck
    body.ball(HEAD, (0.142, 0.128, 0.130), melt=0.06)                                     # skull
    body.cone((0.0, 0.625, 0.455), (0.0, 0.612, 0.525), 0.066, 0.050, melt=0.05)          # muzzle
    body.both(body.ball, (0.040, 0.606, 0.490), (0.045, 0.040, 0.055), melt=0.03)         # flews
    body.ball((0.0, 0.574, 0.470), (0.042, 0.030, 0.055), melt=0.022)                     # jaw
    body.ball(NOSE, (0.030, 0.022, 0.024), melt=0.006)                                   # nose
    body.both(body.ball, EYE, 0.034, melt=0.004)
    body.both(body.ball, (0.072, 0.722, 0.440), (0.040, 0.016, 0.026), melt=0.022, tilt=(0, 0, -16))  # brows
    body.both(body.cone, EAR[0], EAR[1], 0.026, 0.036, melt=0.026)
    body.both(body.cone, EAR[1], EAR[2], 0.036, 0.026, melt=0.016)
    for (hip, knee, ankle, ball), radius_at in ((FORE, 1.0), (HIND, 1.12)):
        body.both(body.cone, hip, knee, 0.074 * radius_at, 0.048 * radius_at, melt=0.06)
        body.both(body.cone, knee, ankle, 0.046 * radius_at, 0.036, melt=0.02)
        body.both(body.cone, ankle, (ball[0], 0.036, ball[2] - 0.02), 0.036, 0.040, melt=0.02)
        body.both(body.ball, (ball[0], 0.034, ball[2]), (0.048, 0.034, 0.056), melt=0.02)
        for x in (-0.027, 0.0, 0.027):
            body.both(body.ball, (ball[0] + x, 0.026, ball[2] + 0.042 - abs(x) * 0.4), (0.018, 0.026, 0.024), melt=0.008)
    body.tube(TAIL, (0.046, 0.042, 0.038, 0.034, 0.026), melt=0.05)
    return body


def paint_rules():
    eye_front = (EYE[0] + 0.010, EYE[1] + 0.001, EYE[2] + 0.030)
    cream = either_of(
        along((0.0, 0.300, 0.250), (0.0, 0.470, 0.330), 0.105, 0.080),        # bib
        along((0.0, 0.215, 0.160), (0.0, 0.220, -0.180), 0.085, 0.075),       # belly
        along((0.0, 0.600, 0.545), (0.0, 0.585, 0.455), 0.085, 0.062),        # muzzle
        along((0.0, 0.660, 0.500), (0.0, 0.800, 0.440), 0.022, 0.034),        # blaze
        beyond((0.0, 0.085, 0.0), (0.0, -1.0, 0.0)),                          # socks
        within(TAIL[4], 0.072, both=False))
    ears = both_of(either_of(along(EAR[0], EAR[1], 0.044, 0.056), along(EAR[1], EAR[2], 0.056, 0.052)),
                   beyond((0.112, 0.7, 0.33), (0.75, -0.30, 0.0)))
    return [("cream", cream), ("ear", ears), ("nose", within((0.0, 0.643, 0.574), 0.031, both=False)),
            ("white", within(EYE, 0.0346)), ("eye", within(eye_front, 0.0255))]


def build_bones():
    side = (1.0, 0.0, 0.0)
    bones = [Bone("hips", None, (0.0, 0.375, -0.130), (0.0, 0.370, -0.260), side),
             Bone("spine", "hips", (0.0, 0.375, -0.130), (0.0, 0.380, 0.050), side),
             Bone("chest", "spine", (0.0, 0.380, 0.050), (0.0, 0.420, 0.220), side),
             Bone("neck", "chest", (0.0, 0.430, 0.230), (0.0, 0.575, 0.320), side),
             Bone("head", "neck", (0.0, 0.575, 0.320), (0.0, 0.640, 0.540), side)]
    bones += [Bone(f"tail{i + 1}", f"tail{i}" if i else "hips", TAIL[i], TAIL[i + 1], side) for i in range(4)]
    for name, parent, joints in (("fore", "chest", FORE), ("hind", "hips", HIND)):
        for letter, s in (("L", 1.0), ("R", -1.0)):
            points = [(s * x, y, z) for x, y, z in joints]
            names = [f"{name}_{part}.{letter}" for part in ("upper", "lower", "paw")]
            bones += [Bone(names[i], names[i - 1] if i else parent, points[i], points[i + 1], side) for i in range(3)]
    for letter, s in (("L", 1.0), ("R", -1.0)):
        points = [(s * x, y, z) for x, y, z in EAR]
        bones += [Bone(f"ear1.{letter}", "head", points[0], points[1], (0.0, 0.0, 1.0)),
                  Bone(f"ear2.{letter}", f"ear1.{letter}", points[1], points[2], (0.0, 0.0, 1.0))]
    return bones


def build():
    body, bones = build_body(), build_bones()
    fine = either_of(within(EYE, 0.041), within(NOSE, 0.034, both=False))
    mesh = paint(refine(mesh_of(body, CELL_M, "pup"), body, fine), body, paint_rules(), "coat")
    mesh.stand().round_points()
    weights = planted(mesh.points, bones, smooth_weights(mesh.points, bones, 0.045), 0.062)
    return Character("pup", "Pup: an example character of sbfmt on four legs", mesh, bones, weights, MATERIALS)


if __name__ == "__main__":
    sys.exit(main(build, FOLDER))
