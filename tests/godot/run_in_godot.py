#!/usr/bin/env python3
"""Runs one case of the extension's tests inside a Godot. Exits 77 where there is none.

    run_in_godot.py [--root FOLDER] [--godot PROGRAM] [--build FOLDER] --program SBFMT CASE

--root names a folder that holds another system with its Godot; what the tests need is copied into it (root only). --build is the
build whose add-on is installed; without it there is none."""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

from godot_project import ROOT, Godot, skip

sys.path.insert(0, os.path.join(ROOT, "tests", "blender"))
from blender_window import Screen  # noqa: E402

LIZARD = os.path.join(ROOT, "examples", "lizard", "lizard")
BAR = os.path.join(ROOT, "examples", "tear", "bar.sbf")
DEMO = os.path.join(ROOT, "runtime", "hosts", "godot", "demo")
IN_A_CHROOT = ("XDG_RUNTIME_DIR", "dbus", "Fontconfig")
ENGINES = ("Jolt Physics", "GodotPhysics3D")


def packed(program, folder):
    """The lizard, as an engine loads it; and a second one of stiffer flesh with the same structure."""
    for name, flesh in (("lizard", "20000"), ("stiffer", "30000")):
        text, out = os.path.join(folder, name + ".sbf"), os.path.join(folder, name + ".sbfz")
        subprocess.run([program, "convert", LIZARD + ".obj", "--rig", LIZARD + ".glb", "-o", text], check=True, capture_output=True)
        if name == "stiffer":
            with open(text, encoding="utf-8") as file:
                was = file.read()
            with open(text, "w", encoding="utf-8") as file:
                file.write(was.replace('young_modulus="20000"', f'young_modulus="{flesh}"'))
        subprocess.run([program, "pack", text, "--store", "-o", out], check=True, capture_output=True)
        os.remove(text)


def native(program, folder):
    """What the program itself says of ten seconds on level ground."""
    done = subprocess.run([program, "run", os.path.join(folder, "lizard.sbfz"), "--seconds", "10", "--drive", "0.25,0", "--format", "json"],
                          check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def demo(godot, keep):
    """The demo project on a screen of its own that nobody sees; its picture is kept where `keep` says."""
    if not shutil.which("Xvfb"):
        skip("there is no screen: install the package xvfb")
    for name in os.listdir(DEMO):
        if name.endswith((".gd", ".tscn", ".godot")):
            shutil.copy(os.path.join(DEMO, name), godot.folder)
    with Screen(godot.folder, godot.root) as screen:
        passed = godot.passes("demo", "res://picture.png", display=f":{screen.number}", allowed=IN_A_CHROOT)
    if keep:
        shutil.copy(os.path.join(godot.folder, "picture.png"), keep)
    return passed


def page(godot, program):
    """What docs/godot.md says, as it says it, in a folder where `build/release`, `examples`, `sbfmt` and `mygame` are; the project and its
    scene's floor are what the editor would have made. Whether a character walks then."""
    with open(os.path.join(ROOT, "docs", "godot.md"), encoding="utf-8") as file:
        text = file.read()
    commands = re.search(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL).group(1)
    script = re.search(r"^```gdscript\n(.*?)^```", text, re.MULTILINE | re.DOTALL).group(1)
    lines = [line for line in script.splitlines() if line.strip()]
    if len(lines) > 9:
        print(f"FAILED: {len(lines)} lines are no longer under ten")
        return False
    with tempfile.TemporaryDirectory() as place:
        os.mkdir(os.path.join(place, "build"))
        os.symlink(os.path.abspath(godot.build), os.path.join(place, "build", "release"))
        os.symlink(os.path.join(ROOT, "examples"), os.path.join(place, "examples"))
        os.symlink(godot.folder, os.path.join(place, "mygame"))
        shutil.rmtree(os.path.join(godot.folder, "addons"))
        os.remove(os.path.join(godot.folder, "lizard.sbfz"))
        path = f"{os.path.dirname(os.path.abspath(program))}:{os.environ['PATH']}"
        subprocess.run(["sh", "-e", "-c", commands], cwd=place, env={**os.environ, "PATH": path}, check=True, stdout=subprocess.DEVNULL)
    godot.write("main.gd", script)
    return godot.passes("page")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", default="")
    parser.add_argument("--godot", default="")
    parser.add_argument("--build", default="")
    parser.add_argument("--program", required=True)
    parser.add_argument("--keep", default="", help="where to keep the picture that a case draws")
    parser.add_argument("case")
    asked = parser.parse_args()
    with Godot(asked.root, asked.godot, asked.build) as godot:
        packed(asked.program, godot.folder)
        if asked.case == "values":
            told = native(asked.program, godot.folder)
            passed = godot.passes("values", told["state_hash"], str(told["distance"]), str(sum(told["steps_taken"].values())))
        elif asked.case in ("ground", "bodies"):
            passed = True
            for engine in ENGINES:
                godot.set_engine(engine)
                passed = godot.passes(asked.case) and passed
        elif asked.case == "damaged":
            with open(os.path.join(godot.folder, "lizard.sbfz"), "rb") as file:
                whole = file.read()
            for name, kept in (("cut.sbfz", whole[:len(whole) // 2]), ("empty.sbfz", b""), ("text.sbfz", b"<soft_body_format/>")):
                with open(os.path.join(godot.folder, name), "wb") as file:
                    file.write(kept)
            passed = godot.passes("damaged", allowed=("res://", "play: ", "Failed loading resource", "Error loading resource"))
        elif asked.case == "page":
            passed = page(godot, asked.program)
        elif asked.case == "demo":
            passed = demo(godot, asked.keep)
        else:
            passed = godot.passes(asked.case)
    sys.exit(0 if passed else 1)


if __name__ == "__main__":
    main()
