#!/usr/bin/env python3
"""The package for Windows, unpacked and run by wine: the program does what that of this system does, to the byte, in a folder whose name has
spaces and letters beyond ASCII; tests of the command line pass with it; C's example is built against the SDK and ends in the same state; the library's
functions are found by name.

Usage: check_windows_package.py --source DIR --native DIR [--scratch DIR] ZIP
--native is a build folder of this system. Skips (77) where wine or the compiler is not there."""
import argparse
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

SKIPPED = 77
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir, "support"))
import program_calls  # noqa: E402

COMPILER = "x86_64-w64-mingw32-gcc"
EXAMPLES = program_calls.EXAMPLES
# Beside those of every system: what other systems' programs do with folders, processes and the graphics card.
CALLS = [call for call in program_calls.CALLS if call != ["export", "lizard.sbf", "-o", "page.html"]] + [
    ["convert", os.path.join(EXAMPLES, "koi", "koi.glb"), os.path.join(EXAMPLES, "bones", "figure.sbf"), "--out-dir", "many ü", "--no-build"],
    ["validate", "many ü"],
    ["convert", os.path.join("many ü", "..", "panel.obj"), "-o", "päñel.sbfz"],
    ["info", "päñel.sbfz"],
    ["export", "lizard.sbf", "-o", "page.html"],
    ["export", "lizard.sbf", "-o", "glTF ü.glb"],
    ["run", "lizard.sbf", "--seconds", "0.2", "--cache", "run.pvd"],
    ["run", "lizard.sbf", "--seconds", "1", "--drive", "0.4,0.1", "--ground", "noise:0.1,7", "--cache", "run.pc2"],
    ["run", "koi.sbfz", "--seconds", "0.5", "--ragdoll", "--threads", "2"],
    ["run", "lizard.sbf", "--seconds", "0.5", "--free", "--gravity", "3", "--scheme", "position_based"],
    ["export", "lizard.sbf", "-o", "no folder/model.glb"],
]# Tests of the command line that pass with the program by wine. Others wait for signals, pipes, links or limits of POSIX.
TESTS = ("attachments", "bundle_forms", "clips", "derived_parts", "export", "glb_bundles", "info_figures", "many_inputs", "point_caches",
         "repeated_findings", "samples", "scene_formats", "text_forms", "versions", "vtu", "written_bundles")


def skip(why):
    print(f"SKIP the package for Windows: {why}")
    sys.exit(SKIPPED)


def run(*command, must=True, cwd=None):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, errors="replace", cwd=cwd)
    if must and done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{(done.stdout + done.stderr)[-4000:]}")
    return done


def grey_pixels(picture):
    return subprocess.run(["ffmpeg", "-v", "error", "-i", picture, "-f", "rawvideo", "-pix_fmt", "gray", "-"], capture_output=True, check=False).stdout


def wrapper(folder, program):
    """A program that runs another one by wine, for tests that start it by one name. What it prints goes through files: processes of wine that a call
    starts, such as that of the desktop, would hold its pipes open."""
    path = os.path.join(folder, "sbfmt")
    with open(path, "w", encoding="utf-8") as file:
        file.write(f'''#!/bin/sh
printed=$(mktemp -d)
wine "{program}" "$@" >"$printed/out" 2>"$printed/err" </dev/null
status=$?
cat "$printed/out"
cat "$printed/err" >&2
rm -r "$printed"
exit $status
''')
    os.chmod(path, 0o755)
    return path


def test_faults(source, native, program):
    """Tests of the command line, with this program in place of the build's."""
    os.environ.update(SBFMT_PROGRAM=program, SBFMT_BUILD_DIR=native, SBFMT_CC="cc", PYTHONDONTWRITEBYTECODE="1")
    for name in TESTS:
        done = run("xvfb-run", "-a", sys.executable, "-B", os.path.join(source, "tests", "support", "cases.py"), os.path.join(source, "tests", "e2e", f"test_{name}.py"), must=False)
        if done.returncode:
            yield f"e2e/test_{name}\n{(done.stdout + done.stderr)[-3000:]}"


def start_wine():
    """Wine's server and services, which stay until the end: calls then start faster."""
    for command in (["wineserver", "-p"], ["wine", "wineboot", "--init"]):
        subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)


