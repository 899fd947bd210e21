#!/usr/bin/env python3
"""Windows: core, mechanics, runtime and the C example, cross-compiled by mingw-w64 and run by wine. Their tests must pass, and what
moves must end in the same bits as here: the state hashes of scenes by chance, and of the example's walk with a bundle. The program is
checked as its users get it: check_windows_package.py.

Usage: check_windows.py --source DIR --build DIR --native DIR [--file PACKED] [--scenes N]
--native is a build folder of this system, with its tests. Skips (77) where the compiler, its zlib or wine is not there."""
import argparse
import os
import re
import shutil
import subprocess
import sys
import time

SKIPPED = 77
COMPILER = "x86_64-w64-mingw32-gcc"
LIBRARIES = ("runtime/libsbrun.a", "libsbfmt/libsbfmt-mechanics.a", "libsbfmt/libsbfmt-core.a")


def run(*command, must=True, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, errors="replace", **options)
    if must and done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{(done.stdout + done.stderr)[-4000:]}")
    return done


def missing():
    lacks = [command for command in (COMPILER, "wine", "cmake", "ninja") if not shutil.which(command)]
    if not lacks and not os.path.exists("/usr/x86_64-w64-mingw32/lib/libz.a"):
        lacks.append("libz-mingw-w64-dev")
    return lacks


def build(source, tree):
    launcher = ["-DCMAKE_C_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    run("cmake", "-S", source, "-B", tree, "-G", "Ninja", f"-DCMAKE_TOOLCHAIN_FILE={source}/cmake/windows.cmake",
        "-DCMAKE_BUILD_TYPE=Release", "-DSBFMT_RUNTIME_ONLY=ON", "-DSBFMT_BENCH=OFF", *launcher)
    run("ninja", "-C", tree)


def example(source, tree, name, compiler, *last):
    """The C example as C11, linked against the tree's archives."""
    out = os.path.join(tree, name)
    run(compiler, "-std=c11", "-O2", f"-I{source}/libsbfmt/include", f"-I{source}/runtime/include",
        os.path.join(source, "examples", "embed_c", "walk.c"), *(os.path.join(tree, library) for library in LIBRARIES), *last, "-o", out)
    return out


def hash_lines(done):
    return re.findall(r"^(?:scene \d+|state) [0-9a-f]{16}", done.stdout, re.MULTILINE)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", required=True)
    parser.add_argument("--build", required=True)
    parser.add_argument("--native", required=True)
    parser.add_argument("--file")
    parser.add_argument("--scenes", type=int, default=24)
    arguments = parser.parse_args()
    source, tree, native = (os.path.abspath(path) for path in (arguments.source, arguments.build, arguments.native))
    lacks = missing()
    if lacks:
        print(f"SKIP Windows: no {', '.join(lacks)}")
        sys.exit(SKIPPED)
    began = time.monotonic()
    build(source, tree)
    # A prefix of its own: nothing of the user's is touched.
    os.environ.update(WINEPREFIX=os.path.join(tree, "wine"), WINEDEBUG="-all")
    run("wine", "wineboot", "--init")
    wrong = []
    tests = run("ctest", "--test-dir", tree, "-j", str(os.cpu_count() or 1), "-LE", "slow|long", "--output-on-failure", must=False)
    if tests.returncode != 0:
        wrong.append(tests.stdout[-6000:])
    summary = [line for line in tests.stdout.splitlines() if "tests passed" in line]
    pairs = [(("wine", os.path.join(tree, "tests", "state_hashes.exe"), 1, arguments.scenes),
              (os.path.join(native, "tests", "state_hashes"), 1, arguments.scenes))]
    if arguments.file:
        there = example(source, tree, "walk.exe", COMPILER, "/usr/x86_64-w64-mingw32/lib/libz.a", "-static",
                        "-D__USE_MINGW_ANSI_STDIO=1")
        here = example(source, native, "walk_of_windows_check", "cc", "-lz", "-lm")
        pairs.append((("wine", there, arguments.file), (here, arguments.file)))
    compared = 0
    for command, expected in pairs:
        found, wanted = hash_lines(run(*command)), hash_lines(run(*expected))
        if not wanted or len(found) != len(wanted):
            wrong.append(f"{command}: {len(found)} hashes, not {len(wanted)}")
        wrong += [f"Windows: {a}, here: {b}" for a, b in zip(found, wanted) if a != b]
        compared += len(wanted)
    print(f"Windows: {'; '.join(summary)}; {compared} state hashes compared, {time.monotonic() - began:.0f} s", flush=True)
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
