#!/usr/bin/env python3
"""Divides every polygon of an OBJ at its centre and at the midpoints of its sides, without smoothing: the same shape with four
times as many polygons. Python 3, standard library only.

    subdivide.py IN.obj OUT.obj [--times 1]

Positions, objects and groups are kept; uvs, normals and materials are not.
"""

import argparse
import sys


def read_obj(path):
    """Positions of all points; and the statement and polygons of each object or group, in the order of the file."""
    points, parts = [], []
    with open(path, encoding="utf-8", errors="replace") as stream:
        for line in stream:
            words = line.split()
            if not words:
                continue
            if words[0] == "v":
                points.append(tuple(float(word) for word in words[1:4]))
            elif words[0] in ("o", "g"):
                parts.append((line.strip(), []))
            elif words[0] == "f":
                if not parts:
                    parts.append(("o all", []))
                parts[-1][1].append([corner_of(word, len(points)) for word in words[1:]])
    return points, parts


def corner_of(word, count):
    """Index of a corner's point, from 0; negative indices in the file count from the end."""
    index = int(word.split("/")[0])
    return index - 1 if index > 0 else count + index


def middle_of(positions):
    return tuple(sum(axis) / len(positions) for axis in zip(*positions))


def divide(points, parts):
    points, middles = list(points), {}

    def middle(corners):
        key = tuple(sorted(corners))
        if key not in middles:
            middles[key] = len(points)
            points.append(middle_of([points[corner] for corner in key]))
        return middles[key]

    def divided(polygon):
        sides = [middle((polygon[k - 1], polygon[k])) for k in range(len(polygon))]  # sides[k] lies before corner k
        after = sides[1:] + sides[:1]
        if len(polygon) == 3:
            return [[polygon[k], after[k], sides[k]] for k in range(3)] + [sides]
        own = middle(polygon)
        return [[polygon[k], after[k], own, sides[k]] for k in range(len(polygon))]

    return points, [(head, [part for polygon in polygons for part in divided(polygon)]) for head, polygons in parts]


def points_after(points, parts):
    """Points in the order in which the parts use them, so that each point belongs to its part's object."""
    order, placed = [], []
    for head, polygons in parts:
        own = sorted({corner for polygon in polygons for corner in polygon})
        new = {corner: len(order) + k for k, corner in enumerate(own)}
        order += [points[corner] for corner in own]
        placed.append((head, [points[corner] for corner in own], [[new[c] for c in polygon] for polygon in polygons]))
    return placed


def write_obj(path, points, parts):
    with open(path, "w", encoding="utf-8", newline="\n") as stream:
        for head, positions, polygons in points_after(points, parts):
            stream.write(head + "\n")
            stream.writelines("v %.9g %.9g %.9g\n" % position for position in positions)
            stream.writelines("f " + " ".join(str(corner + 1) for corner in polygon) + "\n" for polygon in polygons)


def main():
    parser = argparse.ArgumentParser(description="Divide every polygon of an OBJ at the middles of its sides.")
    parser.add_argument("input")
    parser.add_argument("output")
    parser.add_argument("--times", type=int, default=1)
    options = parser.parse_args()
    try:
        points, parts = read_obj(options.input)
        for _ in range(options.times):
            points, parts = divide(points, parts)
        write_obj(options.output, points, parts)
    except (OSError, ValueError, IndexError) as error:
        sys.exit("subdivide.py: %s" % error)


if __name__ == "__main__":
    main()
