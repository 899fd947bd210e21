"""Paths and bundles for tests of the WebAssembly runtime."""
import contextlib
import functools
import http.server
import json
import os
import re
import shutil
import subprocess
import sys
import threading

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


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as stream:
        stream.write(text)


def npm(folder, *arguments):
    return subprocess.run(["npm", *arguments, "--no-audit", "--no-fund"], cwd=folder, capture_output=True, text=True, check=False)


def tarball():
    """The npm package, packed."""
    run("cmake", "--build", BUILD, "--target", "sbfmt-npm")
    packed = [name for name in os.listdir(BUILD) if re.fullmatch(r"sbfmt-[\d.]+\.tgz", name)]
    if len(packed) != 1:
        sys.exit(f"packed: {packed}")
    return os.path.join(BUILD, packed[0])


def fresh_project(folder, package):
    """A project with nothing in it but the package."""
    write(folder, "package.json", '{ "name": "fresh", "private": true, "type": "module" }')
    done = npm(folder, "install", "--offline", "--omit=peer", package)
    if done.returncode != 0:
        sys.exit("npm install: " + done.stderr[-2000:])


class Quiet(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".wasm": "application/wasm", ".js": "text/javascript"}

    def log_message(self, *_):
        pass


@contextlib.contextmanager
def served(folder):
    """The folder from a server on this machine; its address."""
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=folder)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()


def playwright():
    """A folder whose node_modules hold what drives Chromium."""
    folder = os.path.join(BUILD, "web-tests")
    if os.path.isdir(os.path.join(folder, "node_modules", "playwright-core")):
        return folder
    os.makedirs(folder, exist_ok=True)
    done = npm(folder, "install", "--prefix", folder, "playwright-core@1")
    if done.returncode != 0:
        skip("npm could not fetch playwright-core: " + (done.stderr.strip().splitlines() or ["?"])[-1])
    return folder


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
