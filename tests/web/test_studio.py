#!/usr/bin/env python3
"""test_studio.py [ZIP]: the studio, opened from disk in Chromium without a network: what is dropped becomes a character that walks, is shaped, undone and
taken away with the bytes of this system's program; broken files are refused in the program's words. Without a package it is the one in build/packages, if
there is one. Pictures go to BUILD/web-pictures."""
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

import web_files

EXAMPLES = os.path.join(web_files.SOURCE, "examples")
MOST_MB = 4  # to the first picture


def native(folder):
    """What this system's program makes of the same files, and what it says."""
    def call(*words):
        return subprocess.run([web_files.SBFMT, *words], cwd=folder, capture_output=True, text=True, check=False, env={**os.environ, "SBFMT_WEB": web_files.PACKAGE})
    said = call("convert", "pup.glb", "-o", "pup.sbf").stderr
    call("pack", "pup.sbf", "-o", "plain.sbfz")
    call("build", "pup.sbf", "--material", "muscle", "-o", "built.sbf")
    os.replace(os.path.join(folder, "built.sbf"), os.path.join(folder, "pup.sbf"))
    for kind in ("sbfz", "glb"):
        call("pack", "pup.sbf", "-o", f"made.{kind}")
    call("export", "pup.sbf", "-o", "made.html")
    call("convert", "lizard.obj", "--rig", "lizard.glb", "-o", "lizard.sbf")
    call("pack", "lizard.sbf", "-o", "lizard.sbfz")
    refused = call("convert", "broken.glb", "-o", "none.sbf").stderr
    return {"findings": said.splitlines(), "refused": re.sub(r"^sbfmt \w+: \w+: ", "", refused.splitlines()[-1]),
            "made": {"sbf": "pup.sbf", "sbfz": "made.sbfz", "glb": "made.glb", "html": "made.html"}}


def unpack(given, folder):
    """The studio of the given package, or of the one in build/packages."""
    made = given or sorted(glob.glob(os.path.join(web_files.SOURCE, "build", "packages", "sbfmt-studio-*.zip")))
    if not made:
        web_files.skip("no studio was made: ./run package studio")
    unpacked = os.path.join(folder, "unpacked with spaces, ü")
    with zipfile.ZipFile(made[0]) as archive:
        archive.extractall(unpacked)
    return os.path.join(unpacked, "sbfmt-studio")


def first_picture(folder):
    """Bytes that are read before something is seen, as they lie on disk: the parts hold what is compressed already."""
    return sum(os.path.getsize(os.path.join(folder, name)) for name in ("index.html", "parts/runtime.js", "parts/first.js"))


def main():
    web_files.need("node", "npm", "chromium")
    modules = web_files.playwright()
    pictures = os.path.join(web_files.BUILD, "web-pictures")
    os.makedirs(pictures, exist_ok=True)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "studio_in_chromium.mjs")
    with tempfile.TemporaryDirectory() as folder:
        studio = unpack(sys.argv[1:], folder)
        sources = os.path.join(folder, "sources")
        os.mkdir(sources)
        for name in ("pup/pup.glb", "koi/koi.glb", "lizard/lizard.obj", "lizard/lizard.mtl", "lizard/lizard.glb"):
            shutil.copy(os.path.join(EXAMPLES, name), sources)
        web_files.write(sources, "broken.glb", "glTF and nothing else")
        wanted = native(sources)
        with web_files.served(studio) as address:
            reported = web_files.run("node", script, modules, os.path.join(studio, "index.html"), pictures,
                                     json.dumps({**wanted, "folder": sources, "address": address}))
        found = json.loads(reported.splitlines()[-1])
        size = first_picture(studio) / 1e6
    print(f"{size:.1f} MB to the first picture; {found['seconds']}")
    if size > MOST_MB:
        found["faults"].append(f"{size:.2f} MB are read before something is seen")
    if found["faults"]:
        sys.exit("\n".join(found["faults"]))


if __name__ == "__main__":
    main()
