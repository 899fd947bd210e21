#!/usr/bin/env python3
"""examples/three: the page that make_page.py writes, opened from disk in Chromium without a network, made by the commands of
its README. The character is drawn, walks on the ground, is pushed and pulled, and ends in the program's state. Pictures go to BUILD/web-pictures."""
import json
import os
import re
import subprocess
import sys
import tempfile

import web_files

EXAMPLE = os.path.join(web_files.SOURCE, "examples", "three")
SCRIPT = os.path.join(EXAMPLE, "make_page.py")


def make_page(*words):
    return subprocess.run([sys.executable, SCRIPT, *words], capture_output=True, text=True, check=False)


def check_errors(folder, glb):
    """What cannot be made is refused with what to do, and nothing is written."""
    out = os.path.join(folder, "none.html")
    pup = os.path.join(web_files.SOURCE, "examples", "pup", "pup.glb")
    web_files.write(folder, "text.glb", "no character, but long enough")
    web_files.write(folder, "short.glb", "glTF")
    with open(glb, "rb") as whole, open(os.path.join(folder, "cut.glb"), "wb") as cut:
        cut.write(whole.read(1000))
    for character, said in ((os.path.join(folder, "text.glb"), "not a .glb"), (os.path.join(folder, "short.glb"), "not a .glb"),
                            (os.path.join(folder, "cut.glb"), "its JSON"), (os.path.join(folder, "absent.glb"), "No such file"),
                            (pup, "no soft bodies")):
        done = make_page(character, out)
        if done.returncode != 1 or said not in done.stderr or "sbfmt convert" not in done.stderr or os.path.exists(out):
            sys.exit(f"{character}: status {done.returncode}, {done.stderr}")
    done = make_page(glb, out, "--modules", os.path.join(folder, "none", "node_modules"))
    if done.returncode != 1 or "README.md" not in done.stderr or os.path.exists(out):
        sys.exit(f"without packages: status {done.returncode}, {done.stderr}")


def commands(folder):
    """Those of the README from the packing on, with this build, in a folder; the last makes the page."""
    with open(os.path.join(EXAMPLE, "README.md"), encoding="utf-8") as stream:
        lines = re.search(r"```sh\n(.*?)```", stream.read(), re.DOTALL)[1].splitlines()
    if lines[:2] != ["./run build", "cmake --build build/release --target sbfmt-npm"]:
        sys.exit(f"README.md begins with {lines[:2]}")
    return [line.replace("$PWD/build/release", web_files.BUILD).replace("build/release", web_files.BUILD).replace("out/three", folder)
            for line in lines[2:]]


def main():
    web_files.need("node", "npm", "chromium")
    modules = web_files.playwright()
    pictures = os.path.join(web_files.BUILD, "web-pictures")
    os.makedirs(pictures, exist_ok=True)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "three_page_in_chromium.mjs")
    web_files.tarball()
    with tempfile.TemporaryDirectory() as folder:
        for line in commands(folder):
            done = subprocess.run(["sh", "-c", line], cwd=web_files.SOURCE, capture_output=True, text=True, check=False)
            if done.returncode != 0 and line.startswith("npm"):
                web_files.skip("npm could not fetch three: " + (done.stderr.strip().splitlines() or ["?"])[-1])
            if done.returncode != 0:
                sys.exit(f"{line}\n{done.stderr}")
        glb, alone = os.path.join(folder, "pup.glb"), os.path.join(folder, "alone", "the pup, ü.html")
        os.mkdir(os.path.dirname(alone))
        os.rename(os.path.join(folder, "pup.html"), alone)
        check_errors(folder, glb)
        told = web_files.run("node", script, modules, alone, pictures)
        found = json.loads(told.splitlines()[-1])
        there = web_files.native(glb, "--seconds", "2", "--drive", "0.3,0.2")["state_hash"]
    if found["hash"] != there:
        found["faults"].append(f"in the page {found['hash']}, natively {there}")
    if found["faults"]:
        sys.exit("\n".join(found["faults"]))


if __name__ == "__main__":
    main()
