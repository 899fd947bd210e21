#!/usr/bin/env python3
"""Compares time and memory of the add-on's export of a mesh of about 100,000 vertices with Blender's glTF export. Prints CSV.

    bench_blender.py --library FILE [--root FOLDER] [--rounds 5] [--quick]

Each export runs in its own Blender process. The result is the median of the rounds; memory is the peak above Blender's memory before.
--quick measures once and fails if an export fails. --root names a folder with another system and its Blender (needs root); memory is
not measured there. Exits 77 if there is no Blender."""

import argparse
import csv
import json
import os
import statistics
import subprocess
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "tests", "blender"))
from blender_process import Blender  # noqa: E402

WRITERS = (("glTF", "out.glb"), ("sbfmt", "out.sbf"), ("sbfmt", "out.sbfz"))
MAX_S = 300  # limit of one export
COLUMNS = ("blender", "mesh", "writer", "file", "vertices", "wall_s", "processor_s", "peak_MiB", "bytes", "times_glTF")


def measure(blender, writer, mesh, name):
    out = os.path.join(blender.kept, name)
    command = [*blender.command, "--background", "--factory-startup", "--python-exit-code", "3", "--python",
               f"{blender.inside}/tests/measure_export.py", "--", writer, mesh, f"{blender.inside}/kept/{name}"]
    run = subprocess.run(command, env=blender.environment(), capture_output=True, text=True, check=False, timeout=MAX_S)
    found = next((line[9:] for line in run.stdout.splitlines() if line.startswith("measured ")), None)
    if run.returncode or found is None or not os.path.exists(out):
        sys.exit(f"{writer}, {mesh}: {run.stdout[-2000:]}{run.stderr[-2000:]}")
    return {**json.loads(found), "bytes": os.path.getsize(out)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--library", required=True)
    parser.add_argument("--root", default="")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    rows = csv.DictWriter(sys.stdout, COLUMNS, lineterminator="\n")
    rows.writeheader()
    with Blender(arguments.root, [arguments.library]) as blender:
        for mesh in ("plain", ) if arguments.quick else ("plain", "skinned"):
            reference = None
            for writer, name in WRITERS:
                rounds = [measure(blender, writer, mesh, name) for _ in range(1 if arguments.quick else arguments.rounds)]
                middle = {key: round(statistics.median(one[key] for one in rounds), 3) for key in ("wall_s", "processor_s", "peak_MiB")
                          if rounds[0][key] is not None}
                reference = reference or middle["processor_s"]
                rows.writerow({**rounds[0], **middle, "mesh": mesh, "writer": writer, "file": name.split(".")[1],
                               "times_glTF": f"{middle['processor_s'] / reference:.2f}"})
                sys.stdout.flush()


if __name__ == "__main__":
    main()
