"""Bundles for the tests of import: of the examples, and of real files where ../shared/data has them."""

import glob
import os
import shutil
import subprocess

from blender_process import ROOT

SHARED = os.path.join(ROOT, os.pardir, "shared", "data")
LIZARD = (os.path.join(ROOT, "examples", "lizard", "lizard.obj"), "--rig", os.path.join(ROOT, "examples", "lizard", "lizard.glb"))
READ_BY_CONVERT = (".obj", ".glb", ".fbx", ".dae", ".msh", ".vtk", ".node")


def convert(program, out, *words):
    """Whether a file came of it: some shared ones are there to be refused."""
    run = subprocess.run([program, "convert", *words, "-o", out], cwd=ROOT, capture_output=True, check=False)
    return run.returncode == 0


def make_lizard(folder, program):
    """The one that tests of the preview and of panels look at."""
    os.makedirs(folder)
    if not convert(program, os.path.join(folder, "lizard.sbf"), *LIZARD):
        raise SystemExit("the lizard can't be converted")


def make_examples(folder, program):
    """Every built example, under its name; and samples of the specification with parts that no example has."""
    os.makedirs(folder)
    sources = {os.path.basename(os.path.dirname(path)): (path, ) for path in glob.glob(os.path.join(ROOT, "examples", "*", "*.glb"))}
    sources["lizard"] = LIZARD
    for name, words in sorted(sources.items()):
        if not convert(program, os.path.join(folder, f"{name}.sbf"), *words):
            raise SystemExit(f"the example {name} can't be converted")
    subprocess.run([program, "build", os.path.join(ROOT, "examples", "tear", "bar.sbf"), "-o", os.path.join(folder, "bar.sbf")],
                   check=True, stderr=subprocess.DEVNULL)
    subprocess.run([program, "pack", os.path.join(folder, "calf.sbf"), "-o", os.path.join(folder, "calf_packed.sbfz")], check=True,
                   stderr=subprocess.DEVNULL)
    for name in ("everything.sbf", "jelly.sbf"):
        shutil.copy(os.path.join(ROOT, "spec", "samples", "valid", name), folder)


def make_shared(folder, program):
    """Every file of the shared data that `sbfmt convert` takes, as source parts; none where the data is absent."""
    os.makedirs(folder)
    for path in sorted(glob.glob(os.path.join(SHARED, "*", "*"))):
        name = f"{os.path.basename(os.path.dirname(path))}_{os.path.basename(path).replace('.', '_')}.sbf"
        if path.endswith(READ_BY_CONVERT) and os.sep + "bad" + os.sep not in path:
            convert(program, os.path.join(folder, name), path, "--no-build")
