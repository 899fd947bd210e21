#!/usr/bin/env python3
"""The library in an add-on's zip needs only the system's C library, and exports no symbols of the libraries linked into it.

Usage: check_self_contained.py ADDON.zip [--newest-glibc 2.35]

Exit status: 0 it is so, 1 it is not, 77 the add-on was built with the system's libraries."""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import zipfile

C_LIBRARY = {"libc.so.6", "libm.so.6", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
LICENCES = {"libxml2.txt", "meshoptimizer.txt", "qhull.txt", "zlib.txt"}


def output_of(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def faults_of_needs(file, newest):
    """What a program or library needs beside the C library of version `newest`."""
    needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", output_of("readelf", "--wide", "--dynamic", file)))
    for name in sorted(needed - C_LIBRARY):
        yield f"it needs {name}"
    for version in sorted(set(re.findall(r"@GLIBC_([\d.]+)", output_of("readelf", "--wide", "--dyn-syms", file)))):
        if [int(part) for part in version.split(".")] > [int(part) for part in newest.split(".")]:
            yield f"it needs glibc {version}"


def faults_of(library, newest):
    yield from faults_of_needs(library, newest)
    for line in output_of("readelf", "--wide", "--dyn-syms", library).splitlines():
        words = line.split()
        if len(words) > 7 and words[4] in ("GLOBAL", "WEAK") and words[6] != "UND" and not words[7].startswith(("sbf", "sbr")):
            yield f"it shows {words[7]}"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("addon")
    parser.add_argument("--newest-glibc", default="2.35")
    arguments = parser.parse_args()
    with zipfile.ZipFile(arguments.addon) as archive, tempfile.TemporaryDirectory() as folder:
        names = [name for name in archive.namelist() if "/lib/" in name]
        licences = {os.path.basename(name) for name in names if "/licences/" in name}
        if not licences:
            print("skipped: the add-on was built with the libraries of this system")
            sys.exit(77)
        faults = [f"the licence {name} is missing" for name in sorted(LICENCES - licences)]
        for name in names:
            if name.endswith(".so"):
                faults += faults_of(archive.extract(name, folder), arguments.newest_glibc)
    for fault in faults[:20]:
        print(f"{arguments.addon}: {fault}", file=sys.stderr)
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
