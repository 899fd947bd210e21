"""Bundles of joints: in each case a joint connects an arm to a common base, or to the arm before it.

Frames are turned by odd angles, so that an axis, a sign or an order that is wrong shows. Every free motion is driven, and all
that are limited keep within their bounds at rest."""

import math
import xml.etree.ElementTree as ElementTree

TURN_A = (0.1, 0.5, -0.3, math.sqrt(1 - 0.35))
TURN_B = (-0.4, 0.2, 0.4, math.sqrt(1 - 0.36))
GAP = 0.5  # between arms at rest


def product(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def about(axis, angle):
    """A rotation about axis 0, 1 or 2."""
    q = [0, 0, 0, math.cos(angle / 2)]
    q[axis] = math.sin(angle / 2)
    return tuple(q)


def rotated(q, v):
    x, y, z, _ = product(product(q, (*v, 0)), (-q[0], -q[1], -q[2], q[3]))
    return x, y, z


class Case:
    """One joint. `motions` maps each free coordinate to (drive position, (min, max) or None). `offset` is where coordinates
    are at rest. `turned` swaps the bodies: the arm is body a. `on` is the arm that carries this one."""

    def __init__(self, name, kind, motions, turned=False, on="base", axes=TURN_A, offset=None):
        self.name, self.kind, self.motions, self.turned, self.on, self.axes = name, kind, motions, turned, on, axes
        self.offset = offset or {}

    def target(self, coordinate, which):
        """Target of the drive: its position, or the bound that limits it."""
        position, bounds = self.motions[coordinate]
        if which == "drive" or not bounds:
            return position
        return bounds[0] - 0.4 if which == "min" else bounds[1] + 0.4


CASES = (
    Case("hinge", "revolute", {"twist": (0.7, (-0.5, 1.2))}),
    Case("hinge_turned", "revolute", {"twist": (0.6, (-0.4, 0.9))}, turned=True, axes=TURN_B),
    Case("hinge_bent", "revolute", {"twist": (0.5, (0.2, 0.8))}, offset={"twist": 0.4}),
    Case("slide", "prismatic", {"linear_x": (0.15, (-0.1, 0.2))}, axes=TURN_B),
    Case("slide_turned", "prismatic", {"linear_x": (-0.08, (-0.12, 0.05))}, turned=True),
    Case("slide_out", "prismatic", {"linear_x": (0.06, (0.02, 0.12))}, offset={"linear_x": 0.05}),
    Case("tube", "cylindrical", {"linear_x": (0.1, (-0.05, 0.15)), "twist": (-0.6, (-0.9, 0.3))}, axes=TURN_B),
    Case("tube_turned", "cylindrical", {"linear_x": (0.07, (-0.02, 0.1)), "twist": (0.5, (-0.2, 0.8))}, turned=True),
    Case("ball_y", "spherical", {"twist": (0.5, (-0.3, 0.8)), "swing_y": (0.4, (-0.5, 0.6)), "swing_z": (0, None)}),
    Case("ball_z", "spherical", {"twist": (-0.4, (-0.7, 0.5)), "swing_y": (0, None), "swing_z": (0.3, (-0.2, 0.5))}, axes=TURN_B),
    Case("ball_bent", "spherical", {"twist": (0.5, (-0.3, 0.8)), "swing_y": (0.5, (0.1, 0.7)), "swing_z": (0, None)},
         offset={"swing_y": 0.3, "twist": 0.4}),
    Case("ball_turned", "spherical", {"twist": (0.3, (-0.6, 0.5)), "swing_y": (0, None), "swing_z": (-0.35, (-0.5, 0.3))}, turned=True),
    Case("line", "point_on_line", {"linear_x": (0.1, (-0.1, 0.15)), "twist": (0.3, None), "swing_y": (0.2, None), "swing_z": (0, None)}),
    Case("plane", "point_in_plane", {"linear_y": (0.1, (-0.1, 0.12)), "linear_z": (-0.05, None), "twist": (0.2, None),
                                     "swing_y": (0, None), "swing_z": (0.3, None)}, axes=TURN_B),
    Case("six", "six_dof", {"linear_x": (0.05, None), "linear_y": (-0.06, None), "linear_z": (0.07, (-0.03, 0.09)),
                            "twist": (0.4, None), "swing_y": (0.3, None), "swing_z": (0, None)}),
    Case("upper", "revolute", {"twist": (0.8, (-0.2, 1.0))}, axes=TURN_B),
    Case("lower", "revolute", {"twist": (-0.5, (-0.7, 0.2))}, on="upper"),
)
STIFFNESS, DAMPING = 400.0, 40.0


def words(values):
    return " ".join(f"{value:.9g}" for value in values)


def add(parent, tag, **attributes):
    return ElementTree.SubElement(parent, tag, {key: value if isinstance(value, str) else f"{value:.9g}"
                                                for key, value in attributes.items()})


def add_joint(root, case, number, centers, which):
    """Both frames have the same position and rotation at rest, except for the case's offset."""
    anchor = [c - d for c, d in zip(centers[case.name], (0.2, 0.03, -0.05))]
    bodies = (case.on, case.name)[::-1] if case.turned else (case.on, case.name)
    joint = add(root, f"{case.kind}_joint", id=f"{case.name}_joint", body_a=bodies[0], body_b=bodies[1])
    shift = rotated(case.axes, (case.offset.get("linear_x", 0), 0, 0))
    for frame, body, at, turn in (("frame_a", bodies[0], anchor, case.axes),
                                  ("frame_b", bodies[1], [a + b for a, b in zip(anchor, shift)],
                                   product(product(case.axes, about(1, case.offset.get("swing_y", 0))),
                                           about(0, case.offset.get("twist", 0))))):
        add(joint, frame, position=words(a - c for a, c in zip(at, centers[body])), rotation=words(turn))
    limits = add(joint, "limits")
    for coordinate, (_, bounds) in case.motions.items():
        if bounds:
            add(limits, "limit", target=coordinate, min=bounds[0], max=bounds[1])
    for k, coordinate in enumerate(case.motions):
        add(joint, "drive", target=coordinate, position=case.target(coordinate, which), stiffness=STIFFNESS + number + 0.25 * k,
            damping=DAMPING + 0.125 * number)


def document(which="drive"):
    """The bundle's text. `which` says where drives lead: `drive`, `min` or `max`, as Case.target has it."""
    root = ElementTree.Element("sbf", version="1.0")
    add(root, "asset", title="joints")
    add(root, "environment", gravity="0 0 0")
    centers = {"base": (0.0, 0.0, 0.0)}
    for number, case in enumerate(CASES):
        at = centers[case.on] if case.on != "base" else (GAP * number, 0.3, -0.2)
        centers[case.name] = tuple(a + b for a, b in zip(at, (0.35, 0.1, 0.05)))
    bones, bodies, joints = (add(root, tag) for tag in ("skeleton", "rigid_bodies", "joints"))
    for number, (name, center) in enumerate(centers.items()):
        add(bones, "bone", id=f"{name}_bone", name=name, head=words(center), length=0.1)
        moved = {"mass": 1 + 0.1 * number, "inertia": words((0.01, 0.012 + 0.0005 * number, 0.014)), "inertia_rotation": words(TURN_B)}
        add(bodies, "rigid_body", id=name, bone=f"{name}_bone", motion="kinematic" if name == "base" else "dynamic",
            center=words(center), **moved)
    for number, case in enumerate(CASES):
        add_joint(joints, case, number, centers, which)
    return ElementTree.tostring(root, encoding="unicode")
