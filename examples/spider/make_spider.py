#!/usr/bin/env python3
"""Models the example jumping spider, eight legs and as many eyes: writes spider.glb beside this file. See
modelling/character.py."""

import math
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from character import Character, main  # noqa: E402
from implicit import Body, along, beyond, both_of, either_of, mesh_of, paint, refine, within  # noqa: E402
from model_files import Bone, Material  # noqa: E402
from quad_mesh import lerp  # noqa: E402
from skin_files import planted, smooth_weights  # noqa: E402

CELL_M = 0.019
MATERIALS = [Material("dark", (0.075, 0.070, 0.090), 0.8), Material("band", (0.80, 0.32, 0.10), 0.7),
             Material("pale", (0.88, 0.80, 0.66), 0.8), Material("fang", (0.10, 0.42, 0.40), 0.3),
             Material("eye", (0.015, 0.020, 0.025), 0.08), Material("glint", (1.0, 1.0, 1.0), 0.2)]
# each left leg: its direction as an angle, 0 ahead; distance of its foot; its root on the body
LEGS = ((32.0, 0.435, 0.115), (70.0, 0.400, 0.045), (108.0, 0.400, -0.030), (146.0, 0.455, -0.095))
EYES = (((0.052, 0.262, 0.196), 0.043), ((0.112, 0.280, 0.148), 0.027), ((0.106, 0.296, 0.062), 0.018),
        ((0.098, 0.284, -0.022), 0.016))


def leg(i):
    """Hip, knee, ankle and tip of a left leg."""
    angle, out, z = LEGS[i]
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))

    def at(distance, height):
        return (0.055 + sine * distance, height, z + cosine * distance)
    return at(0.030, 0.195), at(0.52 * out, 0.345), at(0.93 * out, 0.080), at(out, 0.012)


def build_body():
    body = Body()
    body.ball((0.0, 0.235, 0.050), (0.128, 0.092, 0.150), melt=0.03)                     # head and breast
    body.ball((0.0, 0.262, 0.110), (0.118, 0.072, 0.090), melt=0.05)
    body.ball((0.0, 0.262, -0.235), (0.140, 0.128, 0.175), melt=0.022, tilt=(12, 0, 0))   # abdomen
    body.both(body.ball, (0.040, 0.185, 0.190), (0.030, 0.044, 0.030), melt=0.016)        # jaws
    body.both(body.tube, [(0.078, 0.190, 0.170), (0.098, 0.165, 0.245), (0.082, 0.128, 0.285)], (0.026, 0.022, 0.026),
              melt=0.016)                                                                # feelers
    for centre, size in EYES:
        body.both(body.ball, centre, size, melt=0.004)
    for i in range(4):
        hip, knee, ankle, tip = leg(i)
        body.both(body.cone, hip, knee, 0.036, 0.031, melt=0.016)
        body.both(body.cone, knee, ankle, 0.030, 0.024, melt=0.008)
        body.both(body.cone, ankle, (tip[0], 0.022, tip[2]), 0.023, 0.022, melt=0.008)
    return body


def paint_rules():
    bands, tips = [], []
    for i in range(4):
        hip, knee, ankle, tip = leg(i)
        bands += [along(lerp(hip, knee, 0.78), lerp(hip, knee, 0.94), 0.046),
                  along(lerp(knee, ankle, 0.34), lerp(knee, ankle, 0.50), 0.042),
                  along(lerp(knee, ankle, 0.80), lerp(knee, ankle, 0.92), 0.036)]
        tips.append(within(tip, 0.034))
    back = within((0.0, 0.330, -0.235), 0.135, both=False)
    marks = either_of(within((0.058, 0.385, -0.190), 0.030), within((0.062, 0.365, -0.275), 0.026),
                      along((0.0, 0.40, -0.150), (0.0, 0.38, -0.330), 0.022, 0.012))
    brow = both_of(along((0.0, 0.315, 0.190), (0.085, 0.330, 0.150), 0.030), beyond((0.0, 0.302, 0.0), (0.0, 1.0, 0.0)))
    jaws = along((0.040, 0.190, 0.215), (0.040, 0.145, 0.200), 0.036)
    eyes = [within(centre, size + 0.0012) for centre, size in EYES]
    glints = [within((c[0] - 0.30 * r, c[1] + 0.50 * r, c[2] + 0.80 * r), 0.26 * r) for c, r in EYES[:2]]
    return [("band", either_of(*bands, back)), ("pale", either_of(brow, marks, along((0.080, 0.150, 0.265),
                                                                                  (0.082, 0.120, 0.285), 0.034))),
            ("fang", jaws), ("eye", either_of(*eyes, *tips)), ("glint", either_of(*glints))]


def build_bones():
    side = (1.0, 0.0, 0.0)
    bones = [Bone("thorax", None, (0.0, 0.225, -0.080), (0.0, 0.235, 0.080), side),
             Bone("head", "thorax", (0.0, 0.240, 0.080), (0.0, 0.250, 0.220), side),
             Bone("abdomen", "thorax", (0.0, 0.235, -0.090), (0.0, 0.265, -0.390), side)]
    for i in range(4):
        for letter, s in (("L", 1.0), ("R", -1.0)):
            points = [(s * x, y, z) for x, y, z in leg(i)]
            names = [f"leg{i + 1}_{part}.{letter}" for part in ("upper", "lower", "tip")]
            bones += [Bone(names[k], names[k - 1] if k else "thorax", points[k], points[k + 1], (0.0, 1.0, 0.0))
                      for k in range(3)]
    for letter, s in (("L", 1.0), ("R", -1.0)):
        points = [(s * 0.078, 0.190, 0.170), (s * 0.098, 0.165, 0.245), (s * 0.082, 0.128, 0.285)]
        bones += [Bone(f"feeler{k + 1}.{letter}", f"feeler{k}.{letter}" if k else "head", points[k], points[k + 1], side)
                  for k in range(2)]
    return bones


def build():
    body, bones = build_body(), build_bones()
    fine = either_of(*(within(centre, size + 0.010) for centre, size in EYES))
    mesh = paint(refine(mesh_of(body, CELL_M, "spider"), body, fine), body, paint_rules(), "dark")
    mesh.stand().round_points()
    weights = planted(mesh.points, bones, smooth_weights(mesh.points, bones, 0.028), 0.030)
    return Character("spider", "Jumping spider: an example character of sbfmt on eight legs", mesh, bones, weights, MATERIALS)


if __name__ == "__main__":
    sys.exit(main(build, FOLDER))
