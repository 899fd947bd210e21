"""Where a skinned glTF stands: a vertex is drawn at the sum of weight * joint's world * inverse bind, and the transform of
the mesh's own node is not in it. Files as Blender and other exporters write them, saved in the bind pose or in a frame of a
clip, and every glTF of the shared data."""

import glob
import math
import os
import unittest
import xml.etree.ElementTree as ElementTree

from bundle_file import apply, inverse, matrix_of, numbers, product, rows
from glb_file import Glb
from play_files import blender, needs_blender, needs_node, node
from sbfmt_program import SOURCE_PARTS, ProgramTest, main, shared
from skinned_glb import SkinnedGlb, box, inverse_binds, moved, tube

H = math.sqrt(0.5)
ARMATURE = matrix_of(rotation=(H, 0, 0, H), scale=(0.01, 0.01, 0.01))  # as a centimetre file with +Z up comes in
SCENE = matrix_of()


def turned(axis, degrees):
    half = math.radians(degrees) / 2
    return matrix_of(rotation=tuple(math.sin(half) * (k == axis) for k in range(3)) + (math.cos(half),))


def placed_points(path):
    """(mesh name, source vertex of each point, points) of a bundle's render meshes."""
    for mesh in ElementTree.parse(path).getroot().iter("render_mesh"):
        sources = [int(n) for n in numbers(mesh, "source_points")]
        yield mesh.get("name"), sources, rows(numbers(mesh.find("polygon_mesh"), "positions"), 3)


def spread(points):
    """Middle and mean distance from it."""
    middle = [sum(p[k] for p in points) / len(points) for k in range(3)]
    return middle, sum(math.dist(p, middle) for p in points) / len(points)


def quarter(points, count):
    for _ in range(count):
        points = [(p[2], p[1], -p[0]) for p in points]
    return points


class Character:
    """An upright body of 1.8 m on three joints, one above the other, in an armature."""

    def __init__(self, pose=0, armature=ARMATURE):
        self.file = SkinnedGlb()
        self.armature = armature
        self.holder = self.file.node("Armature", matrix=armature)
        self.binds, self.worlds, self.joints = [], [], []
        bind, world, parent = armature, armature, self.holder
        to_armature = inverse(armature)
        for i, height in enumerate((0.0, 0.6, 1.2)):
            below = 0.6 if i else 0.0
            step = product(product(to_armature, matrix_of((0, below, 0))), armature)  # 0.6 m in the armature's units
            bind = product(bind, step)
            local = product(step, turned(i % 3, pose))
            world = product(world, local)
            parent = self.file.node(f"bone{i}", parent, local)
            self.joints.append(parent)
            self.binds.append(bind)
            self.worlds.append(world)
        points, self.triangles = tube(0, 1.8, 0.2)
        self.points = [(p[0], p[1], p[2] + (0.1 if p[1] > 1.7 else 0)) for p in points]

    def add(self, name, space, parent=None, node=None, points=None, triangles=None, joints=(0, 1, 2)):
        """A skinned mesh whose points, in the scene at bind, are stored in `space`."""
        points = self.points if points is None else points
        triangles = self.triangles if triangles is None else triangles
        stored = moved(points, inverse(space))
        bones, weights = [], []
        for p in points:
            at = min(max(p[1] / 0.6 - 0.5, 0), len(joints) - 1)
            low = min(int(at), max(len(joints) - 2, 0))
            bones.append((low, min(low + 1, len(joints) - 1), 0, 0))
            weights.append((1 - (at - low), at - low, 0, 0))
        skin = self.file.skin([self.joints[j] for j in joints],
                              inverse_binds([self.binds[j] for j in joints], space))
        mesh = self.file.mesh(stored, triangles, bones, weights)
        self.file.node(name, parent, node, mesh=mesh, skin=skin)
        return points


def nearest_gap(points, others):
    """How far the worst of the points is from the nearest of the others."""
    return max(min(math.dist(p, o) for o in others) for p in points)


