#!/usr/bin/env python3
"""Everything that others install, made of built trees and listed with its SHA-256 in SHA256SUMS.

Usage: make_packages.py --static DIR [--shared DIR] [--self-contained DIR] [--node DIR] --out DIR [NAME...]

    debian    libsbfmt_*.deb libsbfmt-dev_*.deb sbfmt_*.deb   of the tree of shared libraries (dpkg-shlibdeps and file are needed)
    tarball   sbfmt-VERSION-SYSTEM.tar.gz         static libraries, headers, CMake package, pkg-config files, the program: to be put anywhere
    npm       sbfmt-npm-VERSION.tgz               the runtime as WebAssembly with its module (clang, lld, wasi-libc and npm are needed)
    program   sbfmt-cli-VERSION.tgz               the program as WebAssembly for Node.js, of a tree for it
    blender   sbfmt-blender-VERSION-SYSTEM.zip    the add-on for Blender, with the library; of the tree of self-contained libraries where
                                                  there is one: then it needs nothing of the system but its C library
    godot     sbfmt-godot-VERSION-SYSTEM.zip      addons/sbfmt for a Godot project (a Godot 4.6 is needed)

Makes those that are named, all without a name, and prints a table of what was made and, with its reason, what was not. Exit status 1 if
one was not made. The folder is made anew, beside its place, and holds only what was made."""
import argparse
import glob
import gzip
import hashlib
import os
import platform
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile

STAMP = (2026, 1, 1, 0, 0, 0)  # the same bytes whenever it is made of the same files
STAMP_S = 1767225600


class CommandError(Exception):
    """A command failed; the text has it and the end of what it printed."""


