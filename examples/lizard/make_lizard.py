#!/usr/bin/env python3
"""Models the example lizard: writes lizard.obj, lizard.mtl and the rigged lizard.glb beside this file, its parts closed
each; and lizard_skin.obj and lizard_skin.glb, one skin.

  make_lizard.py            write the files
  make_lizard.py --check    build it again, test it, compare it with the files and print the counts; writes nothing,
                            exit status 1 if anything is off
  make_lizard.py -o DIR     write to, or with --check compare with, another folder

The same files come out every time.
"""

import argparse
import os
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, FOLDER)

import modelling_path  # noqa: E402, F401
from lizard_body import trunk_and_tail, upper_and_lower  # noqa: E402
from lizard_foot import foot  # noqa: E402
from lizard_head import head  # noqa: E402
from lizard_rig import bone_of_section, build_bones  # noqa: E402
from lizard_shape import LEGS, MATERIALS  # noqa: E402
from lizard_skin import lizard_skin, skin_weights  # noqa: E402
from model_files import glb_bytes, mtl_text, obj_text  # noqa: E402
from quad_mesh import check_mirror, check_section, check_surface  # noqa: E402
from skin_files import skinned_glb_bytes  # noqa: E402

TITLE = "Lizard: the example character of sbfmt"
LICENCE = "MIT, as the rest of the repository"
MIN_QUADS, MAX_QUADS = 1200, 4000


def build_sections():
    """The middle ones first, then left and right of each part of the legs."""
    sections = [mesh.symmetrise().round_points() for mesh in (*trunk_and_tail(), head())]
    for leg in LEGS:
        for mesh in (*upper_and_lower(leg), foot(leg)):
            left = mesh.round_points()
            sections += [left, left.mirrored(left.name[:-1] + "R")]
    return sections


def build_files(sections, skin, bones, bone_of):
    return {
        "lizard_skin.obj": obj_text([skin], "lizard.mtl", TITLE).encode("ascii"),
        "lizard_skin.glb": skinned_glb_bytes("Lizard", bones, skin, skin_weights(skin.points, bones), MATERIALS, TITLE, LICENCE),
        "lizard.obj": obj_text(sections, "lizard.mtl", TITLE).encode("ascii"),
        "lizard.mtl": mtl_text(MATERIALS, TITLE).encode("ascii"),
        "lizard.glb": glb_bytes("Lizard", bones, sections, bone_of, MATERIALS, TITLE, LICENCE),
    }


def check(sections, skin, bones, bone_of, files, folder):
    """Messages about everything that is wrong."""
    found = [f"{mesh.name}: {fault}" for mesh in sections for fault in check_section(mesh)]
    by_name = {mesh.name: mesh for mesh in sections}
    for mesh in sections:
        stem, _, side = mesh.name.partition(".")
        if side != "R":
            found += check_mirror(mesh, by_name[stem + ".R"] if side else mesh)
    found += [f"{skin.name}: {fault}" for fault in check_surface(skin)] + check_mirror(skin, skin)
    quads = sum(len(mesh.faces) for mesh in sections)
    if not MIN_QUADS <= quads <= MAX_QUADS:
        found.append(f"{quads} quads, not between {MIN_QUADS} and {MAX_QUADS}")
    if min(p[1] for mesh in sections for p in mesh.points) != 0.0:
        found.append("the feet do not stand on y = 0")
    if sorted(bone_of.values()) != sorted(b.name for b in bones if b.limits):
        found.append("not exactly one section for each bone with limits")
    if {f.material for mesh in sections for f in mesh.faces} != {m.name for m in MATERIALS}:
        found.append("a material is unused or unknown")
    for name, data in files.items():
        try:
            with open(os.path.join(folder, name), "rb") as stream:
                if stream.read() != data:
                    found.append(f"{name} is stale: run make_lizard.py")
        except OSError as error:
            found.append(f"{name}: {error.strerror}")
    return found


def print_counts(sections, skin, bones, bone_of):
    print(f"{'section':12} {'bone':12} {'points':>6} {'quads':>6} {'litres':>7}")
    for mesh in sections:
        print(f"{mesh.name:12} {bone_of[mesh.name]:12} {len(mesh.points):6} {len(mesh.faces):6} "
              f"{1000.0 * mesh.volume():7.3f}")
    print(f"{len(sections)} sections, {len(bones)} bones (of them {sum(b.tail is None for b in bones)} bare ends), "
          f"{sum(len(m.points) for m in sections)} points, {sum(len(m.faces) for m in sections)} quads")
    print(f"one skin: {len(skin.points)} points, {len(skin.faces)} faces, {1000.0 * skin.volume():.3f} litres")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true",
                        help="test the model and compare it with the files; writes nothing")
    parser.add_argument("-o", "--out", default=FOLDER, metavar="DIR",
                        help="where the files are (default: beside this script)")
    options = parser.parse_args()
    sections, skin, bones = build_sections(), lizard_skin(), build_bones()
    bone_of = {mesh.name: bone_of_section(mesh.name) for mesh in sections}
    files = build_files(sections, skin, bones, bone_of)
    if options.check:
        print_counts(sections, skin, bones, bone_of)
        found = check(sections, skin, bones, bone_of, files, options.out)
        for fault in found:
            print(f"make_lizard: {fault}", file=sys.stderr)
        return 1 if found else 0
    try:
        os.makedirs(options.out, exist_ok=True)
        for name, data in files.items():
            with open(os.path.join(options.out, name), "wb") as stream:
                stream.write(data)
    except OSError as error:
        print(f"make_lizard: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
