#!/usr/bin/env python3
"""Models the example koi, a fish on a chain: writes koi.glb beside this file. See modelling/character.py."""

import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from character import Character, main  # noqa: E402
from implicit import Body, along, beyond, both_of, either_of, mesh_of, paint, refine, within  # noqa: E402
from model_files import Bone, Material  # noqa: E402
from skin_files import smooth_weights  # noqa: E402

CELL_M = 0.0135
MATERIALS = [Material("pearl", (0.92, 0.90, 0.86), 0.3), Material("orange", (0.90, 0.24, 0.03), 0.35),
             Material("ink", (0.05, 0.05, 0.06), 0.35), Material("fin", (0.95, 0.66, 0.46), 0.4),
             Material("eye", (0.012, 0.012, 0.014), 0.1)]
DEPTH = 0.45  # height above the ground at which it swims
# from the head back: z, half width, half height
SECTIONS = [(0.270, 0.044, 0.050), (0.180, 0.066, 0.080), (0.090, 0.070, 0.092), (0.000, 0.062, 0.086),
            (-0.090, 0.048, 0.068), (-0.180, 0.034, 0.047), (-0.265, 0.022, 0.032), (-0.350, 0.018, 0.040)]
EYE = (0.050, DEPTH + 0.026, 0.262)


def build_body():
    body = Body()
    for i, (z, width, height) in enumerate(SECTIONS):
        body.ball((0.0, DEPTH, z), (width, height, 0.085), melt=0.06 if i else 0.0)
    body.ball((0.0, DEPTH - 0.006, 0.322), (0.031, 0.026, 0.036), melt=0.03)              # mouth
    body.both(body.ball, EYE, 0.0155, melt=0.004)
    body.both(body.ball, (0.118, DEPTH - 0.052, 0.150), (0.078, 0.014, 0.050), melt=0.014, tilt=(0, 32, -24))
    body.both(body.ball, (0.070, DEPTH - 0.078, -0.070), (0.045, 0.013, 0.032), melt=0.012, tilt=(0, 32, -38))
    body.ball((0.0, DEPTH + 0.098, 0.035), (0.0135, 0.044, 0.095), melt=0.014, tilt=(-10, 0, 0))
    body.ball((0.0, DEPTH - 0.062, -0.190), (0.013, 0.034, 0.042), melt=0.012, tilt=(30, 0, 0))
    body.ball((0.0, DEPTH + 0.066, -0.445), (0.014, 0.040, 0.098), melt=0.016, tilt=(38, 0, 0))
    body.ball((0.0, DEPTH - 0.066, -0.445), (0.014, 0.040, 0.098), melt=0.016, tilt=(-38, 0, 0))
    return body


def paint_rules():
    fins = either_of(beyond((0.077, DEPTH, 0.0), (1.0, -0.10, 0.0)),
                     both_of(beyond((0.0, DEPTH + 0.092, 0.0), (0.0, 1.0, 0.0)), beyond((0.0, 0.0, -0.08), (0.0, 0.0, 1.0))),
                     beyond((0.0, 0.0, -0.395), (0.0, 0.0, -1.0)), along((0.0, DEPTH - 0.085, -0.19), (0.0, DEPTH - 0.100, -0.23), 0.030),
                     along((0.055, DEPTH - 0.090, -0.06), (0.120, DEPTH - 0.110, -0.10), 0.022))
    orange = either_of(within((0.0, DEPTH + 0.075, 0.225), 0.080), within((0.030, DEPTH + 0.085, 0.045), 0.082),
                       within((0.0, DEPTH + 0.055, -0.150), 0.075), within((0.0, DEPTH + 0.020, -0.330), 0.050))
    ink = either_of(within((0.066, DEPTH + 0.030, 0.120), 0.028), within((0.040, DEPTH + 0.050, -0.060), 0.026),
                    within((0.034, DEPTH + 0.010, -0.220), 0.024))
    return [("orange", orange), ("ink", ink), ("fin", fins), ("eye", within(EYE, 0.0165))]


def build_bones():
    side = (1.0, 0.0, 0.0)
    positions = [0.215, 0.125, 0.035, -0.055, -0.145, -0.235, -0.330, -0.430, -0.530]
    bones = [Bone("head", None, (0.0, DEPTH, positions[0]), (0.0, DEPTH, 0.345), side)]
    for i in range(len(positions) - 1):
        bones.append(Bone(f"body{i + 1}", f"body{i}" if i else "head", (0.0, DEPTH, positions[i]), (0.0, DEPTH, positions[i + 1]),
                          side))
    for letter, s in (("L", 1.0), ("R", -1.0)):
        bones.append(Bone(f"fin.{letter}", "body1", (s * 0.062, DEPTH - 0.035, 0.165), (s * 0.180, DEPTH - 0.075, 0.130),
                          (0.0, 0.0, 1.0)))
    return bones


def build():
    body, bones = build_body(), build_bones()
    mesh = paint(refine(mesh_of(body, CELL_M, "koi"), body, within(EYE, 0.022)), body, paint_rules(), "pearl")
    mesh.round_points()
    return Character("koi", "Koi: an example character of sbfmt that swims", mesh, bones,
                     smooth_weights(mesh.points, bones, 0.05), MATERIALS)


if __name__ == "__main__":
    sys.exit(main(build, FOLDER))
