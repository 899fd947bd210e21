#!/usr/bin/env python3
"""Models the example dragon, a flying chain whose legs hang down without bones: writes dragon.glb beside this file. See
modelling/character.py."""

import math
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from character import Character, main  # noqa: E402
from implicit import Body, along, beyond, both_of, either_of, mesh_of, paint, refine, within  # noqa: E402
from model_files import Bone, Material  # noqa: E402
from skin_files import smooth_weights  # noqa: E402

CELL_M = 0.026
MATERIALS = [Material("scales", (0.60, 0.045, 0.035), 0.4), Material("belly", (0.92, 0.66, 0.20), 0.45),
             Material("mane", (0.06, 0.38, 0.36), 0.6), Material("horn", (0.86, 0.78, 0.60), 0.4),
             Material("white", (0.96, 0.96, 0.92), 0.2), Material("eye", (0.02, 0.02, 0.02), 0.1)]
LINKS, STEP, HEIGHT, NECK_Z = 16, 0.15, 1.0, 0.90
EYE = (0.082, HEIGHT + 0.122, 1.075)
HORN = ((0.060, HEIGHT + 0.130, 0.975), (0.105, HEIGHT + 0.235, 0.900), (0.112, HEIGHT + 0.300, 0.830))
LEGS = (2, 10)  # the links they hang from


def radius_at(i):
    t = i / LINKS
    return 0.074 + 0.034 * math.sin(math.pi * min(1.0, 1.1 * t)) - 0.058 * t ** 3


def joint_at(i):
    return (0.0, HEIGHT, NECK_Z - STEP * i)


def leg(link):
    z, x = joint_at(link)[2], 0.8 * radius_at(link)
    return ((x, HEIGHT - 0.04, z), (x + 0.055, HEIGHT - 0.155, z + 0.035), (x + 0.050, HEIGHT - 0.270, z - 0.035),
            (x + 0.052, HEIGHT - 0.315, z + 0.060))


def build_body():
    body = Body()
    for i in range(LINKS):
        body.cone(joint_at(i), joint_at(i + 1), radius_at(i), radius_at(i + 1), melt=0.02)
    body.ball((0.0, HEIGHT + 0.045, 0.985), (0.118, 0.108, 0.130), melt=0.06)             # skull
    body.ball((0.0, HEIGHT + 0.022, 1.130), (0.080, 0.058, 0.115), melt=0.06)             # muzzle
    body.ball((0.0, HEIGHT - 0.040, 1.100), (0.064, 0.036, 0.115), melt=0.025)            # jaw
    body.both(body.ball, (0.040, HEIGHT + 0.070, 1.215), (0.032, 0.030, 0.032), melt=0.025)  # nostrils
    body.both(body.ball, EYE, 0.037, melt=0.006)
    body.both(body.ball, (0.080, HEIGHT + 0.164, 1.055), (0.050, 0.022, 0.036), melt=0.025, tilt=(0, 0, 14))
    body.both(body.cone, HORN[0], HORN[1], 0.034, 0.029, melt=0.02)
    body.both(body.cone, HORN[1], HORN[2], 0.029, 0.022, melt=0.01)
    for y, z, x in ((0.075, 0.870, 0.135), (-0.010, 0.865, 0.140), (-0.080, 0.900, 0.110)):  # whiskers of the cheeks
        body.both(body.cone, (0.075, HEIGHT + 0.5 * y, z + 0.100), (x, HEIGHT + y, z - 0.020), 0.042, 0.021, melt=0.03)
    for i in range(LINKS - 1):                                                           # the comb
        size = 0.42 * radius_at(i) + 0.014
        body.ball((0.0, HEIGHT + radius_at(i) + 0.30 * size, joint_at(i)[2] - 0.075), (0.026, size, 0.052), melt=0.02,
                  tilt=(-24, 0, 0))
    for tilt in (-32, 0, 32):                                                            # the tuft
        body.ball((0.0, HEIGHT + 0.05 * math.sin(math.radians(-tilt)) * 2.0, joint_at(LINKS)[2] - 0.085), (0.026, 0.036, 0.100),
                  melt=0.03, tilt=(tilt, 0, 0))
    for link in LEGS:
        hip, knee, ankle, toe = leg(link)
        body.both(body.cone, hip, knee, 0.062, 0.044, melt=0.04)
        body.both(body.cone, knee, ankle, 0.042, 0.034, melt=0.015)
        body.both(body.ball, (ankle[0], ankle[1] - 0.020, ankle[2] + 0.030), (0.050, 0.032, 0.060), melt=0.02)
        for x in (-0.036, 0.0, 0.036):
            body.both(body.cone, (toe[0] + 0.8 * x, ankle[1] - 0.028, toe[2] - 0.020), (toe[0] + x, toe[1], toe[2] + 0.010), 0.024,
                      0.018, melt=0.012)
    return body


