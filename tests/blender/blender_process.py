"""Runs scripts of this folder in Blender with the add-on installed from its zip, and without the user's settings."""

import os
import platform
import shutil
import subprocess
import sys
import tempfile
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, os.pardir, os.pardir))
# Of this machine, in the folder of scripts.
LIBRARIES = os.path.join("scripts", "addons", "soft_body_format", "sbfmt", "lib", {"x86_64": "linux-x64", "aarch64": "linux-arm64"}[platform.machine()])


def skip(why):
    print(f"skipped: {why}")
    sys.exit(77)


def needed_libraries(path):
    """What the library rests on and another system may have in other versions."""
    lines = subprocess.run(["ldd", path], check=True, capture_output=True, text=True).stdout.splitlines()
    found = [line.split()[2] for line in lines if "=> /" in line]
    common = ("libc.so", "libm.so", "libstdc++.so", "libgcc_s.so", "libpthread", "libdl")
    return [one for one in found if not os.path.basename(one).startswith(common)]


class Blender:
    """Of this system, or of another one in a folder (root only). In `folder` lie the add-on's zip, `tests`, and `kept`, where scripts
    leave files; scripts know it as the environment's SBFMT_KEPT. Ends the test where there is no such Blender."""

    def __init__(self, root, libraries, packed=""):
        self.root = root.rstrip("/")
        if not (os.path.exists(f"{self.root}/usr/bin/blender") if self.root else shutil.which("blender")):
            skip(f"there is no Blender{' in ' + self.root if self.root else ': install the package blender'}")
        self.packed = packed  # its zip, where it is not to be packed here
        self.libraries = list(libraries)
        if self.root and self.libraries:
            self.libraries += needed_libraries(self.libraries[0])
        self.temporary = tempfile.TemporaryDirectory(dir=f"{self.root}/tmp" if self.root else None)
        self.folder = self.temporary.name
        self.kept = os.path.join(self.folder, "kept")
        self.tests = os.path.join(self.folder, "tests")

    def __enter__(self):
        archive = os.path.join(self.folder, "soft_body_format.zip")
        if self.packed:
            shutil.copyfile(self.packed, archive)
        else:
            subprocess.run([sys.executable, "-B", os.path.join(ROOT, "exporters", "blender", "pack.py"), archive, *self.libraries],
                           check=True)
        with zipfile.ZipFile(archive) as opened:
            opened.extractall(os.path.join(self.folder, "scripts", "addons"))
        if self.packed and self.root:
            lib = os.path.join(self.folder, LIBRARIES)
            for one in [path for own in os.listdir(lib) if own.endswith(".so")
                        for path in needed_libraries(os.path.join(lib, own))]:
                shutil.copy(one, lib)
        shutil.copytree(HERE, self.tests, ignore=shutil.ignore_patterns("__pycache__", "*.txt"))
        shutil.copy(os.path.join(ROOT, "docs", "blender.md"), os.path.join(self.tests, "page.md"))
        shutil.copy(os.path.join(ROOT, "tests", "support", "cases.py"), self.tests)
        os.mkdir(self.kept)
        return self

    def __exit__(self, *_):
        self.temporary.cleanup()

    @property
    def inside(self):
        """The folder as Blender sees it."""
        return self.folder[len(self.root):]

    def environment(self):
        """The library's companions are found beside it; no other Python is on the path."""
        return {**os.environ, "BLENDER_USER_SCRIPTS": f"{self.inside}/scripts", "PYTHONDONTWRITEBYTECODE": "1",
                "BLENDER_USER_CONFIG": f"{self.inside}/config", "LD_LIBRARY_PATH": os.path.join(self.inside, LIBRARIES), "HOME": self.inside,
                "SBFMT_KEPT": f"{self.inside}/kept", "PATH": "/usr/bin:/bin"}

    @property
    def command(self):
        return (["/usr/sbin/chroot", self.root] if self.root else []) + ["blender"]

    def run(self, names):
        """Runs test modules; whether all of them passed."""
        command = [*self.command, "--background", "--factory-startup", "--python-exit-code", "3", "--python",
                   f"{self.inside}/tests/inside.py", "--", *names]
        return subprocess.run(command, env=self.environment(), check=False).returncode == 0
