#!/usr/bin/env python3
"""The page that `sbfmt export -o PAGE.html` writes, opened from disk in Chromium without a network: it is drawn, ends in
the same state as the program, walks by its keys, is dragged, is hit by balls, can be worked by the keyboard alone, shows other
files that are opened or dropped, is read by night, and fits its window. Pictures go to BUILD/web-pictures. Playwright's core is fetched by npm into BUILD/web-tests."""
import json
import os
import re
import subprocess
import sys
import tempfile

import web_files

FRAMES, DRIVE, GROUND = 600, (0.3, 0.2), {"kind": "noise", "height": 0.1, "seed": 5}


def check_missing(path, folder):
    """Without the page's parts export reports it, with the status of a system error, and writes nothing."""
    out = os.path.join(folder, "none.html")
    done = subprocess.run([web_files.SBFMT, "export", path, "-o", out], capture_output=True, text=True, check=False,
                          env={**os.environ, "SBFMT_WEB": folder})
    if done.returncode != 2 or "EXPORT_PAGE_MISSING" not in done.stderr or os.path.exists(out):
        sys.exit(f"without the page's parts: status {done.returncode}, {done.stderr}")


def main():
    web_files.need("node", "npm", "chromium")
    modules = web_files.playwright()
    pictures = os.path.join(web_files.BUILD, "web-pictures")
    os.makedirs(pictures, exist_ok=True)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "page_in_chromium.mjs")
    with tempfile.TemporaryDirectory() as folder:
        bundles = web_files.bundles(folder)
        lizard = bundles["lizard"]
        page, other = os.path.join(folder, "lizard.html"), os.path.join(folder, "figure.glb")
        web_files.run(web_files.SBFMT, "pack", bundles["figure"], "-o", other)
        web_files.run(web_files.SBFMT, "export", lizard, "-o", page)
        check_missing(lizard, folder)
        with open(page, encoding="utf-8") as stream:
            text = stream.read()
        outside = re.findall(r'(?:src|href)\s*=\s*"(?!data:)[^"]*"|url\((?!["\']?data:)', text)
        if outside or "{{" in text:
            sys.exit(f"the page is not whole: {outside[:5]}")
        reported = web_files.run("node", script, modules, page, pictures,
                             json.dumps({"frames": FRAMES, "drive": DRIVE, "ground": GROUND, "other": other,
                                         "text": os.path.join(folder, "lizard.sbf"), "dropped": lizard}))
        found = json.loads(reported.splitlines()[-1])
        native = web_files.native(lizard, "--seconds", FRAMES / 60, "--drive", "0.3,0.2", "--ground", "noise:0.1,5")
    print(f"{len(text) / 1e6:.1f} MB; {found['us']:.0f} us a step, in this run alone; {found['hash']}")
    if found["hash"] != native["state_hash"]:
        found["faults"].append(f"after {FRAMES} frames {found['hash']}, natively {native['state_hash']}")
    if found["faults"]:
        sys.exit("\n".join(found["faults"]))


if __name__ == "__main__":
    main()