@needs_blender
class FilesOfBlender(ProgramTest):
    """Saved in the first frame, the bind pose, and in the eighth of a clip: every vertex stands as Blender has it at rest."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.made = blender("blender_armatures.py", cls.class_folder.name)

    def test_every_vertex_at_rest(self):
        for file, expected in self.made.items():
            with self.subTest(file):
                out = self.path("out.sbf")
                self.good("convert", os.path.join(self.class_folder.name, file), *SOURCE_PARTS, "-o", out)
                found = [p for _, _, points in placed_points(out) for p in points]
                rest = [tuple(p) for points in expected["rest"].values() for p in points]
                gaps = []
                for turned_by in (quarter(rest, count) for count in range(4)):
                    lift = min(p[1] for p in found) - min(p[1] for p in turned_by)
                    lifted = [(p[0], p[1] + lift, p[2]) for p in turned_by]
                    gaps.append(max(nearest_gap(found, lifted), nearest_gap(lifted, found)))
                self.assertLess(min(gaps), 2e-3)

    @needs_node
    def test_three_and_blender_draw_the_same(self):
        for file, expected in self.made.items():
            with self.subTest(file):
                path = os.path.join(self.class_folder.name, file)
                compare_with_three(self, path, self.path("bare.glb"))
                drawn = [p for points in drawn_in_order(Glb(path)) for p in points]
                self.assertLess(nearest_gap(drawn, [tuple(p) for points in expected["now"].values() for p in points]), 2e-3)


class BindSpace(ProgramTest):
    def placed(self, source):
        out = self.path("out.sbf")
        self.good("convert", source, *SOURCE_PARTS, "-o", out)
        return {name: (sources, points) for name, sources, points in placed_points(out)}

    def assert_placed(self, found, expected, size):
        """All are equal, except for the quarter rotation to +Z and the lift to the ground."""
        for count in range(4):
            turned_by = quarter(expected, count)
            lift = found[0][1] - turned_by[0][1]
            gap = max(math.dist(f, (e[0], e[1] + lift, e[2])) for f, e in zip(found, turned_by))
            if gap < 1e-3 * size:
                return
        self.fail(f"no vertex stands where it is drawn: {found[:3]} for {expected[:3]}")

    def check(self, character, **expected):
        path = character.file.write(self.path("in.glb"))
        found = self.placed(path)
        for name, points in expected.items():
            sources, at = found[name]
            self.assert_placed(at, [points[s] for s in sources], 1.8)

    def test_armature_scaled_and_turned(self):
        """Blender's exporter: vertices in the scene's space, joints and mesh below an armature of 0.01."""
        for pose in (0, 25):
            with self.subTest(pose=pose):
                c = Character(pose)
                self.check(c, body=c.add("body", SCENE, c.holder))

    def test_vertices_in_the_armatures_space(self):
        for pose in (0, 25):
            with self.subTest(pose=pose):
                c = Character(pose)
                self.check(c, body=c.add("body", c.armature, c.holder))

    def test_mesh_outside_the_armature(self):
        for pose in (0, 25):
            with self.subTest(pose=pose):
                c = Character(pose)
                away = matrix_of((7, -3, 5), (0, H, 0, H), (3, 3, 3))
                self.check(c, body=c.add("body", SCENE, None, away))

    def test_several_skins_on_one_skeleton(self):
        """Each with a space of its own; saved in a frame, they stay together as they were bound."""
        for pose in (0, 25):
            with self.subTest(pose=pose):
                c = Character(pose)
                hat, hat_triangles = box((-0.3, 1.7, -0.3), (0.3, 2.0, 0.3))
                self.check(c, body=c.add("body", SCENE, c.holder),
                           hat=c.add("hat", matrix_of((0, 1.7, 0), scale=(0.1, 0.1, 0.1)), None,
                                     matrix_of((9, 9, 9)), hat, hat_triangles, joints=(2,)))

    def test_one_bone_moved_alone(self):
        """Where most of the skin stands as it was bound, its space is known exactly."""
        c = Character(0, product(matrix_of((0, 0.3, 0)), turned(1, 30)))
        c.file.json["nodes"][c.joints[2]]["matrix"] = None
        del c.file.json["nodes"][c.joints[2]]["matrix"]
        c.file.json["nodes"][c.joints[2]].update(translation=[0, 0.6, 0], rotation=[0.6, 0, 0, 0.8])
        offset = matrix_of((0.4, 0.2, 0.1), (0, 0.6, 0, 0.8), (2, 2, 2))
        self.check(c, body=c.add("body", offset, None))


def compare_with_three(case, path, bare):
    """`bare`: where to write the file without its materials, whose images node cannot show."""
    file = SkinnedGlb.of(path)
    for key in ("materials", "textures", "images", "samplers", "animations"):
        file.json.pop(key, None)
    for mesh in file.json["meshes"]:
        for primitive in mesh["primitives"]:
            primitive.pop("material", None)
    file.write(bare)
    formula, three = drawn_in_order(Glb(bare)), node("three_gltf.mjs", bare)["meshes"]
    case.assertEqual([len(points) for points in formula], [len(mesh["now"]) for mesh in three])
    low, high = ([f(p[k] for points in formula for p in points if p) for k in range(3)] for f in (min, max))
    for points, mesh in zip(formula, three):
        off = max((math.dist(a, b) for a, b in zip(points, mesh["now"]) if a), default=0)
        case.assertLess(off, 1e-5 * math.dist(low, high), mesh["name"])


def drawn_in_order(file):
    """The vertices of each primitive as drawn, in the order in which a walk from the scene's roots meets them."""
    worlds, found = file.worlds({}, 0), []

    def walk(number):
        one = file.nodes[number]
        for primitive in file.json["meshes"][one["mesh"]]["primitives"] if "mesh" in one else ():
            alone = Glb.__new__(Glb)
            alone.__dict__.update(file.__dict__)
            alone.primitives = lambda: iter([(number, primitive)])
            if "skin" in one:
                found.append(alone.skinned(worlds))
            else:
                found.append([apply(worlds[number], p) for p in file.accessor(primitive["attributes"]["POSITION"])])
        for child in one.get("children", ()):
            walk(child)
    for root in file.json["scenes"][file.json.get("scene", 0)]["nodes"]:
        walk(root)
    return found


