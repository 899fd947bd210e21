"""Adds data to a bundle that a mesh and a rig cannot hold: poses of a walk, named chains of bones, and more. A bundle is XML, so the
data is inserted as text; `sbfmt build` then makes the rest and writes the file in canonical order.

Python 3 standard library only.
"""

import math
import os
import re
import subprocess
import sys
import tempfile
from collections import namedtuple


def quaternion_of(turn):
    """x, y, z, w of a rotation vector, radians."""
    angle = math.sqrt(sum(c * c for c in turn))
    factor = math.sin(0.5 * angle) / angle if angle > 0.0 else 0.0
    return (*(c * factor for c in turn), math.cos(0.5 * angle))


def numbers(values):
    return " ".join(f"{v + 0.0:.6g}" for v in values)


def product(a, b):
    """The product of two quaternions: rotation b, then a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def rest_rotations(text):
    """{id: x, y, z, w} of a bundle's bones."""
    found = {}
    for bone in re.findall(r"<bone [^>]*>", text):
        turn = re.search(r' rotation="([^"]*)"', bone)
        found[re.search(r' id="([^"]*)"', bone)[1]] = tuple(map(float, turn[1].split())) if turn else (0.0, 0.0, 0.0, 1.0)
    return found


# keys: {bone: rotation or (rotation, translation)}. The rotation is a vector in radians about the axes of the asset, not of the
# bone; the translation is in metres, in the parent's frame
Pose = namedtuple("Pose", "name distance speed keys mirrored", defaults=(True,))


def pose_text(pose, rotations):
    lines = [f'<pose id="pose.{pose.name}" name="{pose.name}" distance="{pose.distance:g}" speed="{pose.speed:g}"'
             + (' mirrored="true">' if pose.mirrored else ">")]
    for bone, key in pose.keys.items():
        turn, translation = key if isinstance(key[0], tuple) else (key, (0.0, 0.0, 0.0))
        x, y, z, w = rotations["bone." + bone]
        own = product(product((-x, -y, -z, w), quaternion_of(turn)), (x, y, z, w))
        lines.append(f'<pose_key bone="bone.{bone}" translation="{numbers(translation)}" rotation="{numbers(own)}"/>')
    return "\n".join([*lines, "</pose>"])


def bone_numbers(text):
    """{id: number} of a bundle's bones."""
    return {found: i for i, found in enumerate(re.findall(r'<bone id="([^"]*)"', text))}


def retarget_chains(text, chains):
    """chains: {name: [bone, ...] from root to end}."""
    number_of_bone = bone_numbers(text)
    return "\n".join(f'<retarget_chain id="chain.{name}" name="{name}">\n<bones>'
                     + " ".join(str(number_of_bone["bone." + bone]) for bone in bones) + "</bones>\n</retarget_chain>"
                     for name, bones in chains.items())


def without_poses(text):
    """Removes the poses that `convert` proposes from a bundle, so that others can replace them."""
    text = re.sub(r"<poses>.*?</poses>", "", text, flags=re.DOTALL)
    return re.sub(r' rest_pose="[^"]*"', "", text)


def make_bundle(sbfmt, model, out, poses=(), chains=None, options=(), more=""):
    """Converts the model, adds poses, chains and other text, and builds. Ends the program if `sbfmt` fails."""
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "source.sbf")
        calls = [[sbfmt, "convert", "--no-build", model, "-o", source, *options], [sbfmt, "build", source, "-o", out]]
        if subprocess.run(calls[0], check=False).returncode:
            sys.exit(1)
        with open(source, encoding="utf-8") as stream:
            text = stream.read()
        added = more
        if poses:
            text = without_poses(text)
            added += "<poses>\n" + "\n".join(pose_text(p, rest_rotations(text)) for p in poses) + "\n</poses>\n"
        if chains:
            added += "<retarget_chains>\n" + retarget_chains(text, chains) + "\n</retarget_chains>\n"
        with open(source, "w", encoding="utf-8") as stream:
            stream.write(text.replace("</sbf>", added + "</sbf>"))
        if subprocess.run(calls[1], check=False).returncode:
            sys.exit(1)
