#!/usr/bin/env python3
"""Drops the lizard's sections on a plane in Godot. Compares this runtime with SoftBody3D in both physics engines. Prints CSV.

    godot_soft_bodies.py [--root FOLDER] [--godot PROGRAM] --build FOLDER --program SBFMT [--pictures FOLDER] >godot.csv

Measures processor time of the whole process, which a busy machine affects less: the time of FRAMES frames minus that of one, the
minimum of several runs, minus the same for a scene without bodies."""

import argparse
import datetime
import os
import re
import resource
import shutil
import subprocess
import sys

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
sys.path.insert(0, os.path.join(ROOT, "tests", "godot"))
from godot_project import Godot  # noqa: E402
from run_in_godot import packed, Screen  # noqa: E402

FRAMES = 240
RUNS = 3
# Method, engine, simulation_precision, linear_stiffness, pressure_coefficient; the first SoftBody3D row has the defaults.
CASES = [("ours", "Jolt Physics", 0, 0, 0)] + [("godot", engine, *settings) for engine in ("Jolt Physics", "GodotPhysics3D")
                                              for settings in ((5, 0.5, 0), (5, 0.5, 1), (20, 1.0, 1))]


def run(godot, case, frames, what, display=""):
    """One run: processor seconds and output."""
    method, engine, *settings = case
    godot.set_engine(engine)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    display_options = ["--rendering-driver", "opengl3", "--audio-driver", "Dummy"] if display else ["--headless"]
    more = {"DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1"} if display else {}
    done = godot.run(*display_options, "--fixed-fps", "60", "--resolution", "640x400", "--script", "soft_bodies.gd", "--", method, str(frames),
                     *map(str, settings), what, **more)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode or "SCRIPT ERROR" in done.stdout:
        sys.exit(done.stdout)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def cost(godot, case):
    """Processor time in milliseconds per frame."""
    long, short = (min(run(godot, case, frames, "time")[0] for _ in range(RUNS)) for frames in (FRAMES, 1))
    return 1000 * (long - short) / (FRAMES - 1)


def stamp():
    """Machine and date of the measurement, in the columns of other results."""
    def first(*command):
        return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()[0]
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        processor = re.search(r"model name\s*: (.*)", file.read()).group(1)
    return [first("git", "rev-parse", "--short", "HEAD"), "gcc " + first("gcc", "-dumpfullversion"), processor, str(datetime.date.today())]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", default="")
    parser.add_argument("--godot", default="")
    parser.add_argument("--build", required=True)
    parser.add_argument("--program", required=True)
    parser.add_argument("--pictures", default="")
    arguments = parser.parse_args()
    with Godot(arguments.root, arguments.godot, arguments.build) as godot:
        packed(arguments.program, godot.folder)
        godot.copy(os.path.join(ROOT, "bench", "soft_bodies.gd"))
        empty = {engine: cost(godot, ("none", engine, 0, 0, 0)) for engine in ("Jolt Physics", "GodotPhysics3D")}
        print("engine,precision,stiffness,pressure,ms,volume_least,volume_most,volume_last,lowest_mm,commit,compiler,processor,date")
        for number, case in enumerate(CASES):
            volumes = re.search(r"^volume (\S+) (\S+) (\S+) lowest (\S+)", run(godot, case, FRAMES, "look")[1], re.MULTILINE).groups()
            method, engine, *settings = case
            name = "sbfmt" if method == "ours" else "SoftBody3D of " + {"GodotPhysics3D": "Godot Physics"}.get(engine, engine)
            print(name, *(settings if method != "ours" else ("", "", "")), f"{max(0, cost(godot, case) - empty[engine]):.3f}", *volumes[:3],
                  f"{1000 * float(volumes[3]):.2f}", *stamp(), sep=",", flush=True)
            if arguments.pictures:
                with Screen(godot.folder, godot.root) as screen:
                    run(godot, case, FRAMES, "res://picture.png", f":{screen.number}")
                shutil.copy(os.path.join(godot.folder, "picture.png"), os.path.join(arguments.pictures, f"{number}.png"))


if __name__ == "__main__":
    main()
