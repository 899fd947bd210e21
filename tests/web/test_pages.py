#!/usr/bin/env python3
"""Opens pages of different characters in Chromium: with legs and without, a chain, a soft body without bones, one that
hops, several levels, a skin with an image. Pictures go to BUILD/web-pictures."""
import json
import os
import sys
import tempfile

import web_files

sys.path.insert(0, os.path.join(web_files.SOURCE, "tests", "e2e"))
import textured_box  # noqa: E402

FRAMES = 120
# example: speed (m/s)
EXAMPLES = {"spider": 0.1, "snake": 0.3, "pudding": 0.2, "yeti": 0.3}
RED, BLUE = (190, 20, 20), (20, 20, 190)  # upper and lower half of the image

def sources(folder):
    """Names, files, and special settings: levels, the image's colour, the drive."""
    for name, speed in EXAMPLES.items():
        made = os.path.join(folder, name + ".sbf")
        web_files.run(web_files.SBFMT, "convert", os.path.join(web_files.SOURCE, "examples", name, name + ".glb"), "-o", made)
        yield {"name": name, "file": made, "drive": speed, "levels": 1}
    yield {"name": "flesh", "file": os.path.join(web_files.SOURCE, "examples", "bones", "flesh.sbf"), "drive": 0, "levels": 1}
    box = os.path.join(folder, "box.sbf")
    web_files.run(web_files.SBFMT, "convert", textured_box.write(folder, textured_box.png_of(64, 64, RED, BLUE)), "-o", box)
    several = os.path.join(folder, "several.sbf")
    web_files.run(web_files.SBFMT, "build", box, "-o", several, "--levels", "3", "--springs", "tetrahedra", "--elements", "3000")
    yield {"name": "box", "file": several, "drive": 0, "levels": 3, "colors": (RED, BLUE)}


def main():
    web_files.need("node", "npm", "chromium")
    modules = web_files.playwright()
    pictures = os.path.join(web_files.BUILD, "web-pictures")
    os.makedirs(pictures, exist_ok=True)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "pages_in_chromium.mjs")
    with tempfile.TemporaryDirectory() as folder:
        pages, native = [], {}
        for one in sources(folder):
            page = os.path.join(folder, one["name"] + ".html")
            web_files.run(web_files.SBFMT, "export", one["file"], "-o", page)
            pages.append({**one, "page": page, "frames": FRAMES})
            native[one["name"]] = web_files.native(one["file"], "--seconds", FRAMES / 60, "--drive", f"{one['drive']},0")["state_hash"]
        found = json.loads(web_files.run("node", script, modules, pictures, json.dumps(pages)).splitlines()[-1])
    found["faults"] += [f"{name}: {found['hashes'].get(name)}, natively {there}" for name, there in native.items()
                        if found["hashes"].get(name) != there]
    if found["faults"]:
        sys.exit("\n".join(found["faults"]))
    print(f"{len(native)} characters, the same states as natively")


if __name__ == "__main__":
    main()