def sdk_faults(source, package, native, folder):
    """The C example against the DLL, by its CMake package; and the functions by name. Programs without a manifest get their arguments in the code page
    of the system, so that these have names in ASCII."""
    bundle = os.path.join(folder, "figure.sbfz")
    run(os.path.join(native, "tools", "sbfmt"), "pack", os.path.join(EXAMPLES, "bones", "figure.sbf"), "-o", bundle)
    tree = os.path.join(folder, "embed")
    run("cmake", "-S", os.path.join(source, "examples", "embed_c"), "-B", tree, "-G", "Ninja", f"-DCMAKE_TOOLCHAIN_FILE={source}/cmake/windows.cmake",
        f"-Dsbfmt_DIR={package}/lib/cmake/sbfmt")
    run("ninja", "-C", tree)
    for library in glob.glob(os.path.join(package, "bin", "*.dll")):
        shutil.copy(library, tree)
    here = os.path.join(folder, "walk")
    archives = [os.path.join(native, name) for name in ("runtime/libsbrun.a", "libsbfmt/libsbfmt-mechanics.a", "libsbfmt/libsbfmt-core.a")]
    run("cc", "-std=c11", "-O2", f"-I{source}/libsbfmt/include", f"-I{source}/runtime/include", os.path.join(source, "examples", "embed_c", "walk.c"),
        *archives, "-lz", "-lm", "-o", here)
    hashes = [re.findall(r"^state [0-9a-f]{16}", run(*command, os.path.basename(bundle), cwd=folder).stdout, re.MULTILINE) for command in
              (("wine", os.path.join(tree, "walk.exe")), (here,))]
    faults = [] if hashes[0] and hashes[0] == hashes[1] else [f"the C example ends in {hashes[0]}, here in {hashes[1]}"]
    caller, copy = os.path.join(folder, "library_calls.exe"), os.path.join(folder, "copy.sbfz")
    run(COMPILER, "-O1", "-static", f"-I{package}/include", os.path.join(HERE, "library_calls.c"), "-o", caller)
    shutil.copy(os.path.join(package, "bin", "sbfmt-interchange.dll"), folder)
    run("wine", caller, "sbfmt-interchange.dll", os.path.join(EXAMPLES, "bones", "figure.sbf"), os.path.basename(copy), cwd=folder)
    with open(copy, "rb") as one, open(bundle, "rb") as other:
        if one.read() != other.read():
            faults.append("the library writes other bytes than the program here")
    return faults


def picture_faults(program, native, folder):
    """A picture by the graphics library of each system: equal but for the rounding of colours."""
    figure = os.path.join(EXAMPLES, "bones", "figure.sbf")
    drawn = run("xvfb-run", "-a", *program, "render", figure, "-o", os.path.join(folder, "there.png"), "--size", "320x240", must=False)
    run(os.path.join(native, "tools", "sbfmt"), "render", figure, "-o", os.path.join(folder, "here.png"), "--size", "320x240")
    if drawn.returncode:
        return [f"no picture: {drawn.stdout}{drawn.stderr}"]
    pixels = [grey_pixels(os.path.join(folder, name)) for name in ("there.png", "here.png")]
    if not pixels[1] or len(pixels[0]) != len(pixels[1]) or sum(abs(a - b) for a, b in zip(*pixels)) > len(pixels[1]):
        return ["the picture differs from that of this system"]
    return []


def window_faults(program, folder):
    """`sbfmt view` opens a window with the package's SDL and draws into it."""
    shot = os.path.join(folder, "wîndow.png")
    seen = run("xvfb-run", "-a", *program, "view", os.path.join(EXAMPLES, "bones", "figure.sbf"), "--frames", "3", "--size", "320x240", "--shot", shot,
               must=False)
    return [] if seen.returncode == 0 and len(set(grey_pixels(shot))) > 20 else [f"no window: {seen.stdout}{seen.stderr}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--source", required=True)
    parser.add_argument("--native", required=True)
    parser.add_argument("zip")
    arguments = parser.parse_args()
    source, native = os.path.abspath(arguments.source), os.path.abspath(arguments.native)
    lacks = [command for command in (COMPILER, "wine", "cmake", "ninja", "xvfb-run", "ffmpeg") if not shutil.which(command)]
    if lacks:
        skip(f"no {', '.join(lacks)}")
    faults = []
    with tempfile.TemporaryDirectory(prefix="sbfmt with spaces, ü ") as folder:
        with zipfile.ZipFile(arguments.zip) as archive:
            archive.extractall(folder)
        package = os.path.join(folder, os.path.basename(arguments.zip)[:-len(".zip")])
        # A prefix of its own: nothing of the user's is touched.
        os.environ.update(WINEPREFIX=os.path.join(folder, "wine"), WINEDEBUG="-all")
        os.mkdir(os.environ["WINEPREFIX"])
        start_wine()
        program = wrapper(folder, os.path.join(package, "bin", "sbfmt.exe"))
        calls = os.path.join(folder, "calls")
        os.mkdir(calls)
        faults += program_calls.compare([program], [os.path.join(native, "tools", "sbfmt")], calls, CALLS, "Windows")
        faults += sdk_faults(source, package, native, folder)
        faults += picture_faults([program], native, folder) + window_faults([program], folder)
        faults += test_faults(source, native, program)
        run("wineserver", "-k", must=False)
    if faults:
        sys.exit("\n\n".join(faults))
    print(f"{len(CALLS)} calls: the same words, statuses and bytes; {len(TESTS)} files of tests passed")


if __name__ == "__main__":
    main()
