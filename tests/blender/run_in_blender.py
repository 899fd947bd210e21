#!/usr/bin/env python3
"""Runs tests/blender/test_NAME.py inside a Blender, with the add-on as its zip installs it. Exits 77 where there is none.

    run_in_blender.py [--root FOLDER] [--library FILE]... [--program SBFMT] NAME...

--root names a folder that holds another system with its Blender; what the tests need is copied into it (root only).
--library files go into the zip, first the library itself, then what it rests on; without any the add-on does without.
--program makes bundles of the examples, and of real characters where ../shared/data has them, for the tests of import.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, os.pardir, os.pardir))


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def needed_libraries(path):
    """What the library rests on and another system may have in other versions."""
    lines = subprocess.run(["ldd", path], check=True, capture_output=True, text=True).stdout.splitlines()
    found = [line.split()[2] for line in lines if "=> /" in line]
    common = ("libc.so", "libm.so", "libstdc++.so", "libgcc_s.so", "libpthread", "libdl")
    return [one for one in found if not os.path.basename(one).startswith(common)]


def lay_out(folder, libraries):
    """The add-on from its zip, the tests, and what they compare with."""
    archive = os.path.join(folder, "soft_body_format.zip")
    subprocess.run([sys.executable, "-B", os.path.join(ROOT, "exporters", "blender", "pack.py"), archive, *libraries], check=True)
    with zipfile.ZipFile(archive) as opened:
        opened.extractall(os.path.join(folder, "scripts", "addons"))
    shutil.copytree(HERE, os.path.join(folder, "tests"), ignore=shutil.ignore_patterns("__pycache__", "*.txt"))


EXAMPLES = {"lizard": ("examples/lizard/lizard.obj", "--rig", "examples/lizard/lizard.glb"), "calf": ("examples/calf/calf.glb", ),
            "pup": ("examples/pup/pup.glb", ), "spider": ("examples/spider/spider.glb", ),
            "fox": ("../shared/data/fox/Fox.glb", "--unit", "0.01"), "armadillo": ("../shared/data/armadillo/armadillo.obj", )}


def make_bundles(folder, program):
    os.makedirs(folder)
    for name, words in EXAMPLES.items():
        if os.path.exists(os.path.join(ROOT, words[0])):
            subprocess.run([program, "convert", *words, "-o", os.path.join(folder, f"{name}.sbf")], check=True, cwd=ROOT,
                           stderr=subprocess.DEVNULL)
    for name in ("everything.sbf", "jelly.sbf"):
        shutil.copy(os.path.join(ROOT, "spec", "samples", "valid", name), folder)


def environment(folder):
    """Nothing of the user's own Blender, nor of another Python on the path; the library's companions are found beside it."""
    inside = os.path.join(folder, "scripts", "addons", "soft_body_format", "sbfmt", "lib")
    return {**os.environ, "BLENDER_USER_SCRIPTS": os.path.join(folder, "scripts"), "PYTHONDONTWRITEBYTECODE": "1",
            "BLENDER_USER_CONFIG": os.path.join(folder, "config"), "LD_LIBRARY_PATH": inside, "HOME": folder,
            "PATH": "/usr/bin:/bin"}


def in_window(name, folder):
    """Runs a script in a Blender with a screen of its own; its picture must show something."""
    if not shutil.which("xvfb-run"):
        skip("there is no screen: install the package xvfb")
    picture = os.path.join(folder, "picture.png")
    command = ["xvfb-run", "-a", "-s", "-screen 0 1400x1000x24", "blender", "--factory-startup", "--window-geometry", "0", "0", "1400",
               "1000", "--python", f"{folder}/tests/{name}.py", "--", f"{folder}/tests/bundles/calf.sbf", "calf", "", picture]
    run = subprocess.run(command, env=environment(folder), check=False, capture_output=True, text=True)
    print(run.stdout, run.stderr)
    drawn = os.path.exists(picture) and os.path.getsize(picture) > 50000
    return 0 if run.returncode == 0 and drawn and "Traceback" not in run.stdout + run.stderr else 1


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", default="")
    parser.add_argument("--library", action="append", default=[])
    parser.add_argument("--program", default="")
    parser.add_argument("--window", action="store_true", help="run the script NAME in a window, on a bundle")
    parser.add_argument("names", nargs="+")
    asked = parser.parse_args()
    root = asked.root.rstrip("/")
    if not (os.path.exists(f"{root}/usr/bin/blender") if root else shutil.which("blender")):
        skip(f"there is no Blender{' in ' + root if root else ': install the package blender'}")
    libraries = list(asked.library)
    if root and libraries:
        libraries += needed_libraries(libraries[0])
    with tempfile.TemporaryDirectory(dir=f"{root}/tmp" if root else None) as folder:
        lay_out(folder, libraries)
        if asked.program:
            make_bundles(os.path.join(folder, "tests", "bundles"), asked.program)
        inside = folder[len(root):]
        if asked.window:
            sys.exit(in_window(asked.names[0], inside))
        command = ["/usr/sbin/chroot", root] if root else []
        command += ["blender", "--background", "--factory-startup", "--python-exit-code", "3", "--python",
                    f"{inside}/tests/inside.py", "--", *asked.names]
        sys.exit(1 if subprocess.run(command, env=environment(inside), check=False).returncode else 0)


if __name__ == "__main__":
    main()
