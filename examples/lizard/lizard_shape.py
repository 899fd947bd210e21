"""The lizard's measures: colours, the line of its back, its joints and its thickness. Change these to change the animal.

Metres, +Y up, +Z towards the head; the legs given are the left ones (+X).
"""

import math

import modelling_path  # noqa: F401
from loft import Collar, Keys, Tube, hermite
from model_files import Material
from quad_mesh import add, cross, length, scale, sub, unit

MATERIALS = [
    Material("back", (0.020, 0.250, 0.225), 0.55),
    Material("stripe", (0.006, 0.105, 0.130), 0.55),
    Material("flank", (0.130, 0.480, 0.330), 0.55),
    Material("belly", (0.830, 0.690, 0.430), 0.65),
    Material("toe", (0.860, 0.600, 0.330), 0.60),
    Material("mouth", (0.055, 0.060, 0.055), 0.70),
    Material("iris", (0.900, 0.420, 0.030), 0.20),
    Material("pupil", (0.006, 0.006, 0.008), 0.10),
    Material("glint", (1.000, 1.000, 1.000), 0.30),
]

# The axis of the body from the tail's tip to the snout: z, y, half width, height above and below the axis.
SPINE = [
    (-0.715, 0.112, 0.0105, 0.0105, 0.0105),
    (-0.660, 0.096, 0.0142, 0.0142, 0.0142),
    (-0.600, 0.088, 0.0186, 0.0186, 0.0180),   # tail5
    (-0.505, 0.092, 0.0265, 0.0260, 0.0250),   # tail4
    (-0.405, 0.114, 0.0355, 0.0345, 0.0335),   # tail3
    (-0.305, 0.147, 0.0455, 0.0430, 0.0430),   # tail2
    (-0.205, 0.176, 0.0580, 0.0510, 0.0540),   # tail1, pelvis
    (-0.135, 0.188, 0.0730, 0.0580, 0.0650),   # hips
    (-0.070, 0.193, 0.0850, 0.0630, 0.0760),   # spine
    (0.000, 0.194, 0.0910, 0.0650, 0.0820),    # belly
    (0.055, 0.195, 0.0880, 0.0650, 0.0790),    # chest
    (0.120, 0.200, 0.0780, 0.0610, 0.0690),    # shoulders
    (0.170, 0.209, 0.0650, 0.0540, 0.0580),    # neck
    (0.205, 0.219, 0.0610, 0.0520, 0.0540),
    (0.240, 0.229, 0.0660, 0.0560, 0.0550),    # head
    (0.280, 0.236, 0.0840, 0.0640, 0.0570),
    (0.320, 0.238, 0.0935, 0.0660, 0.0560),    # cheeks
    (0.360, 0.236, 0.0870, 0.0600, 0.0520),
    (0.400, 0.230, 0.0730, 0.0480, 0.0450),
    (0.435, 0.224, 0.0580, 0.0370, 0.0370),    # snout
]


def spine_curves():
    """The body's axis and profile keyed by metres along it, and the metres at each z of SPINE."""
    metres, at = 0.0, {}
    axis, profile = [], []
    for i, (z, y, width, up, down) in enumerate(SPINE):
        if i:
            metres += math.hypot(z - SPINE[i - 1][0], y - SPINE[i - 1][1])
        at[z] = metres
        axis.append((metres, 0.0, y, z))
        profile.append((metres, width, up, down))
    return Keys(axis), Keys(profile), at


AXIS, PROFILE, METRES_AT = spine_curves()
BODY = Tube(AXIS, PROFILE, (1.0, 0.0, 0.0), 2.15)


def on_spine(z):
    """The point of the axis at a z of SPINE."""
    return (0.0, *next(row[1::-1] for row in SPINE if row[0] == z))


def across_middle(point):
    return (-point[0], point[1], point[2])


def distance_to_trunk(point):
    return BODY.distance(point, METRES_AT[-0.305], METRES_AT[0.240])


class Leg:
    """One left leg.

    names: its three sections, upper, lower, foot; joints: hip, knee, ankle; toes: where the foot's bone ends;
    radii: (part of the way from hip to ankle, radius)."""

    def __init__(self, names, parent, joints, toes, foot_size, radii):
        self.names, self.parent, self.joints, self.toes, self.foot_size = names, parent, joints, toes, foot_size
        hip, knee, ankle = joints
        # bending the knee further turns the lower leg the positive way about the hinge
        self.hinge = unit(cross(sub(ankle, knee), sub(hip, knee)))
        upper, lower = length(sub(knee, hip)), length(sub(ankle, knee))
        self.knee_at, self.ankle_at = upper, upper + lower
        # the skin's axis passes the knee in a wide arc, up to about a centimetre from the bones
        down, on = unit(sub(knee, hip)), unit(sub(ankle, knee))
        through = unit(add(down, on))
        keys = []
        for start, end, first, last, base, span in ((hip, knee, down, through, 0.0, upper),
                                                    (knee, ankle, through, on, upper, lower)):
            keys += [(base + span * t, *hermite(start, scale(first, span), end, scale(last, span), t))
                     for t in (0.0, 0.25, 0.5, 0.75)]
        profile = Keys([(part * self.ankle_at, radius, radius, radius) for part, radius in radii])
        self.tube = Tube(Keys([*keys, (self.ankle_at, *ankle)]), profile, self.hinge)
        self.skin = Collar(self.tube, distance_to_trunk, flare=0.012, reach=0.045, sink=0.005)


FRONT = Leg(("UpperArm", "LowerArm", "Hand"), "chest",
            ((0.050, 0.186, 0.122), (0.150, 0.148, 0.068), (0.164, 0.044, 0.136)), (0.176, 0.012, 0.205), 1.0,
            [(0.0, 0.0340), (0.25, 0.0315), (0.47, 0.0260), (0.70, 0.0245), (1.0, 0.0165)])
HIND = Leg(("UpperLeg", "LowerLeg", "Foot"), "pelvis",
           ((0.046, 0.180, -0.135), (0.152, 0.154, -0.080), (0.168, 0.044, -0.166)), (0.188, 0.012, -0.090), 1.08,
           [(0.0, 0.0400), (0.25, 0.0380), (0.45, 0.0300), (0.68, 0.0270), (1.0, 0.0178)])
LEGS = (FRONT, HIND)
