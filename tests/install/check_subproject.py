#!/usr/bin/env python3
"""sbfmt as part of an engine's own tree, by FetchContent with SBFMT_RUNTIME_ONLY as examples/embed_c says: without libxml2, and without tests or
benchmarks among what is built. The example walks to the state that it walks to with this build's libraries.

Warnings are treated as in this build, so that the compiler cache has what it compiled with the same flags.

Usage: check_subproject.py --source DIR --scratch DIR --cc CC --werror ON|OFF --bundle-by PROGRAM LIBRARY..."""
import argparse
import os
import shutil
import subprocess
import sys

PROJECT = """cmake_minimum_required(VERSION 3.16)
project(engine C)
include(FetchContent)
set(SBFMT_RUNTIME_ONLY ON)
set(SBFMT_WERROR {werror})
FetchContent_Declare(sbfmt SOURCE_DIR {source})
FetchContent_MakeAvailable(sbfmt)
add_executable(walk {source}/examples/embed_c/walk.c)
target_link_libraries(walk PRIVATE sbfmt::runtime)
"""


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{(done.stdout + done.stderr)[-4000:]}")
    return done.stdout


def main():
    parser = argparse.ArgumentParser()
    for name in ("--source", "--scratch", "--cc", "--werror", "--bundle-by"):
        parser.add_argument(name, required=True)
    parser.add_argument("libraries", nargs="+")
    arguments = parser.parse_args()
    source, scratch = os.path.realpath(arguments.source), os.path.realpath(arguments.scratch)
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    with open(os.path.join(scratch, "CMakeLists.txt"), "w", encoding="utf-8") as file:
        file.write(PROJECT.format(source=source, werror=arguments.werror))
    build, lizard = os.path.join(scratch, "build"), os.path.join(source, "examples", "lizard", "lizard")
    run("cmake", "-G", "Ninja", "-S", scratch, "-B", build, f"-DCMAKE_C_COMPILER={arguments.cc}", "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_DISABLE_FIND_PACKAGE_LibXml2=ON")
    made = run("ninja", "-C", build, "-t", "commands", "all")
    foreign = [folder for folder in ("/tests/", "/bench/", "/tools/", "/libsbfmt/xml/") if source + folder in made]
    if foreign:
        sys.exit(f"an engine's tree builds what it does not embed: {foreign}")
    run("cmake", "--build", build, "--target", "walk")
    bundle, beside = os.path.join(scratch, "lizard.sbfz"), os.path.join(scratch, "walk_beside")
    run(arguments.bundle_by, "convert", lizard + ".obj", "--rig", lizard + ".glb", "-o", bundle)
    run(arguments.cc, "-std=c11", f"-I{source}/libsbfmt/include", f"-I{source}/runtime/include", f"{source}/examples/embed_c/walk.c", "-o", beside,
        *arguments.libraries, "-lz", "-lm")
    states = [run(program, bundle).split("state ")[-1].strip() for program in (os.path.join(build, "walk"), beside)]
    if states[0] != states[1] or len(states[0]) != 16:
        sys.exit(f"in an engine's tree it walks to {states[0]}, with this build's libraries to {states[1]}")
    print(f"in an engine's own tree: {states[0]}")


if __name__ == "__main__":
    main()
