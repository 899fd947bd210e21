#!/usr/bin/env python3
"""Installs the Debian packages and their dependencies on a clean system, and uses them there.

Usage: check_deb.py --source DIR --scratch DIR --packages DIR
Skips (77) where it is not root's to do, or where debootstrap or the archive of packages is out of reach.

Whatever is mounted for the clean system is mounted in a namespace of the command that needs it, and is gone with that command,
however it ends. Here nothing is ever mounted below the folder, so that removing it removes nothing else; that is looked at
before it is removed."""
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


def run(*command, must=True):
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **QUIET}, check=False)
    if must and done.returncode:
        sys.exit(f"{' '.join(command)}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done


# The command that follows, in a mount namespace of its own, in which the clean system has a /proc.
APART = ("unshare", "--mount", "--propagation", "private")
INSIDE = 'mount -t proc proc "$0/proc" && exec chroot "$0" "$@"'


def mounted_below(folder):
    with open("/proc/self/mountinfo", encoding="utf-8") as file:
        positions = [line.split()[4].encode().decode("unicode_escape") for line in file]
    return [position for position in positions if position.startswith(os.path.realpath(folder) + os.sep)]


def remove(folder):
    positions = mounted_below(folder)
    if positions:
        sys.exit(f"{folder} is left: {', '.join(positions)} is mounted in it")
    shutil.rmtree(folder, ignore_errors=True)


def enter(system, *words, must=True):
    return run(*APART, "sh", "-c", INSIDE, system, *words, must=must)


def last_line(done):
    return ((done.stdout + done.stderr).strip().splitlines() or ["no message"])[-1]


def codename():
    with open("/etc/os-release", encoding="utf-8") as file:
        release = dict(line.strip().split("=", 1) for line in file if "=" in line)
    return release.get("VERSION_CODENAME", "")


def packages_in(folder):
    found = sorted(glob.glob(os.path.join(folder, "*.deb")))
    names = sorted(os.path.basename(path).split("_")[0] for path in found)
    if names != ["libsbfmt", "libsbfmt-dev", "sbfmt"]:
        sys.exit(f"packages in {folder}: {names}")
    return found


def use(system, source):
    """What a user does first; the figures are those of the lizard."""
    for name in ("lizard.obj", "lizard.mtl", "lizard.glb"):
        shutil.copy(os.path.join(source, "examples", "lizard", name), os.path.join(system, "tmp"))
    enter(system, "sbfmt", "convert", "/tmp/lizard.obj", "--rig", "/tmp/lizard.glb", "-o", "/tmp/lizard.sbfz")
    enter(system, "sbfmt", "validate", "/tmp/lizard.sbfz")
    printed = enter(system, "sbfmt", "run", "/tmp/lizard.sbfz", "--seconds", "0.5", "--format", "json").stdout
    if '"valid": true' not in printed:
        sys.exit("the lizard does not move well:\n" + printed)
    for path in ("usr/share/man/man1/sbfmt.1", "usr/include/sbfmt/io.h", "usr/share/sbfmt/python/sbfmt/__init__.py"):
        if not os.path.exists(os.path.join(system, path)):
            sys.exit(f"/{path} is not there")
    enter(system, "dpkg", "--purge", "sbfmt", "libsbfmt-dev", "libsbfmt")
    left = [path for path in glob.glob(os.path.join(system, "usr", "lib", "*", "libsb*")) +
            glob.glob(os.path.join(system, "usr", "bin", "sbfmt*"))]
    if left:
        sys.exit(f"left behind after purging: {left}")


def main():
    parser = argparse.ArgumentParser()
    for name in ("source", "scratch", "packages"):
        parser.add_argument("--" + name, required=True)
    arguments = parser.parse_args()
    arguments.scratch = os.path.abspath(arguments.scratch)
    if os.geteuid() != 0:
        skip("a clean system can be made and entered by root only")
    missing = [name for name in ("debootstrap", "chroot", "unshare") if not shutil.which(name)]
    if missing:
        skip(f"{', '.join(missing)}: not installed")
    if run(*APART, "true", must=False).returncode:
        skip("a mount namespace cannot be made here")
    remove(arguments.scratch)
    system = os.path.join(arguments.scratch, "system")
    os.makedirs(system)
    try:
        done = run(*APART, "debootstrap", "--variant=minbase", codename(), system, must=False)
        if done.returncode:
            skip("debootstrap could not make a clean system: " + last_line(done))
        inner = os.path.join(system, "packages")
        os.mkdir(inner)
        names = [shutil.copy(path, inner) for path in packages_in(arguments.packages)]
        with open(os.path.join(system, "etc", "dpkg", "dpkg.cfg.d", "thrown-away"), "w", encoding="utf-8") as file:
            file.write("force-unsafe-io\n")  # nothing need survive a loss of power
        done = enter(system, "apt-get", "update", must=False)
        if done.returncode:
            skip("the archive of packages is out of reach: " + last_line(done))
        enter(system, "apt-get", "install", "-y", "--no-install-recommends",
              *("/packages/" + os.path.basename(name) for name in names))
        use(system, arguments.source)
    finally:
        remove(system)
    print("Debian packages: install, run and purge in a clean system")


if __name__ == "__main__":
    main()
