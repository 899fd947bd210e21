"""Functions for the scripts of the skinned examples: build, check and write one GLB.

  make_NAME.py            write NAME.glb beside the script
  make_NAME.py --check    build it again, test it, compare it with the file; exit status 1 if anything is off
  make_NAME.py -o DIR     write to, or with --check compare with, another folder

The same file comes out every time.
"""

import argparse
import os
import sys
from collections import namedtuple

from quad_mesh import check_mirror, check_section, check_surface
from skin_files import skinned_glb_bytes

LICENCE = "MIT, as the rest of the repository"

# mesh: a QuadMesh; bones: of model_files; weights: of skin_files; materials: of model_files; symmetric: whether the
# right side is to be the mirror image of the left; quads: whether all its faces are
Character = namedtuple("Character", "name title mesh bones weights materials symmetric quads", defaults=(True, False))

# Half the width of the middle strip, where points may follow bones of both sides.
MIDDLE_M = 0.01


def build_bytes(character):
    c = character
    return skinned_glb_bytes(c.name.capitalize(), c.bones, c.mesh, c.weights, c.materials, c.title, LICENCE)


def follows_other_side(point, bone):
    """Whether a point outside the middle strip has its largest weight on a limb of the other side."""
    side = {".L": 1.0, ".R": -1.0}.get(bone.name[-2:], 0.0)
    return side * point[0] < -MIDDLE_M


def check(character, data, path):
    """Messages about everything that is wrong."""
    c = character
    found = check_section(c.mesh) if c.quads else check_surface(c.mesh)
    if c.symmetric:
        found += check_mirror(c.mesh, c.mesh)
    if any(abs(sum(w for _, w in weighted) - 1.0) > 1e-4 or not weighted for weighted in c.weights):
        found.append("weights do not sum to one")
    stray = [i for i, weighted in enumerate(c.weights) if weighted and follows_other_side(c.mesh.points[i], c.bones[weighted[0][0]])]
    if stray:
        found.append(f"{len(stray)} points follow a limb of the other side, such as point {stray[0]}")
    idle = {i for i, bone in enumerate(c.bones) if bone.tail is not None} - {i for weighted in c.weights for i, _ in weighted}
    found += [f"bone {c.bones[i].name} moves no point" for i in sorted(idle) if c.bones[i].parent is not None]
    if {f.material for f in c.mesh.faces} != {m.name for m in c.materials}:
        found.append("a material is unused or unknown")
    try:
        with open(path, "rb") as stream:
            if stream.read() != data:
                found.append(f"{os.path.basename(path)} is stale: run make_{c.name}.py")
    except OSError as error:
        found.append(f"{os.path.basename(path)}: {error.strerror}")
    return found


def main(build, folder):
    parser = argparse.ArgumentParser(description="Models an example character.")
    parser.add_argument("--check", action="store_true", help="test the model, compare it with the file; writes nothing")
    parser.add_argument("-o", "--out", default=folder, metavar="DIR", help="where the file is (default: beside this script)")
    options = parser.parse_args()
    character = build()
    data = build_bytes(character)
    path = os.path.join(options.out, character.name + ".glb")
    if options.check:
        mesh = character.mesh
        print(f"{len(mesh.points)} points, {len(mesh.faces)} {'quads' if character.quads else 'faces'}, {len(character.bones)} bones, "
              f"{1000.0 * mesh.volume():.2f} litres")
        found = check(character, data, path)
        for fault in found:
            print(f"make_{character.name}: {fault}", file=sys.stderr)
        return 1 if found else 0
    try:
        os.makedirs(options.out, exist_ok=True)
        with open(path, "wb") as stream:
            stream.write(data)
    except OSError as error:
        print(f"make_{character.name}: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    return 0
