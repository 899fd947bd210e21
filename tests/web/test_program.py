#!/usr/bin/env python3
"""test_program.py [TARBALL]: the program as WebAssembly, from its npm package in a fresh project, does what the program of this system does: the same
bytes, words and exit statuses. Without a tarball it is the one in build/packages, if there is one."""
import glob
import os
import sys
import tempfile

import web_files
sys.path.insert(0, os.path.join(web_files.SOURCE, "tests", "support"))
import program_calls  # pylint: disable=wrong-import-position


def main():
    web_files.need("node", "npm")
    made = sys.argv[1:] or sorted(glob.glob(os.path.join(web_files.SOURCE, "build", "packages", "sbfmt-cli-*.tgz")))
    if not made:
        web_files.skip("no program for Node.js was made: ./run package program")
    with tempfile.TemporaryDirectory() as folder:
        project = os.path.join(folder, "project with spaces, ü")
        os.mkdir(project)
        web_files.fresh_project(project, os.path.abspath(made[0]))
        node = [os.path.join(project, "node_modules", ".bin", "sbfmt")]
        faults = program_calls.compare(node, [web_files.SBFMT], folder, name="Node.js")
    if faults:
        sys.exit("\n\n".join(faults))
    print(f"{len(program_calls.CALLS)} calls: the same words, statuses and bytes")


main()
