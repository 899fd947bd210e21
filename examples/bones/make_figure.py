#!/usr/bin/env python3
"""Writes figure.sbf and flesh.sbf. In figure.sbf a soft figure on a rigid skeleton hangs by its hands from two blocks;
flesh.sbf is the same figure without the skeleton. See README.md.

    python3 make_figure.py            writes both beside this script
    python3 make_figure.py --check    exits 1 if a file there is stale
    -o FOLDER                         another folder
"""

import argparse
import math
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from implicit import Body, mesh_of  # noqa: E402

CELL_M = 0.0548  # gives about as many polygons as the paper's armadillo has

# name: parent, head, tail, half width of its hull, mass in kg, maximum swing and twist about its head in degrees,
# damping of both in N m s
PELVIS, NECK = (0.0, 0.95, 0.0), (0.0, 1.40, 0.0)
LEFT = {
    "upper_arm": ("chest", (0.17, 1.33, 0.0), (0.42, 1.36, 0.0), 0.045, 1.2, 60, 30, 12),
    "forearm": ("upper_arm", (0.42, 1.36, 0.0), (0.66, 1.40, 0.0), 0.042, 0.8, 45, 30, 12),
    "hand": ("forearm", (0.66, 1.40, 0.0), (0.80, 1.42, 0.0), 0.048, 0.4, 45, 20, 12),
    "thigh": ("pelvis", (0.095, 0.88, 0.0), (0.115, 0.50, 0.01), 0.060, 4.0, 45, 20, 3),
    "shin": ("thigh", (0.115, 0.50, 0.01), (0.125, 0.12, -0.01), 0.048, 2.0, 40, 10, 1),
    "foot": ("shin", (0.125, 0.12, -0.01), (0.135, 0.06, 0.15), 0.042, 0.6, 25, 10, 0.1),
}
MIDDLE = {
    "pelvis": (None, (0.0, 0.86, 0.0), (0.0, 1.02, 0.0), 0.075, 6.0, 0, 0, 0),
    "chest": ("pelvis", (0.0, 1.04, 0.0), (0.0, 1.34, 0.0), 0.085, 9.0, 30, 20, 4),
    "head": ("chest", NECK, (0.0, 1.62, 0.01), 0.055, 3.5, 35, 40, 0.5),
}


def mirrored(position):
    return (0.0 - position[0] if position[0] else 0.0, position[1], position[2])


def bones():
    """All bones of both sides, parents first."""
    found = dict(MIDDLE)
    for name, (parent, head, tail, *rest) in LEFT.items():
        for side in ("left", "right"):
            turn = mirrored if side == "right" else tuple
            above = parent if parent in MIDDLE else f"{side}_{parent}"
            found[f"{side}_{name}"] = (above, turn(head), turn(tail), *rest)
    return found


def build_body():
    body = Body()
    body.ball((0.0, 1.20, 0.0), (0.155, 0.185, 0.115))
    body.ball((0.0, 0.95, 0.0), (0.145, 0.145, 0.120), melt=0.07)
    body.cone((0.0, 1.34, 0.0), (0.0, 1.46, 0.0), 0.062, 0.062, melt=0.05)
    body.ball((0.0, 1.57, 0.015), (0.105, 0.130, 0.115), melt=0.03)
    for name, start, end in (("upper_arm", 0.078, 0.062), ("forearm", 0.062, 0.055), ("hand", 0.062, 0.060),
                             ("thigh", 0.105, 0.078), ("shin", 0.080, 0.060), ("foot", 0.062, 0.055)):
        _, head, tail, *_ = LEFT[name]
        body.both(body.cone, head, tail, start, end, melt=0.05)
    return body


# ---- Text ----

def words(numbers):
    return " ".join(f"{round(n, 5) + 0.0:g}" for n in numbers)


def mesh_text(points, faces):
    return (f"<positions>{words(x for p in points for x in p)}</positions>\n"
            f"<polygon_sizes>{' '.join(str(len(f)) for f in faces)}</polygon_sizes>\n"
            f"<polygon_points>{' '.join(str(c) for f in faces for c in f)}</polygon_points>\n")


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def turn_to(direction):
    """The rotation from +X, the twist axis of a joint, to a direction."""
    x, y, z = direction
    if x < -0.999999:
        return (0.0, 1.0, 0.0, 0.0)
    size = math.sqrt(2 * (1 + x))
    return (0.0, -z / size, y / size, size / 2)


