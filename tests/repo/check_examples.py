#!/usr/bin/env python3
"""Every C program of examples/ compiles as C11 and as C++17 without a warning, by each compiler that is here; and built either way
it prints the same.

Usage: check_examples.py [PROGRAM LIBRARY...]     PROGRAM is sbfmt, which makes the bundle they are run with"""
import os
import shutil
import subprocess
import sys
import tempfile

from repo_files import ROOT, SKIPPED, conclude, project_files

FOLDERS = ("libsbfmt/include", "runtime/include")
WARNINGS = ["-Wall", "-Wextra", "-pedantic-errors", "-Werror"]
COMPILERS = {"gcc": ["-x", "c", "-std=c11"], "clang": ["-x", "c", "-std=c11"],
             "g++": ["-x", "c++", "-std=c++17"], "clang++": ["-x", "c++", "-std=c++17"]}


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


def compile_example(compiler, path, out=None, libraries=()):
    """What the compiler says; '' where it is content. Without `out` nothing is written."""
    includes = [argument for folder in FOLDERS for argument in ("-I", os.path.join(ROOT, folder))]
    ending = ["-o", out, "-x", "none", *libraries, "-lz", "-lm"] if out else ["-fsyntax-only"]
    done = run(compiler, *COMPILERS[compiler], *WARNINGS, *includes, os.path.join(ROOT, path), *ending)
    return done.stderr.strip() if done.returncode else ""


def make_bundle(program, folder):
    lizard, bundle = os.path.join(ROOT, "examples", "lizard", "lizard"), os.path.join(folder, "lizard.sbfz")
    done = run(program, "convert", lizard + ".obj", "--rig", lizard + ".glb", "-o", bundle)
    return bundle if done.returncode == 0 else sys.exit(done.stderr)


def run_faults(path, here, program, libraries):
    """Output of the programs, built as C and as C++, for the same bundle."""
    faults, printed = [], {}
    with tempfile.TemporaryDirectory() as folder:
        bundle = make_bundle(program, folder)
        for compiler in here:
            out = os.path.join(folder, compiler)
            output = compile_example(compiler, path, out, libraries)
            done = run(out, bundle) if not output else None
            if output or done.returncode:
                faults.append(f"{path} by {compiler}: {output or done.stderr}")
            else:
                printed[compiler] = done.stdout
    if len(set(printed.values())) > 1 or not all(printed.values()):
        faults.append(f"{path} prints otherwise: {printed}")
    return faults


def main():
    here = [compiler for compiler in COMPILERS if shutil.which(compiler)]
    if not {"gcc", "clang"} & set(here) or not {"g++", "clang++"} & set(here):
        print("skipped: no C or no C++ compiler (Debian: apt-get install gcc g++)")
        sys.exit(SKIPPED)
    files = [path for path in project_files() if path.startswith("examples/") and path.endswith(".c")]
    faults = [f"{path} by {compiler}: {output}" for path in files for compiler in here
              if (output := compile_example(compiler, path))]
    for path in files if not faults and len(sys.argv) > 2 else ():
        faults += run_faults(path, here, sys.argv[1], sys.argv[2:])
    if not files:
        faults.append("no example found: the check would be empty")
    conclude(f"{len(files)} programs of examples, as C11 and C++17 by {', '.join(here)}", faults)


if __name__ == "__main__":
    main()