def shared_files():
    found = glob.glob(os.path.join(shared(".."), "**", "*.glb"), recursive=True)
    return sorted(p for p in found if os.path.join("data", "bad") not in p and any(
        "skin" in node for node in Glb(p).nodes) and "KHR_draco" not in str(Glb(p).json.get("extensionsRequired")))


@unittest.skipUnless(os.path.isdir(shared("..", "zoo")), "the characters of ../shared/zoo are not there")
class SharedFiles(ProgramTest):
    placed = BindSpace.placed
    assert_placed = BindSpace.assert_placed

    def shown(self, file):
        """Node name to the vertices as drawn, all primitives in order."""
        worlds, found = file.worlds({}, 0), {}
        for i, node in enumerate(file.nodes):
            if "skin" not in node:
                continue
            one = Glb.__new__(Glb)
            one.__dict__.update(file.__dict__)
            one.primitives = lambda i=i, node=node: ((i, p) for p in file.json["meshes"][node["mesh"]]["primitives"])
            found[node.get("name", file.json["meshes"][node["mesh"]].get("name"))] = one.skinned(worlds)
        return found

    def test_every_vertex(self):
        """Exactly, in a file saved in the bind pose; in a frame of a clip all of it has the size that is drawn."""
        for path in shared_files():
            with self.subTest(file=os.path.relpath(path, shared(".."))):
                out, drawn = self.path("out.sbf"), self.shown(Glb(path))
                posed = "in mid-motion" in self.good("convert", path, *SOURCE_PARTS, "-o", out).err
                pairs = [(p, drawn[name][s]) for name, sources, points in placed_points(out) if name in drawn
                         for p, s in zip(points, sources) if drawn[name][s]]
                self.assertTrue(pairs)
                every, expected = zip(*pairs)
                (_, size), (_, size_drawn) = spread(every), spread(expected)
                self.assertAlmostEqual(size / size_drawn, 1, delta=0.3 if posed else 1e-3)
                if not posed:
                    self.assert_placed(every, expected, size_drawn)

    @needs_node
    def test_three_draws_every_vertex_by_the_formula(self):
        """As saved, skinned or not: the cases above compare conversions with the formula of viewers."""
        for path in shared_files():
            with self.subTest(file=os.path.relpath(path, shared(".."))):
                compare_with_three(self, path, self.path("bare.glb"))

    def test_sizes_as_a_viewer_shows_them(self):
        for name, size in (("mannequiny", (1.641, 1.798, 0.316)), ("platformer_player", (1.678, 2.118, 0.636))):
            with self.subTest(file=name):
                found = self.placed(shared("..", "zoo", "godot_demos", name + ".glb"))
                every = [p for _, points in found.values() for p in points]
                low, high = ([f(p[k] for p in every) for k in range(3)] for f in (min, max))
                for k in range(3):
                    self.assertAlmostEqual(high[k] - low[k], size[k], delta=0.01)


if __name__ == "__main__":
    main()
