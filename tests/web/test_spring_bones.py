#!/usr/bin/env python3
"""Chains of VRM 0.x and 1.0 avatars and of our own .glb beside npm's @pixiv/three-vrm-springbone: the same chain under the same moving head, gravity and colliders
has the same motion. Its bones change their lengths by how far they moved in a frame, which VRMC_springBone does not: with that the ends differ by up to 2 % of
the chain's length, without it by rounding."""
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

import web_files

sys.path.insert(0, os.path.join(web_files.SOURCE, "tests", "e2e"))
from vrm_files import Avatar, old_springs, springs  # noqa: E402

MOST, MOST_RIGID = 0.02, 0.0005  # relative to the chain's length
RATE = 60
SCRIPT = "0 drive 0.8 1\n1.5 drive 0 -2\n2.5 drive -0.4 1.5\n4 drive 0 0\n"
PACKAGES = ("three@0.170", "@pixiv/three-vrm-springbone@3.5")


def product(a, b):
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz]


class Motion:
    """What the program's character does: poses of all bones, and its chains."""

    def __init__(self, folder, bundle):
        script, poses = os.path.join(folder, "script"), os.path.join(folder, "poses.csv")
        web_files.write(folder, "script", SCRIPT)
        web_files.run(web_files.SBFMT, "run", bundle, "--seconds", 5, "--fps", RATE, "--script", script, "--pose", poses)
        root = ElementTree.parse(bundle).getroot()
        bones = root.findall("skeleton/bone")
        names = [bone.get("name") for bone in bones]
        self.rest = {bone.get("name"): [float(n) for n in bone.get("rotation", "0 0 0 1").split()] for bone in bones}
        self.chains = {}
        for chain in root.findall("chains/chain"):
            if chain.find("chain_spring") is not None:
                self.chains[chain.get("name")] = ([names[int(i)] for i in chain.find("bones").text.split()],
                                                  sum(map(float, chain.find("spacing").text.split())))
        self.frames = []
        with open(poses, newline="", encoding="ascii") as stream:
            for row in csv.DictReader(stream):
                while len(self.frames) <= int(row["frame"]):
                    self.frames.append({})
                self.frames[int(row["frame"])][row["bone"]] = [float(row[k]) for k in ("px", "py", "pz", "qx", "qy", "qz", "qw")]

    def driven(self):
        """Poses of bones that no chain moves: positions and rotations from rest."""
        swings = {name for names, _ in self.chains.values() for name in names}
        return [{name: pose[:3] + product(pose[3:], [-n for n in self.rest[name][:3]] + self.rest[name][3:])
                 for name, pose in frame.items() if name not in swings} for frame in self.frames]

    def difference(self, frames):
        """Maximum distance of a chain's bones from those of the other program, relative to its length; and how far one
        chain's end moved against its first bone."""
        worst, swung = 0, 0
        for names, length in self.chains.values():
            for own, other in zip(self.frames, frames):
                worst = max(worst, max(math.dist(own[name][:3], other[name]) for name in names) / length)
            heights = [own[names[-1]][1] - own[names[0]][1] for own in self.frames]
            swung = max(swung, (max(heights) - min(heights)) / length)
        return worst, swung


def main():
    web_files.need("node", "npm")
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "spring_bones_under_node.mjs")
    with tempfile.TemporaryDirectory() as folder:
        web_files.write(folder, "package.json", '{ "name": "springs", "private": true, "type": "module" }')
        if web_files.npm(folder, "install", *PACKAGES).returncode != 0:
            web_files.skip("npm could not fetch three and @pixiv/three-vrm-springbone")
        with open(script, encoding="utf-8") as stream:
            web_files.write(folder, "springs.mjs", stream.read())
        new, old = Avatar(), Avatar(back=True)
        files = {"1.0": new.write(os.path.join(folder, "new.vrm"), VRMC_vrm=new.humanoid(), VRMC_springBone=springs(new)),
                 "0.x": old.write(os.path.join(folder, "old.vrm"), VRM=old.old(*old_springs(old)))}
        faults = []
        for version, file in files.items():
            bundle, own = file + ".sbf", file + ".glb"
            web_files.run(web_files.SBFMT, "convert", file, "--no-build", "-o", bundle)
            web_files.run(web_files.SBFMT, "export", bundle, "-o", own)
            motion = Motion(folder, bundle)
            web_files.write(folder, "poses.json", json.dumps(motion.driven()))
            for what, path, words in ((version, file, ["back"] if version == "0.x" else []), (f"{version} written as .glb", own, [])):
                for limit, more in ((MOST, []), (MOST_RIGID, ["rigid"])):
                    done = subprocess.run(["node", "springs.mjs", path, "poses.json", str(RATE), *words, *more], cwd=folder,
                                          capture_output=True, text=True, check=False)
                    if done.returncode != 0:
                        sys.exit(done.stderr[-3000:])
                    worst, swung = motion.difference(json.loads(done.stdout)["frames"])
                    print(f"{what} {' '.join(more)}: {100 * worst:.4f} % of the chain's length; its end moved by {100 * swung:.1f} %")
                    if worst > limit or swung < 0.1:
                        faults.append(f"{what} {' '.join(more)}: differs by {100 * worst:.3f} %, {100 * limit} % allowed; moved by {100 * swung:.1f} %")
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
