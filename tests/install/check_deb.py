#!/usr/bin/env python3
"""The Debian packages, installed with what they ask for into a clean system, and used there.

Usage: check_deb.py --source DIR --scratch DIR --cc CC [--build DIR]
Builds a tree of shared libraries unless --build names one. Skips (77) where it is not root's to do, or where debootstrap,
dpkg-shlibdeps or the archive of packages is out of reach."""
import argparse
import glob
import os
import shutil
import subprocess
import sys

SKIPPED = 77
QUIET = {"DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C"}


def skip(why):
    print("skipped: " + why)
    sys.exit(SKIPPED)


def run(*command, folder=None, must=True):
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, env={**os.environ, **QUIET}, check=False)
    if must and done.returncode:
        sys.exit(f"{' '.join(command)}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done


def codename():
    with open("/etc/os-release", encoding="utf-8") as file:
        release = dict(line.strip().split("=", 1) for line in file if "=" in line)
    return release.get("VERSION_CODENAME", "")


def build_packages(arguments):
    build = arguments.build or os.path.join(arguments.scratch, "build")
    if not arguments.build:
        run("cmake", "-G", "Ninja", "-S", arguments.source, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
            "-DBUILD_SHARED_LIBS=ON", "-DCMAKE_INSTALL_PREFIX=/usr", f"-DCMAKE_C_COMPILER={arguments.cc}",
            "-DSBFMT_TESTS=OFF", "-DSBFMT_BENCH=OFF")
        run("cmake", "--build", build, "-j", "2")
    packages = os.path.join(arguments.scratch, "packages")
    run("cpack", "-G", "DEB", "-B", packages, folder=build)
    found = sorted(glob.glob(os.path.join(packages, "*.deb")))
    names = [os.path.basename(path).split("_")[0] for path in found]
    if names != ["libsbfmt", "libsbfmt-dev", "sbfmt"]:
        sys.exit(f"packages made: {names}")
    return found


def use(system, source):
    """What a user does first; the figures are those of the lizard."""
    inside = lambda *words, **options: run("chroot", system, *words, **options)  # noqa: E731
    for name in ("lizard.obj", "lizard.mtl", "lizard.glb"):
        shutil.copy(os.path.join(source, "examples", "lizard", name), os.path.join(system, "tmp"))
    inside("sbfmt", "convert", "/tmp/lizard.obj", "--rig", "/tmp/lizard.glb", "-o", "/tmp/lizard.sbfz")
    inside("sbfmt", "validate", "/tmp/lizard.sbfz")
    said = inside("sbfmt", "run", "/tmp/lizard.sbfz", "--seconds", "0.5", "--format", "json").stdout
    if '"valid": true' not in said:
        sys.exit("the lizard does not move well:\n" + said)
    for path in ("usr/share/man/man1/sbfmt.1", "usr/include/sbfmt/io.h", "usr/share/sbfmt/python/sbfmt/__init__.py"):
        if not os.path.exists(os.path.join(system, path)):
            sys.exit(f"/{path} is not there")
    inside("dpkg", "--purge", "sbfmt", "libsbfmt-dev", "libsbfmt")
    left = [path for path in glob.glob(os.path.join(system, "usr", "lib", "*", "libsb*")) +
            glob.glob(os.path.join(system, "usr", "bin", "sbfmt*"))]
    if left:
        sys.exit(f"left behind after purging: {left}")


def main():
    parser = argparse.ArgumentParser()
    for name in ("source", "scratch", "cc"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--build")
    arguments = parser.parse_args()
    if os.geteuid() != 0:
        skip("a clean system can be made and entered by root only")
    missing = [name for name in ("debootstrap", "dpkg-shlibdeps", "cpack", "chroot") if not shutil.which(name)]
    if missing:
        skip(f"{', '.join(missing)}: not installed")
    shutil.rmtree(arguments.scratch, ignore_errors=True)
    system = os.path.join(arguments.scratch, "system")
    os.makedirs(system)
    try:
        done = run("debootstrap", "--variant=minbase", codename(), system, must=False)
        if done.returncode:
            skip("debootstrap could not make a clean system: " + done.stdout.strip().splitlines()[-1])
        inner = os.path.join(system, "packages")
        os.mkdir(inner)
        names = [shutil.copy(path, inner) for path in build_packages(arguments)]
        if run("chroot", system, "apt-get", "update", must=False).returncode:
            skip("the archive of packages is out of reach")
        run("chroot", system, "apt-get", "install", "-y", "--no-install-recommends",
            *("/packages/" + os.path.basename(name) for name in names))
        use(system, arguments.source)
    finally:
        shutil.rmtree(system, ignore_errors=True)
    print("Debian packages: install, run and purge in a clean system")


if __name__ == "__main__":
    main()
