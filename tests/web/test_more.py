#!/usr/bin/env python3
"""Tests other features of native hosts under node: height fields, levels of detail, recordings. The program replays a recording from
node to the same state."""
import json
import os
import sys
import tempfile

import web_files


def main():
    web_files.need("node")
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "more_under_node.mjs")
    with tempfile.TemporaryDirectory() as folder:
        lizard, recording = web_files.bundles(folder)["lizard"], os.path.join(folder, "walk.rec")
        found = json.loads(web_files.run("node", script, os.path.join(web_files.PACKAGE, "sbfmt.js"), lizard, recording))
        there = web_files.native(lizard, "--ground", "noise:0.1,5", "--replay", recording)
        size = os.path.getsize(recording)
    print(f"{found['hash']}, a recording of {size} bytes")
    if not there["replay_same"] or there["state_hash"] != found["hash"]:
        found["faults"].append(f"the program plays it to {there['state_hash']}, not {found['hash']}")
    if found["faults"]:
        sys.exit("\n".join(found["faults"]))


if __name__ == "__main__":
    main()