def hull_text(head, tail, half):
    """A box along the bone, a little short of its joints."""
    along = unit([b - a for a, b in zip(head, tail)])
    across = unit(cross(along, (0.0, 0.0, 1.0)))
    over = cross(along, across)
    corners = []
    for i in range(8):
        t, u, v = (0.9 if i & 4 else 0.1), (half if i & 1 else -half), (half if i & 2 else -half)
        corners.append([a + (b - a) * t + p * u + q * v for a, b, p, q in zip(head, tail, across, over)])
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return f'<polygon_mesh target="collision_detection">\n{mesh_text(corners, faces)}</polygon_mesh>\n'


def body_text(name, bone):
    _, head, tail, half, mass, *_ = bone
    center = [0.5 * (a + b) for a, b in zip(head, tail)]
    motion = "" if name.endswith("hand") else ' motion="dynamic"'
    return (f'<rigid_body id="{name}"{motion} mass="{mass:g}" center="{words(center)}" layer="2" mask="1">\n'
            f"{hull_text(head, tail, half)}</rigid_body>\n")


def joint_text(name, bone, all_bones):
    parent, head, tail, _, _, swing, twist, damping = bone
    axes = words(turn_to(unit([b - a for a, b in zip(head, tail)])))
    frames = ""
    for which, body in (("a", parent), ("b", name)):
        _, h, t, *_ = all_bones[body]
        offset = [x - 0.5 * (a + b) for x, a, b in zip(head, h, t)]
        frames += f'<frame_{which} position="{words(offset)}" rotation="{axes}"/>\n'
    s, t = math.radians(swing), math.radians(twist)
    return (f'<spherical_joint id="{name}_joint" body_a="{parent}" body_b="{name}">\n{frames}<limits>\n'
            f'<limit target="swing" min="0" max="{s:.5g}"/>\n'
            f'<limit target="twist" min="{-t:.5g}" max="{t:.5g}"/>\n</limits>\n'
            f'<drive target="swing" damping="{damping:g}"/>\n<drive target="twist" damping="{damping:g}"/>\n</spherical_joint>\n')


def bundle(mesh, with_skeleton):
    every = bones()
    kept = {n: b for n, b in every.items() if with_skeleton or n.endswith("hand")}
    bodies = "".join(body_text(n, b) for n, b in kept.items())
    joints = "".join(joint_text(n, b, every) for n, b in kept.items() if b[0] in kept)
    joints = f"<joints>\n{joints}</joints>\n" if joints else ""
    attached = "".join(f'<attachment name="{n}" rule="inside_hull" rigid_body="{n}"/>\n' for n in kept)
    skin = mesh_text(mesh.points, [face.corners for face in mesh.faces])
    same = " ".join(str(i) for i in range(len(mesh.points)))
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<sbf version="1.0">
<asset title="A soft figure over {'a rigid skeleton' if with_skeleton else 'nothing'}"/>
<rigid_bodies>
{bodies}</rigid_bodies>
{joints}<render_mesh id="skin" name="Skin">
<polygon_mesh target="rendering">
{skin}</polygon_mesh>
<source_points>{same}</source_points>
</render_mesh>
<soft_body id="flesh" name="Flesh">
<polygon_mesh target="surface">
{skin}</polygon_mesh>
<source_points>{same}</source_points>
<attributes density="500" young_modulus="8e4" poisson_ratio="0.4" damping_ratio="0.2" friction="0.5"/>
<attachments>
{attached}</attachments>
</soft_body>
</sbf>
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("-o", dest="folder", default=FOLDER)
    options = parser.parse_args()
    mesh = mesh_of(build_body(), CELL_M, "figure")
    stale = 0
    for name, with_skeleton in (("figure.sbf", True), ("flesh.sbf", False)):
        path, text = os.path.join(options.folder, name), bundle(mesh, with_skeleton)
        if not options.check:
            with open(path, "w", encoding="utf-8", newline="\n") as stream:
                stream.write(text)
            continue
        with open(path, encoding="utf-8") as stream:
            if stream.read() != text:
                print(f"{path} is stale: run make_figure.py", file=sys.stderr)
                stale = 1
    return stale


if __name__ == "__main__":
    sys.exit(main())
