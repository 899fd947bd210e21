#!/usr/bin/env python3
"""Runs tests/blender/test_NAME.py inside a Blender, with the add-on as its zip installs it. Exits 77 where there is none.

    run_in_blender.py [--root FOLDER] [--library FILE... | --zip FILE] [--program SBFMT [--lizard]] [--window [--keep FOLDER]] NAME...

--root names a folder that holds another system with its Blender; what the tests need is copied into it (root only).
--library files go into the zip, first the library itself, then what it rests on; without any the add-on does without.
--zip is an add-on packed before, and taken as it is.
--program makes bundles of the examples for the tests of import; with --shared of real files from ../shared/data instead.
"""

import argparse
import os
import shutil
import sys

import bundles
from blender_process import Blender, skip
from blender_window import run_in_window


PICTURES = ("blender", "blender-object", "blender-check", "blender-gait", "blender-tails", "blender-joints", "blender-preview")


def pictures_taken(blender, name, kept):
    """Runs a script in a Blender with a screen of its own, on the lizard; its pictures must show something."""
    out = os.path.join(blender.folder, "pictures")
    os.makedirs(out)
    run = run_in_window(blender, name, [f"{blender.inside}/tests/bundles/lizard.sbf", f"{blender.inside}/Xvfb_screen0",
                                        f"{blender.inside}/pictures", *(["smooth"] if kept else [])])
    print(run.stdout, run.stderr)
    drawn = all(os.path.exists(f"{out}/{one}.png") and os.path.getsize(f"{out}/{one}.png") > 8000 for one in PICTURES)
    if kept:
        for one in os.listdir(out):
            shutil.copy(os.path.join(out, one), kept)
    return run.returncode == 0 and drawn and "Traceback" not in run.stdout + run.stderr


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", default="")
    parser.add_argument("--library", action="append", default=[])
    parser.add_argument("--zip", default="")
    parser.add_argument("--program", default="")
    parser.add_argument("--shared", action="store_true")
    parser.add_argument("--window", action="store_true", help="run the script NAME in a window, on a bundle")
    parser.add_argument("--lizard", action="store_true", help="of the bundles the lizard's alone")
    parser.add_argument("--keep", default="", help="where to keep the pictures that it takes: docs/media")
    parser.add_argument("names", nargs="+")
    arguments = parser.parse_args()
    if arguments.shared and not os.path.isdir(bundles.SHARED):
        skip("there is no ../shared/data")
    with Blender(arguments.root, arguments.library, arguments.zip) as blender:
        if arguments.program:
            make = bundles.make_shared if arguments.shared else bundles.make_lizard if arguments.lizard else bundles.make_examples
            make(os.path.join(blender.tests, "bundles"), arguments.program)
        passed = pictures_taken(blender, arguments.names[0], arguments.keep) if arguments.window else blender.run(arguments.names)
    sys.exit(0 if passed else 1)


if __name__ == "__main__":
    main()
