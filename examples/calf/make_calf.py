#!/usr/bin/env python3
"""Models the example calf: one skinned mesh on a rig, like most characters. Writes calf.glb beside this file. See
modelling/character.py."""

import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "modelling"))

from character import Character, main  # noqa: E402
from model_files import Bone, Material  # noqa: E402
from quad_mesh import QuadMesh, subdivided  # noqa: E402
from skin_files import smooth_weights  # noqa: E402

CELL_M = 0.1
MATERIALS = [Material("hide", (0.62, 0.42, 0.27), 0.8), Material("pale", (0.85, 0.76, 0.66), 0.7),
             Material("hoof", (0.12, 0.1, 0.09), 0.5)]

# Boxes of cells: minimum and maximum x, y, z, both included. Cells lie between whole numbers, x and z from -0.5 to 0.5.
BOXES = [((-1, 4, -3), (1, 6, 4)),                                                        # trunk
         ((0, 7, 3), (0, 7, 5)), ((-1, 8, 4), (1, 9, 6)), ((0, 8, 7), (0, 8, 7)),         # neck, head, muzzle
         ((-2, 9, 4), (-2, 9, 4)), ((2, 9, 4), (2, 9, 4)),                                # ears
         ((0, 6, -6), (0, 6, -4))]                                                        # tail
BOXES += [((x, 0, z), (x, 3, z)) for x in (-1, 1) for z in (-3, 3)]                       # legs
BOXES += [((x, 0, z + 1), (x, 0, z + 1)) for x in (-1, 1) for z in (-3, 3)]               # hooves


def material_at(cell):
    x, y, z = cell
    if y == 0:
        return "hoof"
    return "pale" if z >= 7 or (y == 4 and x == 0 and -2 <= z <= 3) or (abs(x) == 2) else "hide"


def cage():
    """The surface of the boxes together, a quad for each face of a cell that has no neighbour there."""
    cells = {(x, y, z) for low, high in BOXES for x in range(low[0], high[0] + 1)
             for y in range(low[1], high[1] + 1) for z in range(low[2], high[2] + 1)}
    mesh, points = QuadMesh("calf"), {}
    for cell in sorted(cells):
        for axis in range(3):
            for side in (0, 1):
                beside = tuple(c + (2 * side - 1) * (k == axis) for k, c in enumerate(cell))
                if beside in cells:
                    continue
                u, v = (axis + 1) % 3, (axis + 2) % 3
                corners = []
                for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)) if side else ((0, 0), (0, 1), (1, 1), (1, 0)):
                    corner = list(cell)
                    corner[axis] += side
                    corner[u] += du
                    corner[v] += dv
                    corner = tuple(corner)
                    if corner not in points:
                        points[corner] = mesh.add_point(((corner[0] - 0.5) * CELL_M, corner[1] * CELL_M,
                                                         (corner[2] - 0.5) * CELL_M))
                    corners.append(points[corner])
                # each of the six directions gets its own island in the texture, so the mesh has seams like real models
                at = [((mesh.points[c][u] + 1.0) / 6.0 + (2 * axis + side) % 3 / 3.0,
                       (mesh.points[c][v] + 1.0) / 4.0 + (2 * axis + side) // 3 / 2.0) for c in corners]
                mesh.add_face(corners, at, material_at(cell))
    return mesh


def build_bones():
    side, up = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    bones = [Bone("hips", None, (0.0, 0.55, -0.15), (0.0, 0.55, -0.35), side),
             Bone("spine", "hips", (0.0, 0.55, -0.15), (0.0, 0.55, 0.12), side),
             Bone("chest", "spine", (0.0, 0.55, 0.12), (0.0, 0.6, 0.38), side),
             Bone("neck", "chest", (0.0, 0.62, 0.36), (0.0, 0.8, 0.44), side),
             Bone("head", "neck", (0.0, 0.8, 0.44), (0.0, 0.9, 0.66), side)]
    tail = [(0.0, 0.65, -0.32), (0.0, 0.65, -0.42), (0.0, 0.65, -0.51), (0.0, 0.65, -0.6)]
    bones += [Bone(f"tail{i + 1}", f"tail{i}" if i else "hips", tail[i], tail[i + 1], side) for i in range(3)]
    for name, parent, z in (("fore", "chest", 0.3), ("hind", "hips", -0.3)):
        for letter, x in (("L", 0.1), ("R", -0.1)):
            bend = 0.015 if name == "fore" else -0.015
            joints = [(x, 0.46, z), (x, 0.27, z + bend), (x, 0.09, z), (x, 0.03, z + 0.11)]
            names = [f"{name}_{part}.{letter}" for part in ("upper", "lower", "hoof")]
            bones += [Bone(names[i], names[i - 1] if i else parent, joints[i], joints[i + 1], side) for i in range(3)]
    bones += [Bone(f"ear.{letter}", "head", (0.13 * s, 0.93, 0.4), (0.2 * s, 0.95, 0.4), up)
              for letter, s in (("L", 1.0), ("R", -1.0))]
    return bones


def build():
    mesh, bones = subdivided(subdivided(cage())).stand().round_points(), build_bones()
    return Character("calf", "Calf: the example of sbfmt for a skinned mesh", mesh, bones, smooth_weights(mesh.points, bones, 0.06),
                     MATERIALS, symmetric=False, quads=True)


if __name__ == "__main__":
    sys.exit(main(build, FOLDER))
