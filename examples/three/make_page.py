#!/usr/bin/env python3
"""Writes one HTML file with a character, three.js and the runtime. It opens from disk, without a server and without a network.

Browsers do not load module files from disk. The page therefore has every module as a data: URL in an import map. A module in a data:
URL cannot import './other.js', so each module is known by its path below node_modules, and relative imports are replaced by these names.
"""
import argparse
import base64
import html
import json
import os
import posixpath
import re
import struct
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
EXTENSION = "SBF_soft_body"
PACKAGES = "three@0.170 and the npm package of sbfmt, as README.md of this example shows"
# Names that scene.js and the modules import, and their files below node_modules.
ENTRIES = {
    "three": "three/build/three.module.js",
    "three/addons/loaders/GLTFLoader.js": "three/examples/jsm/loaders/GLTFLoader.js",
    "three/addons/controls/OrbitControls.js": "three/examples/jsm/controls/OrbitControls.js",
    "sbfmt": "sbfmt/sbfmt.js",
    "sbfmt/three": "sbfmt/sbfmt-three.js",
}
IMPORT = re.compile(r"""(\bfrom\s*|\bimport\s*)(["'])(\.{1,2}/[^"']+)\2""")


class PageError(Exception):
    pass


def read(path, advice):
    try:
        with open(path, "rb") as stream:
            return stream.read()
    except OSError as error:
        raise PageError(f"{path}: {error.strerror}: {advice}") from error


class Modules:
    """The modules that the entries need, by the names that the page imports them by."""

    def __init__(self, folder):
        self.folder = folder
        self.texts = {}
        for name, path in ENTRIES.items():
            self.add(name, path)

    def read(self, path):
        advice = f"install {PACKAGES}; --modules names another folder"
        return read(os.path.join(self.folder, *path.split("/")), advice)

    def add(self, name, path):
        if name in self.texts:
            return
        self.texts[name] = ""  # modules may import each other

        def by_name(found):
            other = posixpath.normpath(posixpath.join(posixpath.dirname(path), found[3]))
            self.add(other, other)
            return f"{found[1]}{found[2]}{other}{found[2]}"
        self.texts[name] = IMPORT.sub(by_name, self.read(path).decode("utf-8"))

    def import_map(self):
        return json.dumps({"imports": {name: "data:text/javascript;base64," + base64.b64encode(text.encode("utf-8")).decode("ascii")
                                       for name, text in self.texts.items()}}, indent=0)

    def licenses(self):
        """Both packages may be passed on with their licenses."""
        texts = [f"{name}:\n{self.read(name + '/LICENSE').decode('utf-8').strip()}" for name in ("three", "sbfmt")]
        return "\n\n".join(texts).replace("--", "- -")  # a comment of HTML ends with two


def character(path):
    """The bytes of a .glb with soft bodies."""
    advice = f"make it with `sbfmt convert` or `sbfmt pack`, -o {os.path.basename(path)}"
    data = read(path, advice)
    if len(data) < 20 or data[:4] != b"glTF":
        raise PageError(f"{path}: not a .glb: {advice}")
    size, = struct.unpack_from("<I", data, 12)
    try:
        document = json.loads(data[20:20 + size])
    except ValueError as error:
        raise PageError(f"{path}: its JSON cannot be read: {error}: {advice}") from error
    if EXTENSION not in document.get("extensions", {}):
        raise PageError(f"{path}: it has no soft bodies ({EXTENSION}): {advice}")
    return data


def page(path, folder):
    data, modules = character(path), Modules(folder)
    parts = {
        "title": html.escape(os.path.splitext(os.path.basename(path))[0]),
        "licenses": modules.licenses(),
        "imports": modules.import_map(),
        "character": base64.b64encode(data).decode("ascii"),
        "library": base64.b64encode(modules.read("sbfmt/sbfmt.wasm")).decode("ascii"),
        "scene": read(os.path.join(HERE, "scene.js"), "it is part of this example").decode("utf-8"),
    }
    template = read(os.path.join(HERE, "page.html"), "it is part of this example").decode("utf-8")
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], template)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("character", metavar="CHARACTER.glb", help="with soft bodies, as `sbfmt convert -o CHARACTER.glb` writes it")
    parser.add_argument("page", metavar="PAGE.html", help="file to write")
    parser.add_argument("--modules", metavar="FOLDER",
                        help="node_modules with three and sbfmt (default: node_modules beside PAGE.html)")
    given = parser.parse_args()
    folder = given.modules or os.path.join(os.path.dirname(given.page), "node_modules")
    try:
        text = page(given.character, folder)
        with open(given.page, "w", encoding="utf-8", newline="\n") as stream:
            stream.write(text)
    except PageError as error:
        sys.exit(f"make_page.py: {error}")
    except OSError as error:
        sys.exit(f"make_page.py: {given.page}: {error.strerror}: choose a file that can be written")
    print(f"{given.page}: {len(text.encode('utf-8')) / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
