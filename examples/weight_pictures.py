#!/usr/bin/env python3
"""Draws docs/media/way-1.webp to way-5.webp, an example of each method by which an OBJ gets its weights from a rig
(docs/converting.md). Needs cwebp (Debian: webp).

    python3 examples/weight_pictures.py build/release/tools/sbfmt
"""

import os
import subprocess
import sys
import tempfile

FOLDER = os.path.dirname(os.path.abspath(__file__))
MEDIA = os.path.join(FOLDER, os.pardir, "docs", "media")
sys.path.insert(0, os.path.join(FOLDER, os.pardir, "tests", "e2e"))

import obj_variants as variants  # noqa: E402
from bundle_file import Bundle  # noqa: E402
from bvh_file import write_bvh  # noqa: E402

SIZE = "300x210"


def example(name):
    return os.path.join(FOLDER, name, name + ".glb")


class Drawing:
    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, *arguments):
        subprocess.run([self.program, *arguments], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def mesh(self, name):
        """An example's mesh as an OBJ without bones."""
        self.run("convert", example(name), "--no-build", "-o", self.path(name + ".sbf"))
        self.run("export", self.path(name + ".sbf"), "-o", self.path(name + ".obj"))
        return variants.read(self.path(name + ".obj"))

    def draw(self, method, obj, rig, view, *shown, weights=()):
        self.run("convert", obj, "--rig", rig, *weights, "-o", self.path("way.sbf"))
        self.run("render", self.path("way.sbf"), "-o", self.path("way.png"), "--size", SIZE, "--view", view, *shown)
        out = os.path.join(MEDIA, f"way-{method}.webp")
        subprocess.run(["cwebp", "-quiet", "-q", "75", self.path("way.png"), "-o", out], check=True)

    def named(self):
        self.draw(1, os.path.join(FOLDER, "lizard", "lizard.obj"), example("lizard"), "55,20", "--show", "surface,hulls")

    def match(self):
        obj = self.mesh("dragon")
        variants.write(variants.shuffled(variants.moved(obj, 0.01, ("x", "-z", "y"))), self.path("in.obj"), 6)
        self.draw(2, self.path("in.obj"), example("dragon"), "55,15")

    def transfer(self):
        """The calf at half its points, with a saddle."""
        obj = variants.simplified(self.mesh("calf"))
        top = max(p[1] for p in obj.points if -0.2 < p[2] < 0.1)
        base = len(obj.points)
        for z in range(5):
            for x in range(-4, 5):
                obj.points += [(0.06 * x, top + 0.04 - 0.3 * (x / 4) ** 4 + 0.06 * (z in (0, 4)), -0.2 + 0.075 * z)]
                obj.origins += [[]]
        for z in range(4):
            for x in range(8):
                corner = base + 9 * z + x
                obj.faces.append(("saddle", None, [(i, None, None) for i in (corner, corner + 9, corner + 10, corner + 1)]))
        variants.write(obj, self.path("in.obj"))
        self.draw(3, self.path("in.obj"), example("calf"), "60,20")

    def compute(self):
        """The yeti's mesh with a motion capture file of its bones."""
        variants.write(self.mesh("yeti"), self.path("in.obj"))
        bundle = Bundle(self.path("yeti.sbf"))
        names = bundle.bone_names()
        write_bvh(self.path("bones.bvh"),
                  [(names[i], None if parent is None else names[parent], [row[3] for row in bundle.rest[i]])
                   for i, parent in enumerate(bundle.parents)])
        self.draw(4, self.path("in.obj"), self.path("bones.bvh"), "35,10", "--show", "surface,bones")

    def from_file(self):
        self.mesh("pup")
        self.run("export", self.path("pup.sbf"), "-o", self.path("weights.csv"))
        self.draw(5, self.path("pup.obj"), example("pup"), "50,15", weights=("--weights", self.path("weights.csv")))


def main():
    if len(sys.argv) != 2:
        sys.exit("weight_pictures.py: give the program: ways.py build/release/tools/sbfmt")
    with tempfile.TemporaryDirectory() as folder:
        drawing = Drawing(os.path.realpath(sys.argv[1]), folder)
        for method in (drawing.named, drawing.match, drawing.transfer, drawing.compute, drawing.from_file):
            method()


if __name__ == "__main__":
    main()