def paint_rules():
    belly = either_of(along((0.0, HEIGHT - 0.135, 1.22), (0.0, HEIGHT - 0.150, -0.80), 0.095, 0.090),
                      along((0.0, HEIGHT - 0.150, -0.80), (0.0, HEIGHT - 0.060, -1.50), 0.090, 0.040))
    comb = either_of(*(within((0.0, HEIGHT + 2.0 * radius_at(i), joint_at(i)[2] - 0.075), 0.94 * radius_at(i), both=False)
                       for i in range(LINKS - 1)))
    whiskers = either_of(*(along((0.115, HEIGHT + 0.7 * y, z + 0.030), (x, HEIGHT + y, z - 0.020), 0.052)
                           for y, z, x in ((0.075, 0.870, 0.135), (-0.010, 0.865, 0.140), (-0.080, 0.900, 0.110))))
    tuft = beyond((0.0, 0.0, joint_at(LINKS)[2] - 0.030), (0.0, 0.0, -1.0))
    toes = either_of(*(both_of(within((leg(k)[3][0], leg(k)[3][1], leg(k)[3][2] + 0.02), 0.068),
                               beyond((0.0, 0.0, leg(k)[3][2] - 0.012), (0.0, 0.0, 1.0))) for k in LEGS))
    horns = either_of(along(HORN[0], HORN[1], 0.043), along(HORN[1], HORN[2], 0.042), toes)
    nostrils = within((0.046, HEIGHT + 0.086, 1.240), 0.014)
    pupil = both_of(within(EYE, 0.0385), along((0.100, HEIGHT + 0.092, 1.112), (0.100, HEIGHT + 0.158, 1.112), 0.017))
    return [("belly", belly), ("mane", either_of(comb, whiskers, tuft)), ("horn", horns), ("white", within(EYE, 0.0382)),
            ("eye", either_of(pupil, nostrils))]


def build_bones():
    side = (1.0, 0.0, 0.0)
    bones = [Bone("head", None, joint_at(0), (0.0, HEIGHT + 0.02, 1.24), side)]
    for i in range(LINKS):
        bones.append(Bone(f"body{i + 1}", f"body{i}" if i else "head", joint_at(i), joint_at(i + 1), side))
    bones.append(Bone(f"body{LINKS + 1}", f"body{LINKS}", joint_at(LINKS), (0.0, HEIGHT, joint_at(LINKS)[2] - 0.17), side))
    return bones


def build():
    body, bones = build_body(), build_bones()
    fine = either_of(within(EYE, 0.052), within((0.040, HEIGHT + 0.075, 1.225), 0.030))
    mesh = paint(refine(mesh_of(body, CELL_M, "dragon"), body, fine), body, paint_rules(), "scales")
    mesh.round_points()
    return Character("dragon", "Dragon: an example character of sbfmt that flies", mesh, bones,
                     smooth_weights(mesh.points, bones, 0.06), MATERIALS)


if __name__ == "__main__":
    sys.exit(main(build, FOLDER))
