#!/usr/bin/env python3
"""The same bits in WebAssembly, under node, as in the program: with four lanes and with one, of compressed and of stored
bundles, after every kind of ground; snapshots come back; what is broken is refused with a message."""
import json
import os
import sys
import tempfile

import web_files

GROUNDS = {"flat": {"kind": "flat"}, "slope:12": {"kind": "slope", "degrees": 12},
           "stairs:0.03,0.3": {"kind": "stairs", "rise": 0.03, "run": 0.3},
           "noise:0.1,5": {"kind": "noise", "height": 0.1, "seed": 5}}
RUNS = (("lizard", "noise:0.1,5", 600), ("stored", "noise:0.1,5", 90), ("lizard", "stairs:0.03,0.3", 90),
        ("lizard", "slope:12", 90), ("figure", "flat", 150))


def main():
    web_files.need("node")
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "step_under_node.mjs")
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        made = web_files.bundles(folder)
        jobs = [{"file": made[name], "ground": GROUNDS[ground], "frames": frames, "drive": [0.3, 0.2]}
                for name, ground, frames in RUNS]
        reported = web_files.run("node", script, os.path.join(web_files.PACKAGE, "sbfmt.js"), json.dumps(jobs))
        found = json.loads(reported)
        for (name, ground, frames), here in zip(RUNS, found["runs"]):
            there = web_files.native(made[name], "--seconds", frames / 60, "--drive", "0.3,0.2", "--ground", ground)
            print(f"{name}, {ground}, {frames} frames: {here['hash']}, {here['us']:.0f} us a frame of processor time")
            for key in ("hash", "scalar_hash", "again_hash"):
                if here[key] != there["state_hash"]:
                    wrong.append(f"{name}, {ground}: {key} {here[key]}, natively {there['state_hash']}")
            if abs(here["distance"] - there.get("distance", here["distance"])) > 1e-6:
                wrong.append(f"{name}, {ground}: went {here['distance']} m, natively {there['distance']} m")
        wrong += found["faults"]
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
