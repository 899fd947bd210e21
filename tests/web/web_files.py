"""What the tests of the WebAssembly runtime share: where things are, and bundles to step."""
import json
import os
import shutil
import subprocess
import sys

SKIPPED = 77
SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.environ.get("SBFMT_BUILD_DIR") or os.path.join(SOURCE, "build", "dev")
SBFMT = os.path.join(BUILD, "tools", "sbfmt")
HOST = os.path.join(SOURCE, "runtime", "hosts", "web")
PACKAGE = os.path.join(BUILD, "web")  # as CMake puts it together


def skip(why):
    print(f"skipped: {why}")
    sys.exit(SKIPPED)


def need(*programs):
    """Skips where the library was not built or a program is missing."""
    if not os.path.exists(os.path.join(PACKAGE, "sbfmt.wasm")):
        skip("no sbfmt.wasm was built; configuring says which packages it needs")
    for program in programs:
        if not shutil.which(program):
            skip(f"no {program}")


def run(*command, **options):
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{(done.stdout + done.stderr)[-4000:]}")
    return done.stdout


def bundles(folder):
    """Names and packed files: the lizard's mesh with its rig, compressed and stored, and one with rigid bodies."""
    lizard = os.path.join(SOURCE, "examples", "lizard", "lizard")
    text = os.path.join(folder, "lizard.sbf")
    run(SBFMT, "convert", lizard + ".obj", "--rig", lizard + ".glb", "-o", text)
    made = {}
    for name, source, options in (("lizard", text, ()), ("stored", text, ("--store",)),
                                  ("figure", os.path.join(SOURCE, "examples", "bones", "figure.sbf"), ())):
        made[name] = os.path.join(folder, name + ".sbfz")
        run(SBFMT, "pack", source, *options, "-o", made[name])
    return made


def native(path, *arguments):
    """What `sbfmt run` reports."""
    return json.loads(run(SBFMT, "run", path, *arguments, "--format", "json"))
