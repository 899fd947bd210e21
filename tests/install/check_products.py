#!/usr/bin/env python3
"""What `cmake --install` copies out of the build's folder is made by the target `products`, which `./run build` and `./run package` build:
else both work only where somebody has built the tests as well.

Usage: check_products.py BUILD"""
import glob
import os
import re
import subprocess
import sys

SKIPPED = 77
# Made by targets that their docs name, and installed only when asked for.
BY_COMPONENT = {"godot"}


def commands(build, target):
    """What Ninja would run for a target that nothing of is there yet."""
    done = subprocess.run(["ninja", "-C", build, "-t", "commands", target], capture_output=True, text=True, check=False)
    return done.stdout if done.returncode == 0 else sys.exit(f"ninja -t commands {target}: {done.stdout}{done.stderr}")


def installed(build):
    """Files and folders of the build's folder that are copied: files as Ninja names them, folders whole."""
    for script in glob.glob(os.path.join(build, "**", "cmake_install.cmake"), recursive=True):
        component = ""
        with open(script, encoding="utf-8") as stream:
            text = stream.read()
        for named, kind, files in re.findall(r'COMPONENT STREQUAL "(\w+)"|file\(INSTALL DESTINATION "[^"]*" TYPE (\w+) .*?FILES\b(.*?)\)\n', text, re.DOTALL):
            component = named or component
            for path in re.findall(r'"([^"]+)"', files if component not in BY_COMPONENT else ""):
                if path.startswith(build + os.sep):
                    yield path.rstrip("/") if kind == "DIRECTORY" else os.path.relpath(path, build)


def main():
    build = os.path.realpath(sys.argv[1])
    if not os.path.exists(os.path.join(build, "build.ninja")):
        print("skipped: only Ninja tells what a target makes")
        sys.exit(SKIPPED)
    everything, products = commands(build, "all"), commands(build, "products")
    made = [path for path in sorted(set(installed(build))) if path in everything]
    if len(made) < 5:
        sys.exit(f"of what is installed the build makes {made} alone: the check would be empty")
    missing = [path for path in made if path not in products]
    if missing:
        sys.exit("installed, but not made by the target products:\n  " + "\n  ".join(missing))
    print(f"{len(made)} places that the build makes and install copies, all by products")


if __name__ == "__main__":
    main()
