"""Embedded vertices of converted characters: bounded weights, and every vertex at rest where its mesh has it."""

import os
import xml.etree.ElementTree as ElementTree

from bundle_file import numbers, rows
from sbfmt_program import ROOT, ProgramTest, convert_once, main, shared

LEAST, MOST, ROUNDING = -0.5, 1.5, 1e-3
OFF = 2e-5  # of the mesh's size
EXAMPLES = ("calf", "caterpillar", "dragon", "koi", "pup", "snake", "spider", "yeti")
# A rig with swords and wheels, skins, objects on bones, a mesh without a rig, and one with a vertex in no polygon.
SHARED = (("fox", "fox.glb"), ("greenman", "greenman.glb"), ("spider", "spider.glb"), ("snake", "snake.glb"),
          ("lizard", "lizart.glb"), ("lizard", "liz.obj"), ("kenney-fbx", "kenney_character.fbx"), ("walk-dae", "walk.dae"),
          ("bunny", "bunny_902.obj"), ("sausage", "sausage_blender_7400.fbx"), ("lizard-props", "icosphere.obj"))


class Mesh:
    def __init__(self, element):
        mesh = element.find("polygon_mesh")
        self.positions = rows(numbers(mesh, "positions"), 3)
        self.seen = set(map(int, numbers(mesh, "polygon_points"))) or set(range(len(self.positions)))
        self.size = max((max(c) - min(c) for c in zip(*self.positions)), default=0)


def embedded(root):
    """(mesh, vertex, weights, position by the embedding) of every item of every level."""
    meshes = {mesh.get("id"): Mesh(mesh) for mesh in root.iter("render_mesh")}
    for body in root.iter("soft_body"):
        for level in body.iter("level"):
            points = rows(numbers(level, "positions"), 3)
            for embedding in level.iter("embedding"):
                mesh = meshes[embedding.get("render_mesh")] if embedding.get("render_mesh") else Mesh(body)
                corners = rows(list(map(int, numbers(embedding, "points"))), 4)
                vertices = list(map(int, numbers(embedding, "vertices"))) or range(len(corners))
                for vertex, four, weights in zip(vertices, corners, rows(numbers(embedding, "weights"), 4)):
                    yield mesh, vertex, weights, tuple(sum(w * points[p][k] for p, w in zip(four, weights)) for k in range(3))


class EmbeddedVertices(ProgramTest):
    def check(self, path):
        self.check_bundle(path)
        self.assertGreater(self.check_bundle(path, "--soft", "*"), 0)

    def check_bundle(self, path, *options):
        bundle = convert_once(self.class_folder.name, "".join(options).replace("*", "all") + os.path.basename(path) + ".sbf", path,
                              "--budget", "none", *options)
        worst = far = items = 0
        for mesh, vertex, weights, at in embedded(ElementTree.parse(bundle).getroot()):
            items += 1
            far = max(far, LEAST - min(weights), max(weights) - MOST)
            off = max(abs(a - b) for a, b in zip(at, mesh.positions[vertex])) / mesh.size
            if vertex in mesh.seen:
                worst = max(worst, off)
        self.assertLess(far, ROUNDING)
        self.assertLess(worst, OFF)
        return items

    def test_examples(self):
        for name in EXAMPLES:
            path = os.path.join(ROOT, "examples", name, name + ".glb")
            with self.subTest(name):
                self.check(path)

    def test_characters_of_others(self):
        for folder, name in SHARED:
            with self.subTest(name):
                if not os.path.exists(shared(folder, name)):
                    self.skipTest(f"{name} is not there")
                self.check(shared(folder, name))


if __name__ == "__main__":
    main()
