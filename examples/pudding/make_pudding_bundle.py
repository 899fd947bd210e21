#!/usr/bin/env python3
"""Makes the pudding's bundle: the model, a clip of a hop, and followers that squash it and shake its cherry.

  make_pudding_bundle.py SBFMT OUT.sbf [CONVERT'S OPTIONS...]      SBFMT: the program
"""

import math
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from bundle_text import make_bundle, numbers  # noqa: E402

HEIGHT_M, GRAVITY, STANDS_S, KEY_S = 0.15, 9.81, 0.25, 1 / 60
SPEED = 0.4  # m/s at which it does not slide

FOLLOWERS = """<followers>
<follower id="follower.squash" name="squash" bone="bone.body" channel="squash" frequency="2.8" damping_ratio="0.25" \
response="2" strength="1.3"/>
<follower id="follower.cherry" name="cherry" bone="bone.cherry" channel="position" frequency="4" damping_ratio="0.2" \
response="1"/>
</followers>
"""


def hop():
    """The clip of a hop: stands, then flies on a parabola. While standing it moves back against the drive, so that it does not slide."""
    flies_s = 2 * math.sqrt(2 * HEIGHT_M / GRAVITY)
    duration, times, values = STANDS_S + flies_s, [], []
    count = round(duration / KEY_S)
    for i in range(count + 1):
        t = duration * i / count
        air = max(t - STANDS_S, 0.0)
        back = -SPEED * t if t < STANDS_S else -SPEED * STANDS_S * (1 - air / flies_s)
        times.append(t)
        values += [0.0, 0.5 * GRAVITY * air * (flies_s - air), back]
    return f"""<clips>
<clip id="clip.hop" name="hop" duration="{duration:.6g}">
<track bone="bone.body" property="translation">
<times>{numbers(times)}</times>
<values>{numbers(values)}</values>
</track>
</clip>
</clips>
"""


def main():
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    make_bundle(sys.argv[1], os.path.join(FOLDER, "pudding.glb"), sys.argv[2], options=sys.argv[3:], more=FOLLOWERS + hop())
    return 0


if __name__ == "__main__":
    sys.exit(main())
