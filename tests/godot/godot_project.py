"""Runs scripts in Godot in a new project with the installed add-on, without the user's settings."""

import os
import shutil
import subprocess
import sys
import tempfile
import zipfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "blender"))
from blender_process import needed_libraries, skip  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, os.pardir, os.pardir))

PROJECT = """config_version=5

[application]

config/name="test"

[physics]

3d/physics_engine="{engine}"
"""


def unpack(path, folder):
    """A zip, with which of its files are programs."""
    with zipfile.ZipFile(path) as archive:
        for entry in archive.infolist():
            os.chmod(archive.extract(entry, folder), entry.external_attr >> 16 or 0o644)


class Godot:
    """Of this system, or of another one in a folder (root only). `folder` is its project. Ends the test where there is none."""

    def __init__(self, root, godot, build, addon=""):
        self.root = root.rstrip("/")
        self.godot = godot or "godot"
        if not (build or addon) or not (os.path.exists(f"{self.root}/usr/bin/godot") if self.root else shutil.which(self.godot)):
            skip("there is no Godot 4.6 and so no extension for it: tests/other_system.sh build/other-system fetches one, then configure anew")
        self.build, self.addon = build, addon
        self.temporary = tempfile.TemporaryDirectory(dir=f"{self.root}/tmp" if self.root else None)
        self.folder = self.temporary.name

    def __enter__(self):
        if self.addon:
            unpack(self.addon, self.folder)
        else:
            subprocess.run(["cmake", "--install", self.build, "--component", "godot", "--prefix", self.folder], check=True,
                           stdout=subprocess.DEVNULL)
        # Until the editor has seen a project, this list is how a game finds its extensions.
        self.write(".godot/extension_list.cfg", "res://addons/sbfmt/sbfmt.gdextension\n")
        self.set_engine("Jolt Physics")
        return self

    def __exit__(self, *_):
        self.temporary.cleanup()

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def set_engine(self, engine, more=""):
        self.write("project.godot", PROJECT.format(engine=engine) + more)

    def provide_program(self):
        """The add-on's program with its libraries beside it, because another system has other versions."""
        folder = os.path.join(self.folder, "addons", "sbfmt", "bin")
        program = os.path.join(folder, "sbfmt")
        for library in needed_libraries(program) if self.root else []:
            shutil.copy(library, folder)
        os.rename(program, program + "-itself")
        with open(program, "w", encoding="utf-8") as file:
            file.write('#!/bin/sh\nhere=$(dirname "$0")\nLD_LIBRARY_PATH=$here exec "$here/sbfmt-itself" "$@"\n')
        os.chmod(program, 0o755)

    def copy(self, *names):
        for name in names:
            shutil.copy(name, self.folder)

    @property
    def inside(self):
        """The folder as Godot sees it."""
        return self.folder[len(self.root):]

    def command(self, *words):
        first = ["/usr/sbin/chroot", self.root] if self.root else []
        return [*first, self.godot, "--path", self.inside, *words]

    def run(self, *words, **settings):
        """A finished process, with its output in one text."""
        return self.finished(self.command(*words), **settings)

    def run_packed(self, *words):
        """The same of a game without a project, in the folder."""
        first = ["/usr/sbin/chroot", self.root] if self.root else []
        return self.finished([*first, "/usr/bin/env", "-C", self.inside, self.godot, *words])

    def finished(self, command, **settings):
        environment = {**os.environ, "HOME": self.inside, "PATH": "/usr/bin:/bin", **settings}
        return subprocess.run(command, env=environment, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=550)

    def passes(self, script, *words, allowed=(), display="", expected_text=""):
        """Whether a script of this folder ends with status 0, Godot reports only errors that are `allowed`, and it prints once the text that is to
        be `expected_text`. With a display it draws, by OpenGL on the processor."""
        self.copy(os.path.join(HERE, "checks.gd"), os.path.join(HERE, f"{script}.gd"))
        seen = ["--rendering-driver", "opengl3", "--audio-driver", "Dummy"] if display else ["--headless"]
        settings = {"DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1"} if display else {}
        done = self.run(*seen, "--fixed-fps", "60", "--script", f"{script}.gd", "--", *words, **settings)
        good = self.is_good(done, allowed)
        times = done.stdout.count(expected_text) if expected_text else 1
        if times != 1:
            print(f"FAILED: said {times} times: {expected_text}")
        return good and times == 1

    @staticmethod
    def is_good(done, allowed=()):
        """Whether it ended with status 0, and complained of nothing else."""
        print(done.stdout)
        complaints = [line for line in done.stdout.splitlines() if line.startswith(("ERROR:", "SCRIPT ERROR:", "FAILED"))
                      and not any(one in line for one in allowed)]
        return done.returncode == 0 and not complaints
