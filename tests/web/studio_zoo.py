#!/usr/bin/env python3
"""studio_zoo.py [FILE...]: drops files on the studio, one after another, and says what memory stays taken: at most a tenth more than after the first
character. Without files they are 20 of ../shared/zoo. It takes minutes, and is no part of the tests."""
import glob
import json
import os
import sys
import tempfile

import test_studio
import web_files

EXAMPLE = os.path.join(web_files.SOURCE, "examples", "pup", "pup.glb")
COUNT, MOST = 20, 1.1


def files_of_zoo():
    found = sorted(glob.glob(os.path.join(web_files.SOURCE, "..", "shared", "zoo", "*", "*.glb")), key=os.path.getsize)
    if not found:
        web_files.skip("there is no ../shared/zoo")
    return found[:: max(1, len(found) // COUNT)][:COUNT]


def main():
    web_files.need("node", "npm", "chromium")
    files = sys.argv[1:] or files_of_zoo()
    modules = web_files.playwright()
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "studio_zoo_in_chromium.mjs")
    with tempfile.TemporaryDirectory() as folder:
        studio = test_studio.unpack([], folder)
        reported = web_files.run("node", script, modules, os.path.join(studio, "index.html"), EXAMPLE, *files)
    found = json.loads(reported.splitlines()[-1])
    for name, is_shown in found["dropped"]:
        print(f"{'shown' if is_shown else 'refused'}  {name}")
    for what, (before, after) in found["memory"].items():
        print(f"{what}: {before / 1e6:.1f} MB before, {after / 1e6:.1f} MB after {len(files)} files")
        if after > MOST * before:
            found["faults"].append(f"{what}: {after / before:.2f} times as much as before")
    if found["faults"]:
        sys.exit("\n".join(found["faults"]))


main()
