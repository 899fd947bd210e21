#!/usr/bin/env python3
"""Everything that others install, made of two built trees and listed with its SHA-256 in SHA256SUMS.

Usage: make_packages.py --static DIR [--shared DIR] --out DIR

    libsbfmt_*.deb libsbfmt-dev_*.deb sbfmt_*.deb   of the tree of shared libraries (dpkg-shlibdeps is needed)
    sbfmt-VERSION-SYSTEM.tar.gz         static libraries, headers, CMake package, pkg-config files, the program: to be put anywhere
    sbfmt-npm-VERSION.tgz               the runtime as WebAssembly with its module (clang, lld, wasi-libc and npm are needed)
    sbfmt-blender-VERSION-SYSTEM.zip    the add-on for Blender, with the library
    sbfmt-godot-VERSION-SYSTEM.zip      addons/sbfmt for a Godot project (a Godot 4.6 is needed)

What cannot be made here is said with its reason on a line that begins with "skipped", and made on a system that can. The
folder is made anew, beside its place, and holds what was made alone."""
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


def run(*command, folder=None):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, cwd=folder, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
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

    def __init__(self, static, shared, out):
        self.static, self.shared, self.out = static, shared, out
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
        if not shutil.which("dpkg-shlibdeps"):
            return "dpkg-shlibdeps is not installed (package dpkg-dev)"
        with tempfile.TemporaryDirectory() as scratch:
            run("cpack", "-G", "DEB", "-B", scratch, folder=self.shared)
            made = glob.glob(os.path.join(scratch, "*.deb"))
            names = sorted(os.path.basename(path).split("_")[0] for path in made)
            if names != ["libsbfmt", "libsbfmt-dev", "sbfmt"]:
                sys.exit(f"cpack made {names}")
            for path in made:
                shutil.copy(path, self.out)
        return None

    def installed(self):
        with tempfile.TemporaryDirectory() as scratch:
            run("cmake", "--install", self.static, "--strip", "--prefix", scratch)
            out = self.path("", ".tar.gz")
            write_tar(scratch, os.path.basename(out)[:-len(".tar.gz")], out)

    def npm(self):
        if not has_target(self.static, "sbfmt-npm"):
            return "the tree has no WebAssembly or npm; configuring says what is missing"
        run("cmake", "--build", self.static, "--target", "sbfmt-npm")
        shutil.copyfile(os.path.join(self.static, f"sbfmt-{self.version}.tgz"), self.path("npm", ".tgz", native=False))
        return None

    def blender(self):
        run("cmake", "--build", self.static, "--target", "blender-addon")
        shutil.copyfile(os.path.join(self.static, "soft_body_format.zip"), self.path("blender", ".zip"))

    def godot(self):
        if not has_target(self.static, "sbfmt-godot"):
            return "there is no Godot 4.6: tests/other_system.sh build/other-system fetches one, then configure anew"
        with tempfile.TemporaryDirectory() as scratch:
            run("cmake", "--build", self.static, "--target", "sbfmt-godot")
            run("cmake", "--install", self.static, "--strip", "--component", "godot", "--prefix", scratch)
            write_zip(scratch, self.path("godot", ".zip"))
        return None


KINDS = (("Debian packages", "debian"), ("CMake package and pkg-config", "installed"), ("npm package", "npm"),
         ("Blender's add-on", "blender"), ("Godot's add-on", "godot"))


def write_sums(folder):
    lines = []
    for path, name in files_below(folder):
        with open(path, "rb") as file:
            lines.append(f"{hashlib.sha256(file.read()).hexdigest()}  {name}\n")
    with open(os.path.join(folder, "SHA256SUMS"), "w", encoding="utf-8") as file:
        file.writelines(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--static", required=True)
    parser.add_argument("--shared", default="")
    parser.add_argument("--out", required=True)
    asked = parser.parse_args()
    out = os.path.abspath(asked.out)
    os.makedirs(os.path.dirname(out), exist_ok=True)
    beside = tempfile.mkdtemp(prefix=os.path.basename(out) + ".", dir=os.path.dirname(out))
    try:
        packages = Packages(os.path.abspath(asked.static), asked.shared and os.path.abspath(asked.shared), beside)
        for title, kind in KINDS:
            why = getattr(packages, kind)()
            if why:
                print(f"skipped: {title}: {why}", flush=True)
        write_sums(beside)
        os.chmod(beside, 0o755)
        shutil.rmtree(out, ignore_errors=True)
        os.rename(beside, out)
    finally:
        shutil.rmtree(beside, ignore_errors=True)
    for path, name in files_below(out):
        print(f"{os.path.getsize(path):>10}  {name}")


if __name__ == "__main__":
    main()
