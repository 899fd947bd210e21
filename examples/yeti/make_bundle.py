#!/usr/bin/env python3
"""Makes the yeti's bundle: the model, the poses of its walk and run, a weight follower, and named chains for motion of other
characters.

  make_bundle.py SBFMT OUT.sbf [CONVERT'S OPTIONS...]      SBFMT: the program
"""

import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from bundle_text import Pose, make_bundle  # noqa: E402

CHAINS = {"spine": ["hips", "spine", "chest"], "head": ["neck", "head"],
          **{f"{limb}_{side}": [f"{bone}.{letter}" for bone in bones] for side, letter in (("left", "L"), ("right", "R"))
             for limb, bones in (("arm", ("upper_arm", "forearm", "hand")), ("leg", ("thigh", "shin", "foot")))}}

FOLLOWERS = """<followers>
<follower id="follower.weight" name="weight" bone="bone.spine" channel="weight" frequency="1.6" damping_ratio="0.4" \
response="2" strength="1.2" limit="0.35"/>
</followers>
"""


def arms(left, right, elbow):
    """Rotations about +X: a positive angle swings a hanging arm back; elbows bend forward; arms are lowered at the sides."""
    return {"upper_arm.L": (left, 0.0, -0.30), "upper_arm.R": (right, 0.0, 0.30), "forearm.L": (-elbow, 0.0, 0.0),
            "forearm.R": (-elbow, 0.0, 0.0)}


def poses():
    """The first half of each cycle, from the contact of the left foot to that of the right foot. The other half is its mirror
    image."""
    def stride(name, length, speed, swing, elbow, lean, bob):
        yield Pose(f"{name}_pass", 0.25 * length, speed, {
            "hips": ((0.0, 0.0, -0.3 * swing * 0.2), (0.0, bob, 0.0)), "spine": (lean, 0.0, 0.0),
            "head": (-0.5 * lean, 0.0, 0.08), **arms(0.0, 0.0, 0.8 * elbow)})
        # contact of the right foot: the left arm and the left shoulder are ahead
        yield Pose(f"{name}_reach", 0.5 * length, speed, {
            "hips": ((0.0, 0.0, 0.0), (0.0, -bob, 0.0)), "spine": (1.2 * lean, -0.10 * swing, 0.0),
            "chest": (0.0, -0.16 * swing, 0.0), "head": (-0.5 * lean, 0.20 * swing, 0.0), **arms(-swing, swing, elbow)})
    return [*stride("walk", 0.55, 0.25, 0.55, 0.30, 0.03, 0.010), *stride("run", 0.68, 0.90, 1.05, 1.10, 0.20, 0.030)]


def main():
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    make_bundle(sys.argv[1], os.path.join(FOLDER, "yeti.glb"), sys.argv[2], poses(), CHAINS, sys.argv[3:], FOLLOWERS)
    return 0


if __name__ == "__main__":
    sys.exit(main())