def run(*command, folder=None):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=folder, check=False)
    if done.returncode:
        raise CommandError(f"{' '.join(map(str, command))}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def cache_of(build):
    path = os.path.join(build, "CMakeCache.txt")
    if not os.path.exists(path):
        sys.exit(f"{build} is no tree that CMake configured: ./run package makes the two that are needed")
    with open(path, encoding="utf-8") as file:
        return dict(re.match(r"([^:]+):\w+=(.*)", line).groups() for line in file if re.match(r"\w[^:]*:\w+=", line))


def has_target(build, name):
    return re.search(rf"^{name}: ", run("cmake", "--build", build, "--target", "help"), re.MULTILINE) is not None


def files_below(folder):
    for base, folders, names in os.walk(folder):
        folders.sort()
        for name in sorted(names):
            path = os.path.join(base, name)
            yield path, os.path.relpath(path, folder)


def write_tar(folder, top, out):
    def plain(entry):
        entry.mtime, entry.uid, entry.gid, entry.uname, entry.gname = STAMP_S, 0, 0, "root", "root"
        return entry
    with open(out, "wb") as file, gzip.GzipFile("", "wb", fileobj=file, mtime=STAMP_S) as packed, \
            tarfile.open(fileobj=packed, mode="w") as archive:
        for path, name in files_below(folder):
            archive.add(path, f"{top}/{name}", filter=plain)


def write_zip(folder, out):
    with zipfile.ZipFile(out, "w") as archive:
        for path, name in files_below(folder):
            entry = zipfile.ZipInfo(name, STAMP)
            entry.external_attr = (os.stat(path).st_mode & 0o777) << 16  # programs stay programs
            entry.compress_type = zipfile.ZIP_DEFLATED
            with open(path, "rb") as file:
                archive.writestr(entry, file.read())


class Packages:
    """Each of these leaves files in `out`, or returns why it cannot."""

    def __init__(self, static, shared, self_contained, node, out):
        self.static, self.shared, self.self_contained, self.node, self.out = static, shared, self_contained, node, out
        cache = cache_of(static)
        if cache.get("BUILD_SHARED_LIBS") == "ON":
            sys.exit(f"{static} is a tree of shared libraries; --static wants one without BUILD_SHARED_LIBS")
        if shared and cache_of(shared).get("BUILD_SHARED_LIBS") != "ON":
            sys.exit(f"{shared} is a tree of static libraries; --shared wants one with BUILD_SHARED_LIBS")
        self.version = cache["CMAKE_PROJECT_VERSION"]
        self.system = f"{platform.system().lower()}-{platform.machine()}"

    def path(self, kind, ending, native=True):
        middle = f"-{self.system}" if native else ""
        return os.path.join(self.out, f"sbfmt{'-' + kind if kind else ''}-{self.version}{middle}{ending}")

    def debian(self):
        if not self.shared:
            return "no tree of shared libraries was named"
        for command, package in (("dpkg-shlibdeps", "dpkg-dev"), ("file", "file")):
            if not shutil.which(command):
                return f"{command} is not installed (package {package})"
        with tempfile.TemporaryDirectory() as scratch:
            run("cpack", "-G", "DEB", "-B", scratch, folder=self.shared)
            made = glob.glob(os.path.join(scratch, "*.deb"))
            names = sorted(os.path.basename(path).split("_")[0] for path in made)
            if names != ["libsbfmt", "libsbfmt-dev", "sbfmt"]:
                return f"cpack made {names}"
            for path in made:
                shutil.copy(path, self.out)
        return None

    def tarball(self):
        with tempfile.TemporaryDirectory() as scratch:
            run("cmake", "--install", self.static, "--strip", "--prefix", scratch)
            out = self.path("", ".tar.gz")
            write_tar(scratch, os.path.basename(out)[:-len(".tar.gz")], out)
        return None

    def npm(self):
        if not has_target(self.static, "sbfmt-npm"):
            return "the tree has no WebAssembly or npm: install clang, lld, wasi-libc, libclang-rt-VERSION-dev-wasm32 and npm"
        run("cmake", "--build", self.static, "--target", "sbfmt-npm")
        shutil.copyfile(os.path.join(self.static, f"sbfmt-{self.version}.tgz"), self.path("npm", ".tgz", native=False))
        return None

    def program(self):
        if not self.node:
            return "no tree for Node.js was named: ./run package program makes one where Debian's emscripten is"
        run("cmake", "--build", self.node, "--target", "sbfmt-program")
        shutil.copyfile(os.path.join(self.node, f"sbfmt-cli-{self.version}.tgz"), self.path("cli", ".tgz", native=False))
        return None

    def blender(self):
        tree = self.self_contained or self.static
        run("cmake", "--build", tree, "--target", "blender-addon")
        shutil.copyfile(os.path.join(tree, "soft_body_format.zip"), self.path("blender", ".zip"))
        return None

    def godot(self):
        if not has_target(self.static, "sbfmt-godot"):
            return "there is no Godot 4.6: tests/other_system.sh build/other-system fetches one, then configure anew"
        with tempfile.TemporaryDirectory() as scratch:
            run("cmake", "--build", self.static, "--target", "sbfmt-godot")
            run("cmake", "--install", self.static, "--strip", "--component", "godot", "--prefix", scratch)
            write_zip(scratch, self.path("godot", ".zip"))
        return None


NAMES = ("debian", "tarball", "npm", "program", "blender", "godot")


def write_sums(folder):
    lines = []
    for path, name in files_below(folder):
        with open(path, "rb") as file:
            lines.append(f"{hashlib.sha256(file.read()).hexdigest()}  {name}\n")
    with open(os.path.join(folder, "SHA256SUMS"), "w", encoding="utf-8") as file:
        file.writelines(lines)


def make_each(packages, names):
    """Makes these; prints a row of the table for each. How many could not be made."""
    missing = 0
    for name in names:
        try:
            why = getattr(packages, name)()
        except CommandError as error:
            print(error, file=sys.stderr)
            why = "a command failed; what it printed stands above"
        print(f"{name:8}  {'NOT MADE: ' + why if why else 'made'}", flush=True)
        missing += bool(why)
    return missing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--static", required=True)
    parser.add_argument("--shared", default="")
    parser.add_argument("--self-contained", default="")
    parser.add_argument("--node", default="")
    parser.add_argument("--out", required=True)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(NAMES))
    asked = parser.parse_args()
    unknown = [name for name in asked.names if name not in NAMES]
    if unknown:
        parser.error(f"no package {', '.join(unknown)}; there are {', '.join(NAMES)}")
    out = os.path.abspath(asked.out)
    os.makedirs(os.path.dirname(out), exist_ok=True)
    beside = tempfile.mkdtemp(prefix=os.path.basename(out) + ".", dir=os.path.dirname(out))
    try:
        packages = Packages(os.path.abspath(asked.static), asked.shared and os.path.abspath(asked.shared),
                            asked.self_contained and os.path.abspath(asked.self_contained),
                            asked.node and os.path.abspath(asked.node), beside)
        missing = make_each(packages, asked.names or NAMES)
        write_sums(beside)
        os.chmod(beside, 0o755)
        shutil.rmtree(out, ignore_errors=True)
        os.rename(beside, out)
    finally:
        shutil.rmtree(beside, ignore_errors=True)
    for path, name in files_below(out):
        print(f"{os.path.getsize(path):>10}  {name}")
    sys.exit(1 if missing else 0)


if __name__ == "__main__":
    main()
