#!/usr/bin/env python3
"""Tests under node that memory of repeated objects is freed, that wrong orders and wrong calls are reported, and that all of 32 bits can
be addressed."""
import json
import os
import sys
import tempfile

import web_files


def main():
    web_files.need("node")
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "freed_under_node.mjs")
    with tempfile.TemporaryDirectory() as folder:
        lizard = web_files.bundles(folder)["lizard"]
        found = json.loads(web_files.run("node", script, os.path.join(web_files.PACKAGE, "sbfmt.js"), lizard))
    print(f"{found['kib']:.0f} KiB, however often the lizard is loaded")
    if found["faults"]:
        sys.exit("\n".join(found["faults"]))


if __name__ == "__main__":
    main()
