#!/usr/bin/env python3
"""Writes bar.sbf: a soft bar of one metre that hangs from its upper end. It is thinnest in the middle and tears there
under its own weight.

    python3 make_bar.py            writes bar.sbf beside this script
    python3 make_bar.py --check    exits 1 if the file there is stale
    -o FOLDER                      another folder
"""

import argparse
import math
import os
import sys

ALONG, ACROSS = 24, 4  # quads
HIGH, HALF_WIDTH, LOW = 1.0, 0.125, 0.2  # m


def half_width(fraction):
    """The size of the cross-section at a fraction of the length from the top."""
    return HALF_WIDTH * (1 - 0.35 * math.exp(-(((fraction - 0.5) / 0.09) ** 2)))


class Bar:
    """Quads over a lattice of positions, each point once."""

    def __init__(self):
        self.numbers, self.points, self.quads = {}, [], []

    def point(self, i, j, k):
        """Index of the point at a lattice position: i down, j and k across."""
        if (i, j, k) not in self.numbers:
            s = half_width(i / ALONG)
            position = ((2 * j / ACROSS - 1) * s, LOW + HIGH * (1 - i / ALONG), (2 * k / ACROSS - 1) * s)
            self.numbers[i, j, k] = len(self.points)
            self.points.append(tuple(round(x, 5) + 0.0 for x in position))
        return self.numbers[i, j, k]

    def quad(self, *positions):
        self.quads.append([self.point(*position) for position in positions])

    def side(self, i, j):
        """The four quads of one step down and one across."""
        n = ACROSS
        self.quad((i, j, n), (i + 1, j, n), (i + 1, j + 1, n), (i, j + 1, n))
        self.quad((i, j, 0), (i, j + 1, 0), (i + 1, j + 1, 0), (i + 1, j, 0))
        self.quad((i, n, j), (i, n, j + 1), (i + 1, n, j + 1), (i + 1, n, j))
        self.quad((i, 0, j), (i + 1, 0, j), (i + 1, 0, j + 1), (i, 0, j + 1))

    def end(self, j, k):
        """The quads of both ends."""
        self.quad((0, j, k), (0, j, k + 1), (0, j + 1, k + 1), (0, j + 1, k))
        n = ALONG
        self.quad((n, j, k), (n, j + 1, k), (n, j + 1, k + 1), (n, j, k + 1))


def make_bar():
    bar = Bar()
    for i in range(ALONG):
        for j in range(ACROSS):
            bar.side(i, j)
    for j in range(ACROSS):
        for k in range(ACROSS):
            bar.end(j, k)
    return bar


def bundle(bar):
    """The text of the file: the surface is rendered as it is, and its upper end is pinned to the world."""
    numbers = " ".join(f"{x:g}" for position in bar.points for x in position)
    sizes = " ".join("4" for _ in bar.quads)
    corners = " ".join(str(corner) for quad in bar.quads for corner in quad)
    pinned = " ".join(str(i) for i, position in enumerate(bar.points) if position[1] > LOW + HIGH - 1e-6)
    same = " ".join(str(i) for i in range(len(bar.points)))
    mesh = f"<positions>{numbers}</positions>\n<polygon_sizes>{sizes}</polygon_sizes>\n"
    mesh += f"<polygon_points>{corners}</polygon_points>\n"
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<sbf version="1.0">
<asset title="A bar that tears"/>
<render_mesh id="skin" name="Skin">
<polygon_mesh target="rendering">
{mesh}</polygon_mesh>
<source_points>{same}</source_points>
</render_mesh>
<soft_body id="bar" name="Bar">
<polygon_mesh target="surface">
{mesh}</polygon_mesh>
<source_points>{same}</source_points>
<attributes young_modulus="2.5e4" poisson_ratio="0.4" damping_ratio="0.03" tear_strain="0.75"/>
<pins>
<pin_set name="upper end"><points>{pinned}</points></pin_set>
</pins>
</soft_body>
</sbf>
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("-o", dest="folder", default=os.path.dirname(os.path.abspath(__file__)))
    options = parser.parse_args()
    path, text = os.path.join(options.folder, "bar.sbf"), bundle(make_bar())
    if options.check:
        with open(path, encoding="utf-8") as stream:
            if stream.read() != text:
                print(f"{path} is stale: run make_bar.py", file=sys.stderr)
                return 1
    else:
        with open(path, "w", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
