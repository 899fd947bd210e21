#!/usr/bin/env python3
"""Tests the complete path from Blender to the runtime: the program builds and runs exported files. Exits 77 if something is missing.

    whole_way.py --program SBFMT [--root FOLDER] [--library FILE] CASE

source_parts  characters exported without the library; `sbfmt build` finishes them, `sbfmt validate` finds no error, `run` runs them
walkthrough   docs/blender.md as it is written: its steps in Blender, its commands in a shell
lizart        lizart.fbx of ../shared/data, given limits and a gait in the panels, walks
"""

import argparse
import json
import os
import re
import shlex
import shutil
import subprocess
import sys

import bundles
from blender_process import ROOT, Blender, skip


class Fault(Exception):
    pass


def expect(condition, what):
    if not condition:
        raise Fault(what)


def call(program, *words):
    """The JSON object that a verb prints."""
    run = subprocess.run([program, *words, "--format", "json"], capture_output=True, text=True, check=False)
    expect(run.stdout.strip().startswith("{"), f"sbfmt {' '.join(words)}: {run.stdout}{run.stderr}")
    return json.loads(run.stdout)


def source_parts(blender, program):
    expect(blender.run(["leave_source_parts"]), "Blender's part failed")
    names = sorted(name[:-4] for name in os.listdir(blender.kept) if name.endswith(".sbf"))
    expect(len(names) >= 9, f"only {names} are there")
    for name in names:
        path, built = (os.path.join(blender.kept, f"{name}{ending}") for ending in (".sbf", ".built.sbfz"))
        parts = call(program, "info", path)
        expect(parts["tetrahedra"] == 0, f"{name} holds more than source parts: {parts}")
        finished = subprocess.run([program, "build", path, "-o", built], capture_output=True, text=True, check=False)
        expect(finished.returncode == 0, f"{name}: {finished.stderr}")
        found = call(program, "validate", built)
        expect(found["errors"] == 0, f"{name}: {found['messages']}")
        whole = call(program, "info", built)
        print(f"{name}: {whole['springs']}, {whole['tetrahedra']} tetrahedra, {whole['embedded_vertices']} embedded vertices")
        if whole["sections"]:
            expect(sum(whole["springs"].values()) + whole["tetrahedra"] > 0, f"{name} has nothing elastic: {whole}")
            moved = call(program, "run", built, "--seconds", "0.25")
            expect(moved["valid"], f"{name} does not run: {moved}")


def commands():
    """What the page has people type, in order: lines of its blocks, and commands within its steps."""
    with open(os.path.join(ROOT, "docs", "blender.md"), encoding="utf-8") as file:
        return re.findall(r"(?m)^(sbfmt .*)$|`(sbfmt convert [^`]* -o [^`]*)`", file.read())


def give(program, folder, line):
    """A command, in a folder that has the examples as the checkout does."""
    words = shlex.split(line, comments=True)
    run = subprocess.run([os.path.abspath(program), *words[1:]], cwd=folder, capture_output=True, text=True, check=False)
    print(f"$ {line}\n{run.stdout.strip()}")
    expect(run.returncode == 0, f"{line}: {run.returncode} {run.stderr}")


def walkthrough(blender, program):
    lines = [one or other for one, other in commands()]
    makes = [line for line in lines if line.startswith("sbfmt convert")]
    expect(len(makes) == 1 and len(lines) >= 5, f"the page's commands are {lines}")
    os.symlink(os.path.join(ROOT, "examples"), os.path.join(blender.kept, "examples"))
    give(program, blender.kept, makes[0])
    os.chmod(os.path.join(blender.kept, "lizard.sbf"), 0o644)
    expect(blender.run(["test_walkthrough"]), "Blender's part failed")
    for line in lines:
        if line not in makes:
            give(program, blender.kept, line)
    expect(os.path.getsize(os.path.join(blender.kept, "jelly.pc2")) > 1000, "the cache of the jelly holds nothing")


def lizart(blender, program):
    source = os.path.join(bundles.SHARED, "lizard", "lizart.fbx")
    if not os.path.exists(source):
        skip("there is no ../shared/data/lizard/lizart.fbx")
    shutil.copyfile(source, os.path.join(blender.kept, "lizart.fbx"))
    expect(blender.run(["leave_lizart"]), "Blender's part failed")
    path = os.path.join(blender.kept, "lizart.sbfz")
    found = call(program, "validate", path)
    expect(found["errors"] == 0, found["messages"])
    parts = call(program, "info", path)
    expect(parts["gait"]["legs"] == 4 and parts["joints"] >= 12 and len(parts["sections"]) >= 16, parts)
    walk = call(program, "run", path, "--seconds", "6", "--drive", "0.4,0")
    print({name: walk[name] for name in ("valid", "distance", "steps_taken", "stance_slip", "penetration", "volume_ratio", "max_strain")})
    expect(walk["valid"], walk)
    expect(0.75 * 2.4 < walk["distance"] < 1.1 * 2.4, f"it went {walk['distance']} m of 2.4")
    steps = walk["steps_taken"]
    expect(len(steps) == 4 and min(steps.values()) >= 5 and max(steps.values()) <= min(steps.values()) + 1, f"steps {steps}")
    expect(walk["stance_slip"] < 0.01 and walk["penetration"] < 0.01, f"slip {walk['stance_slip']}, penetration {walk['penetration']}")
    expect(walk["volume_ratio"] > 0.7, f"a section keeps {walk['volume_ratio']} of its volume")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", default="")
    parser.add_argument("--library", action="append", default=[])
    parser.add_argument("--program", required=True)
    parser.add_argument("case", choices=("source_parts", "walkthrough", "lizart"))
    arguments = parser.parse_args()
    with Blender(arguments.root, arguments.library) as blender:
        try:
            globals()[arguments.case](blender, arguments.program)
        except Fault as fault:
            print(fault)
            sys.exit(1)


if __name__ == "__main__":
    main()
