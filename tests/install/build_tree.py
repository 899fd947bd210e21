#!/usr/bin/env python3
"""Builds the project without tests and benchmarks in a folder of its own, for the tests that install it.

Usage: build_tree.py SOURCE FOLDER CC [-DOPTION...]"""
import os
import subprocess
import sys


def main():
    source, folder, compiler, *options = sys.argv[1:]
    for command in (["cmake", "-G", "Ninja", "-S", source, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_C_COMPILER={compiler}",
                     "-DSBFMT_TESTS=OFF", "-DSBFMT_BENCH=OFF", *options],
                    ["cmake", "--build", folder, "-j", str(os.cpu_count() or 2)]):
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(f"{' '.join(command)}\n{done.stdout[-4000:]}{done.stderr[-4000:]}")


if __name__ == "__main__":
    main()
