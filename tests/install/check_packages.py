#!/usr/bin/env python3
"""Installs and uses each package of `./run package` on a system without the rest of this project.

Usage: check_packages.py --source DIR --build DIR --scratch DIR --cc CC [--cxx CXX] (--shared DIR | --packages DIR)

Without --packages they are made first: of the tree --build, and of --shared, a tree of shared libraries.
The Debian packages go into a clean system, the tarball into another folder, the npm package into a fresh project under node,
the add-ons into Blender and Godot as their users install them. A check that lacks its tool, and a package that could not be
made, says so and is skipped. Exit status: 0 all that ran is good, 1 something is not, 77 nothing could run."""
import argparse
import glob
import hashlib
import json
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "cmake"))
from make_packages import cache_of  # noqa: E402

SKIPPED = 77


def make(arguments):
    out = os.path.join(arguments.scratch, "made")
    command = [sys.executable, "-B", os.path.join(arguments.source, "cmake", "make_packages.py"), "--static", arguments.build, "--shared",
               arguments.shared, "--out", out]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode and ("NOT MADE" not in done.stdout or "a command failed" in done.stdout):
        sys.exit(f"{' '.join(command)}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    print(done.stdout, flush=True)
    return out


def check_sums(folder):
    """SHA256SUMS lists every file, with its sum."""
    with open(os.path.join(folder, "SHA256SUMS"), encoding="utf-8") as file:
        listed = dict(reversed(line.rstrip("\n").split("  ")) for line in file)
    if set(listed) != set(os.listdir(folder)) - {"SHA256SUMS"}:
        sys.exit(f"SHA256SUMS lists {sorted(listed)}, there are {sorted(os.listdir(folder))}")
    for name, reported in listed.items():
        with open(os.path.join(folder, name), "rb") as file:
            if hashlib.sha256(file.read()).hexdigest() != reported:
                sys.exit(f"{name} has another sum than SHA256SUMS tells")
    return listed


def check_bill(folder, listed):
    """The bill of materials describes every package with its sum, and each of its references is of a package in it."""
    with open(first(folder, "sbfmt-*.spdx.json"), encoding="utf-8") as file:
        bill = json.load(file)
    sums = {package["name"]: package["checksums"][0]["checksumValue"] for package in bill["packages"]}
    for name, reported in listed.items():
        if not name.endswith(".spdx.json") and sums.get(name) != reported:
            sys.exit(f"the bill of materials has {name} with the sum {sums.get(name)}, not {reported}")
    known = {package["SPDXID"] for package in bill["packages"]} | {"SPDXRef-DOCUMENT"}
    for relation in bill["relationships"]:
        for side in ("spdxElementId", "relatedSpdxElement"):
            if relation[side] not in known:
                sys.exit(f"the bill of materials tells of {relation[side]}, which it does not list")


def first(folder, pattern):
    return next(iter(sorted(glob.glob(os.path.join(folder, pattern)))), "")


def checks(arguments, folder):
    """Name, the package's file ("" where there is none), and the command that tries it."""
    tests, cache = os.path.join(arguments.source, "tests"), cache_of(arguments.build)
    program = os.path.join(arguments.build, "tools", "sbfmt")
    cxx = ["--cxx", arguments.cxx] if arguments.cxx else []
    deb = first(folder, "sbfmt_*.deb")
    yield "Debian packages, in a clean system", deb, [os.path.join(tests, "install", "check_deb.py"), "--source", arguments.source,
                                                      "--scratch", os.path.join(arguments.scratch, "deb"), "--packages", folder]
    tarball = first(folder, "sbfmt-[0-9]*.tar.gz")
    yield "CMake package and pkg-config, moved", tarball, [
        os.path.join(tests, "install", "check_install.py"), "--source", arguments.source, "--scratch",
        os.path.join(arguments.scratch, "tarball"), "--cc", arguments.cc, *cxx, "--tarball", tarball]
    linux = first(folder, "sbfmt-program-*.tar.gz")
    yield "the program for any Linux", linux, [os.path.join(tests, "install", "check_program.py"), "--native", arguments.build, linux]
    windows = first(folder, "sbfmt-*-windows-x86_64.zip")
    yield "the package for Windows, by wine", windows, [os.path.join(tests, "machines", "check_windows_package.py"), "--source", arguments.source,
                                                        "--native", arguments.build, windows]
    npm = first(folder, "sbfmt-npm-*.tgz")
    yield "npm package, in a fresh project", npm, [os.path.join(tests, "web", "test_package.py"), npm]
    cli = first(folder, "sbfmt-cli-*.tgz")
    yield "the program for Node.js, in a fresh project", cli, [os.path.join(tests, "web", "test_program.py"), cli]
    studio = first(folder, "sbfmt-studio-*.zip")
    yield "the studio, in a browser", studio, [os.path.join(tests, "web", "test_studio.py"), studio]
    addon = first(folder, "sbfmt-blender-*.zip")
    blender = os.path.join(tests, "blender", "run_in_blender.py")
    yield "Blender's add-on, in the system's Blender", addon, [blender, "--zip", addon, "test_addon_zip", "test_check_and_build"]
    if arguments.packages:  # those made here have the libraries of this system
        yield "Blender's add-on, whatever the system has", addon, [os.path.join(tests, "install", "check_self_contained.py"), addon]
    newer = cache.get("SBFMT_OTHER_SYSTEM", os.path.join(arguments.source, "build", "other-system"))
    yield "Blender's add-on, in a newer Blender", addon, [blender, "--root", newer, "--zip", addon, "test_addon_zip",
                                                          "test_check_and_build"]
    godot = first(folder, "sbfmt-godot-*.zip")
    where = cache.get("SBFMT_GODOT_ROOT", "")
    where = ["--root", where] if where else ["--godot", cache.get("SBFMT_GODOT", "godot")]
    for case, what in (("values", "in a game"), ("imported", "in the editor")):
        yield f"Godot's add-on, {what}", godot, [os.path.join(tests, "godot", "run_in_godot.py"), *where, "--addon", godot,
                                                 "--program", program, case]


def main():
    parser = argparse.ArgumentParser()
    for name in ("source", "build", "scratch", "cc"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--cxx", default="")
    parser.add_argument("--shared", default="")
    parser.add_argument("--packages", default="")
    arguments = parser.parse_args()
    for name in ("source", "build", "scratch", "shared", "packages"):
        value = getattr(arguments, name)
        setattr(arguments, name, value and os.path.abspath(value))
    os.makedirs(arguments.scratch, exist_ok=True)
    folder = arguments.packages or make(arguments)
    check_bill(folder, check_sums(folder))
    good = skipped = 0
    failed = []
    environment = {**os.environ, "SBFMT_BUILD_DIR": arguments.build, "PYTHONDONTWRITEBYTECODE": "1"}
    for name, package, command in checks(arguments, folder):
        if not package:
            print(f"SKIP {name}: not made, see above: {name}", flush=True)
            skipped += 1
            continue
        done = subprocess.run([sys.executable, "-B", *command], capture_output=True, text=True, env=environment, check=False)
        printed = (done.stdout + done.stderr).strip()
        if done.returncode == SKIPPED:
            print(f"SKIP {name}: {printed.splitlines()[-1].removeprefix('skipped: ') if printed else 'it gave no reason'}", flush=True)
            skipped += 1
        elif done.returncode:
            print(f"FAILED   {name}\n{printed[-6000:]}", flush=True)
            failed.append(name)
        else:
            print(f"good     {name}", flush=True)
            good += 1
    print(f"{good} good, {skipped} skipped, {len(failed)} failed")
    sys.exit(1 if failed else 0 if good else SKIPPED)


if __name__ == "__main__":
    main()
