"""Plays exported files in other programs: three.js, Khronos's validator and MuJoCo under node, and Blender. Each function returns None if
the program is missing."""

import functools
import json
import os
import shutil
import subprocess
import tempfile
import unittest
import zlib

PLAYERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "players")


@functools.lru_cache(maxsize=None)
def node_folder():
    """A folder with the players and the packages that they import, made once a build."""
    build = os.environ.get("SBFMT_BUILD_DIR")
    if not (shutil.which("node") and shutil.which("npm") and build):
        return None
    with open(os.path.join(PLAYERS, "package.json"), "rb") as file:  # other packages, another folder
        made = os.path.join(build, "scratch", f"players-{zlib.crc32(file.read()):08x}")
    sources = [name for name in os.listdir(PLAYERS) if name.endswith((".mjs", ".json"))]
    if not os.path.isdir(os.path.join(made, "node_modules")):
        os.makedirs(os.path.dirname(made), exist_ok=True)
        new = tempfile.mkdtemp(dir=os.path.dirname(made))
        shutil.copy(os.path.join(PLAYERS, "package.json"), new)
        done = subprocess.run(["npm", "install", "--no-audit", "--no-fund", "--no-package-lock"], cwd=new, check=False,
                              capture_output=True)
        if done.returncode != 0:
            shutil.rmtree(new)
            return None
        try:
            os.rename(new, made)
        except OSError:  # another test was faster
            shutil.rmtree(new)
    for name in sources:
        shutil.copy(os.path.join(PLAYERS, name), made)
    return made


def node(program, *arguments):
    """The JSON that a player prints."""
    folder = node_folder()
    done = subprocess.run(["node", os.path.join(folder, program), *map(str, arguments)], cwd=folder, check=True,
                          capture_output=True, text=True, timeout=600)
    return json.loads(done.stdout)


def has_blender():
    return os.path.exists("/usr/bin/blender")


def blender(program, *arguments):
    """The JSON that a script in Blender writes to its last argument."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "out.json")
        done = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "3", "--python",
                               os.path.join(PLAYERS, program), "--", *map(str, arguments), out],
                              check=False, capture_output=True, text=True, timeout=900,
                              env={**os.environ, "PATH": "/usr/bin:/bin"})  # another Python on it would become Blender's
        if done.returncode != 0:
            raise AssertionError(done.stdout[-3000:] + done.stderr[-3000:])
        with open(out, encoding="utf-8") as stream:
            return json.load(stream)


def skip_unless(is_there, reason):
    if "-fsanitize" in os.environ.get("SBFMT_CFLAGS", ""):
        return unittest.skip("sanitizers check C code: other programs play the files of another build")
    return unittest.skipUnless(is_there(), reason)


needs_node = skip_unless(node_folder, "node, npm and the packages of tests/e2e/players are not to be had")
needs_blender = skip_unless(has_blender, "there is no Blender: install the package blender")
