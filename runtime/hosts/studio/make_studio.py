#!/usr/bin/env python3
"""Puts the studio together: a folder that every static host serves, and that opens from disk by its index.html.

Usage: make_studio.py --web BUILD/web --worker BUILD --program SBFMT --out DIR

--web: the folder web of a build tree. --worker: a build tree of Emscripten, with worker/. --program: the program of this system,
which converts the character that is shown at first. The output folder is replaced."""
import argparse
import base64
import gzip
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
EXAMPLES = os.path.join(HERE, "..", "..", "..", "examples")
FIRST, OTHERS = "pup", ("pup", "koi", "snake", "spider")
# Modules in the order of their imports; those of the exported page before those of the studio.
OWN = ("page", "slider", "bundle", "parts", "program", "recipe", "chart", "take", "film", "drop", "shape", "gamepad", "stage")
SHARED = ("viewer_draw.js", "viewer_stage.js", "viewer_hands.js", "viewer_show.js")


def read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


def text(*path):
    return read(*path).decode()


def module(*path):
    """A module without the lines that import others, which stand before it in the page."""
    return "\n".join(line for line in text(*path).splitlines() if not line.startswith("import {"))


def write(out, name, content):
    with open(os.path.join(out, name), "w", encoding="utf-8", newline="\n") as file:
        file.write(content)


def write_part(out, name, texts, files):
    """parts/NAME.js, see studio_parts.js."""
    packed = {key: base64.b64encode(gzip.compress(content, 9, mtime=0)).decode() for key, content in files.items()}
    write(out, f"parts/{name}.js", f"studioPart({json.dumps(name)}, {json.dumps(texts)}, {json.dumps(packed)});\n")


def modules_of(web):
    """The scripts of the runtime in the order of the exported page."""
    return re.findall(r"{{file (modules/\w+\.js)}}", text(web, "viewer.html"))


def make_page(web, out):
    scripts = [module(web, name) for name in modules_of(web) + list(SHARED)]
    scripts += [module(HERE, f"studio_{name}.js") for name in OWN] + [module(HERE, "studio.js"), "startStudio();"]
    page = text(HERE, "index.html").replace("{{file viewer.css}}", text(web, "viewer.css")).replace("{{file studio.css}}", text(HERE, "studio.css"))
    write(out, "index.html", page.replace("{{modules}}", "\n".join(scripts)))


def make_parts(web, worker, program, out):
    os.mkdir(os.path.join(out, "parts"))
    write_part(out, "runtime", {}, {"sbfmt.wasm": read(web, "sbfmt.wasm")})
    page = {"viewer.html": text(web, "viewer.html")}
    for name in re.findall(r"{{file ([\w/.]+)}}", page["viewer.html"]):
        page[name] = text(web, name)
    write_part(out, "page", page, {})
    write_part(out, "program", {"sbfmt": text(worker, "worker", "sbfmt-worker.js"), "import": text(worker, "worker", "sbfmt-import-worker.js"),
                                "worker": text(HERE, "program_worker.js")},
               {"sbfmt.js": read(worker, "worker", "sbfmt-worker.wasm"), "sbfmt-import.js": read(worker, "worker", "sbfmt-import-worker.wasm")})
    for name in OTHERS:
        write_part(out, f"example_{name}_glb", {}, {f"{name}.glb": read(EXAMPLES, name, f"{name}.glb")})
    with tempfile.TemporaryDirectory() as folder:
        made = os.path.join(folder, f"{FIRST}.sbfz")
        done = subprocess.run([program, "convert", os.path.join(EXAMPLES, FIRST, f"{FIRST}.glb"), "-o", made], capture_output=True, text=True, check=False)
        if done.returncode:
            sys.exit(done.stderr)
        write_part(out, "first", {}, {f"{FIRST}.sbfz": read(made)})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("web", "worker", "program", "out"):
        parser.add_argument(f"--{name}", required=True)
    wanted = parser.parse_args()
    shutil.rmtree(wanted.out, ignore_errors=True)
    os.makedirs(wanted.out)
    make_page(wanted.web, wanted.out)
    make_parts(wanted.web, wanted.worker, wanted.program, wanted.out)
    shutil.copyfile(os.path.join(HERE, "..", "..", "..", "LICENSE"), os.path.join(wanted.out, "LICENSE"))


main()
