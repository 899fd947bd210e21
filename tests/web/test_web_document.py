#!/usr/bin/env python3
"""Tests docs/web.md: its commands work, and its programs run unchanged and print the documented output, under node or in Chromium
from a server. Pictures go to BUILD/web-pictures."""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile

import web_files

DOCUMENT = os.path.join(web_files.SOURCE, "docs", "web.md")
# What the first program for node prints, and what each that goes on from it does.
FIRST = r"walked 2\.\d\d m"
GOES_ON = (r"[1-9]\d{2,} vertices, [1-9]\d{2,} triangles in \d+ materials", r"SbfmtError, [A-Z_]+: .{20,}", r"over the hills by 1\.\d\d m",
           r"soft, bones, bones", r"\{ ?count: 300, frames: 300, checks: [1-9]\d*, differs: false, differsAt: null ?\}\s*true")
PAGES = ("index.html", "three.html")
MOST_LINES = 9  # under ten lines of the user's own code for node


def blocks(language):
    with open(DOCUMENT, encoding="utf-8") as stream:
        text = stream.read()
    return [(text[:found.start()].count("\n") + 1, found[1]) for found in re.finditer(rf"^```{language}\n(.*?)^```$", text, re.M | re.S)]


def run_commands(folder):
    """Those of the document, in a folder with the examples."""
    os.symlink(os.path.join(web_files.SOURCE, "examples"), os.path.join(folder, "examples"))
    for line, text in blocks("sh"):
        for command in text.splitlines():
            words = shlex.split(command, comments=True)
            if words[0] != "sbfmt":
                sys.exit(f"{DOCUMENT}:{line}: {command}: who tests that?")
            web_files.run(web_files.SBFMT, *words[1:], cwd=folder)


def run_program(folder, line, program):
    web_files.write(folder, "walk.mjs", program)
    done = subprocess.run(["node", "walk.mjs"], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0 or done.stderr:
        sys.exit(f"{DOCUMENT}:{line}: {done.stderr or done.returncode}")
    return done.stdout


def main():
    web_files.need("node", "npm", "chromium")
    modules = web_files.playwright()
    pictures = os.path.join(web_files.BUILD, "web-pictures")
    os.makedirs(pictures, exist_ok=True)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "document_in_chromium.mjs")
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        run_commands(folder)
        web_files.fresh_project(folder, web_files.tarball())
        (first_line, first), *others = blocks("js")
        written = [line for line in first.splitlines() if line.strip()]
        if len(written) > MOST_LINES:
            faults.append(f"{DOCUMENT}:{first_line}: {len(written)} lines for a character that walks")
        if len(others) != len(GOES_ON):
            faults.append(f"{DOCUMENT}: {len(others)} programs go on from the first, {len(GOES_ON)} are known here")
        for (line, piece), expected in zip([(first_line, ""), *others], (FIRST, *GOES_ON)):
            reported = run_program(folder, line, first + piece)
            if not re.fullmatch(FIRST + r"\n" + (expected + r"\n" if piece else ""), reported, re.S):
                faults.append(f"{DOCUMENT}:{line}: it prints {reported!r}, not {expected}")
        if web_files.npm(folder, "install", "three@0.170").returncode != 0:
            web_files.skip("npm could not fetch three; what runs under node is good")
        pages = blocks("html")
        if len(pages) != len(PAGES):
            faults.append(f"{DOCUMENT}: {len(pages)} pages, {len(PAGES)} are known here")
        web_files.write(folder, "favicon.ico", "")  # which browsers ask every server for
        for name, (_, text) in zip(PAGES, pages):
            web_files.write(folder, name, text)
        with web_files.served(folder) as address:
            faults += json.loads(web_files.run("node", script, modules, address, pictures).splitlines()[-1])["faults"]
    if faults:
        sys.exit("\n".join(faults))
    print(f"{1 + len(others)} programs and {len(pages)} pages do what they say")


if __name__ == "__main__":
    main()
