"""MJCF that export writes: as many of everything as info counts, names once, numbers that MuJoCo's compiler takes."""

import os
import unittest
import xml.etree.ElementTree as ElementTree

import play_files
from sbfmt_program import ProgramTest, ROOT, example, main, read_text

BAR = os.path.join(ROOT, "spec", "samples", "dialect2012", "bar.xml")
FIGURE = os.path.join(ROOT, "examples", "bones", "figure.sbf")
SHARED = os.path.join(ROOT, os.pardir, "shared", "data")
EVERYTHING = os.path.join(ROOT, "spec", "samples", "valid", "everything.sbf")
SECONDS = 0.02
# Polygons of a box whose corners are counted by x first, then y, then z.
BOX = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]


def corners(low, high):
    return [(low[0] if i % 2 == 0 else high[0], low[1] if i // 2 % 2 == 0 else high[1], low[2] if i < 4 else high[2])
            for i in range(8)]


def hull(name, low, high):
    """A kinematic box, as the file has it."""
    words = lambda rows: " ".join(str(x) for row in rows for x in row)  # noqa: E731
    middle = [(a + b) / 2 for a, b in zip(low, high)]
    return (f'<rigid_body id="{name}" motion="kinematic" center="{words([middle])}"><polygon_mesh target="collision_detection">'
            f'<positions>{words(corners(low, high))}</positions><polygon_sizes>{"4 " * 6}</polygon_sizes>'
            f'<polygon_points>{words(BOX)}</polygon_points></polygon_mesh></rigid_body>')


def numbers(node, name):
    return [float(word) for word in node.get(name).split()]


class Mjcf(ProgramTest):
    def exported(self, path):
        """The document's root, after checks that every document passes."""
        self.said = self.good("export", path, "-o", self.path("out.mjcf")).err
        root = ElementTree.fromstring(read_text(self.path("out.mjcf")))
        self.assertEqual(root.tag, "mujoco")
        self.assertEqual(numbers(root.find("option"), "gravity"), [0, 0, -9.81])
        names = {}
        for node in root.iter():
            kind = "joint" if node.tag == "freejoint" else node.tag
            if node.get("name") and kind != "mujoco":
                self.assertNotIn(node.get("name"), names.setdefault(kind, set()), kind)
                names[kind].add(node.get("name"))
        world = root.find("worldbody")
        moving = {}
        for body in world.iter("body"):
            joints = body.findall("joint") + body.findall("freejoint")
            if joints:
                inertial = body.find("inertial")
                self.assertGreater(float(inertial.get("mass")), 0)
                a, b, c = sorted(numbers(inertial, "diaginertia"))
                self.assertGreater(a, 0)
                self.assertLessEqual(c, (a + b) * 1.0001)
                if inertial.get("quat"):
                    self.assertAlmostEqual(sum(x * x for x in numbers(inertial, "quat")), 1, delta=1e-5)
            if body.get("mocap"):
                self.assertFalse(joints)
            moving[body.get("name")] = bool(joints)
        for mocap in (body for body in world.iter("body") if body.get("mocap")):
            self.assertIn(mocap, world.findall("body"))
        self.assertFalse([free for body in world.findall("body") for inner in body.iter("body")
                          for free in inner.findall("freejoint") if inner is not body])
        for joint in world.iter("joint"):
            if joint.get("range"):
                minimum, maximum = numbers(joint, "range")
                self.assertLess(minimum, maximum)
                self.assertTrue(minimum - 1e-5 <= float(joint.get("ref", 0)) <= maximum + 1e-5, joint.get("name"))
            if joint.get("axis"):
                self.assertAlmostEqual(sum(x * x for x in numbers(joint, "axis")), 1, delta=1e-4)
        for geom in world.iter("geom"):
            self.assertIn(geom.get("mesh"), names["mesh"])
        for constraint in (root.find("equality") or []):
            for end in ("body1", "body2"):
                self.assertIn(constraint.get(end, "world"), set(moving) | {"world"})
        for pair in root.iter("exclude"):
            self.assertLessEqual({pair.get("body1"), pair.get("body2")}, set(moving))
        for flex in root.iter("flex"):
            bodies = flex.get("body").split()
            self.assertEqual(len(numbers(flex, "vertex")), 3 * len(bodies))
            self.assertLessEqual(set(bodies), set(moving) | {"world"})
            size = int(flex.get("dim")) + 1
            points = [int(word) for word in flex.get("element").split()]
            self.assertEqual(len(points) % size, 0)
            for i in range(0, len(points), size):
                self.assertEqual(len(set(points[i:i + size])), size)
            self.assertLess(max(points), len(bodies))
        return root

    def places(self, root):
        """Where each body stands at rest: none is turned."""
        found = {"world": (0, 0, 0)}

        def visit(node, base):
            for body in node.findall("body"):
                at = tuple(a + b for a, b in zip(base, numbers(body, "pos")))
                found[body.get("name")] = at
                visit(body, at)
        visit(root.find("worldbody"), (0, 0, 0))
        return found

    def vertices(self, root, flex):
        places, local = self.places(root), numbers(flex, "vertex")
        return [tuple(a + b for a, b in zip(places[body], local[3 * i:3 * i + 3]))
                for i, body in enumerate(flex.get("body").split())]

    @play_files.needs_node
    def test_mujoco_steps_it(self):
        """Its compiler takes the files with as much of everything as they hold, and none blows up."""
        self.good("build", FIGURE, "-o", self.path("figure.sbf"))
        self.good("convert", BAR, "-o", self.path("bar.sbf"))
        for path in (self.path("figure.sbf"), self.path("bar.sbf"), EVERYTHING):
            self.good("export", path, "-o", self.path("out.mjcf"))
            root = ElementTree.fromstring(read_text(self.path("out.mjcf")))
            world, flexes = root.find("worldbody"), list(root.iter("flex"))
            reported = play_files.node("step_mujoco.mjs", self.path("out.mjcf"), SECONDS)
            count = lambda *tags: sum(len(list(world.iter(tag))) for tag in tags)  # noqa: E731
            self.assertEqual(reported["counts"], {
                "nbody": 1 + count("body"), "njnt": count("joint", "freejoint"), "nmesh": len(list(root.iter("mesh"))),
                "nflex": len(flexes), "nflexvert": sum(len(flex.get("body").split()) for flex in flexes),
                "nflexelem": sum(len(flex.get("element").split()) // (int(flex.get("dim")) + 1) for flex in flexes),
                "neq": len(root.find("equality") or []), "ntendon": len(list(root.iter("spatial"))),
                "nmocap": len([body for body in world.iter("body") if body.get("mocap")]),
                "nexclude": len(list(root.iter("exclude"))), "nsite": count("site")}, path)
            self.assertEqual((reported["warnings"], reported["finite"]), (0, True), path)
            self.assertLess(reported["fastest"], 10)  # m/s and rad/s; a fall of so long ends at 0.2 m/s

    @play_files.needs_node
    @unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
    def test_mujoco_steps_characters(self):
        """Their sections lie in each other and around their hulls: nothing drives those apart, and nothing moves faster than it would fall."""
        lattices = ["--springs", "tetrahedra", "--elements", "100"]
        for name, options in (("fox/fox.glb", ["--unit", "0.01"]), ("greenman/greenman.glb", []), ("greenman/greenman.glb", lattices),
                              ("letter-f/letter_f.dae", [])):
            self.good("convert", os.path.join(SHARED, name), *options, "-o", self.path("a.sbf"))
            self.good("export", self.path("a.sbf"), "-o", self.path("out.mjcf"))
            reported = play_files.node("step_mujoco.mjs", self.path("out.mjcf"), 0.1)
            self.assertEqual((reported["warnings"], reported["finite"], reported["touches"]), (0, True, 0), name)
            self.assertGreater(reported["fastest"], 0.1, name)
            self.assertLess(reported["fastest"], 0.981, name)
            self.assertLess(reported["falls"], 1.2, name)

    @play_files.needs_node
    def test_mujoco_allows_the_same_contacts(self):
        """Two soft boxes on a hull collide, and the lower one with the hull; an object inside one of them does not, nor do boxes on separate layers."""
        with open(self.path("boxes.obj"), "w", encoding="ascii") as file:
            for i, name in enumerate(("low", "high")):
                at = 0.22 * i
                print("o", name, file=file)
                print(*("v {:g} {:g} {:g}".format(*p) for p in corners((0, at, 0), (0.2, at + 0.2, 0.2))), sep="\n", file=file)
                print(*("f {} {} {} {}".format(*(8 * i + p + 1 for p in face)) for face in BOX), sep="\n", file=file)
        self.good("convert", self.path("boxes.obj"), "--springs", "tetrahedra", "--elements", "100", "--material", "flesh",
                  "-o", self.path("boxes.sbf"))
        text = read_text(self.path("boxes.sbf"))
        inner = hull("inner", (0.08, 0.3, 0.08), (0.12, 0.34, 0.12))
        beside = hull("beside", (-0.1, -0.1, -0.1), (0.3, -0.02, 0.3)).replace("<rigid_body", '<rigid_body layer="2" mask="2"')
        for floor, want in ((hull("floor", (-0.1, -0.1, -0.1), (0.3, -0.02, 0.3)), ["body.high body.low", "body.low floor"]),
                            (beside, ["body.high body.low"])):
            with open(self.path("a.sbf"), "w", encoding="utf-8") as file:
                file.write(text.replace("  <soft_body", f"  <rigid_bodies>{floor}{inner}</rigid_bodies>\n  <soft_body", 1))
            self.good("export", self.path("a.sbf"), "-o", self.path("out.mjcf"))
            reported = play_files.node("step_mujoco.mjs", self.path("out.mjcf"), 0.08)
            self.assertEqual((reported["warnings"], reported["finite"], reported["pairs"]), (0, True, want))
            self.assertLess(reported["fastest"], 0.9)  # they begin 0.02 m apart, which their radii are in sum

    def test_overlapping_hulls(self):
        """The first and second of three do at rest, the second and third only touch; the fourth is beside all, on another layer."""
        places = [(0, "a", ""), (0.15, "b", ""), (0.35, "c", ""), (0.6, "d", ' layer="2" mask="2"')]
        bodies = "".join(hull(name, (x, 0, 0), (x + 0.2, 0.2, 0.2)).replace('motion="kinematic"', f'motion="dynamic" mass="1"{more}')
                         for x, name, more in places)
        with open(self.path("a.sbf"), "w", encoding="ascii") as file:
            file.write(f'<sbf version="1.0"><asset title="boxes"/><rigid_bodies>{bodies}</rigid_bodies></sbf>')
        pairs = {(pair.get("body1"), pair.get("body2")) for pair in self.exported(self.path("a.sbf")).iter("exclude")}
        self.assertEqual(pairs, {("a", "b"), ("a", "d"), ("b", "d"), ("c", "d")})

    def test_a_figure_with_a_soft_body(self):
        self.good("build", FIGURE, "-o", self.path("figure.sbf"))
        info = self.json_of("info", self.path("figure.sbf"))
        root = self.exported(self.path("figure.sbf"))
        source = ElementTree.parse(self.path("figure.sbf")).getroot()
        rigid = {node.get("id"): node for node in source.iter("rigid_body")}
        bodies = {body.get("name"): body for body in root.find("worldbody").iter("body")}
        self.assertEqual(len(set(bodies) & set(rigid)), info["rigid_bodies"])
        # All hang on one of the two hands, which are led; the joint that closes the loop is an equality.
        self.assertEqual(sum(node.get("motion") != "dynamic" for node in rigid.values()), 2)
        self.assertEqual(root.find("worldbody").findall(".//freejoint"), [])
        joints = {joint.get("name").split(":")[0] for joint in root.find("worldbody").iter("joint")
                  if joint.get("name")}
        closing, = root.find("equality")
        self.assertEqual((closing.tag, len(joints)), ("connect", info["joints"] - 1))
        self.assertEqual(len(joints | {closing.get("name").split(":")[0]}), info["joints"])
        flex, = root.iter("flex")
        self.assertEqual(len(flex.get("element").split()), 4 * info["tetrahedra"])
        held = [name for name in flex.get("body").split() if name in rigid]
        self.assertEqual(len(held), info["pins"])
        self.assertGreater(float(flex.find("elasticity").get("young")), 0)
        # Rigid bodies and the lattice stand where the file has them, a quarter turn about +X on.
        places = self.places(root)
        for name, node in rigid.items():
            x, y, z = (float(word) for word in node.get("center").split())
            for got, want in zip(places[name], (x, -z, y)):
                self.assertAlmostEqual(got, want, delta=1e-5)
        rest = [float(word) for word in source.find("soft_body").find("level").find("positions").text.split()]
        vertices = self.vertices(root, flex)
        self.assertEqual(3 * len(vertices), len(rest))
        for i, got in enumerate(vertices):
            for a, b in zip(got, (rest[3 * i], -rest[3 * i + 2], rest[3 * i + 1])):
                self.assertAlmostEqual(a, b, delta=2e-5)
        # The child's joint is where the other body's frame is, and limits are the file's.
        by_id = {node.get("id"): node for node in source.iter() if node.tag.endswith("joint") and node.get("id")}
        self.assertLessEqual(joints, set(by_id))
        for joint in root.find("worldbody").iter("joint"):
            if joint.get("range") and joint.get("name").endswith(":twist"):
                limit, = (node for node in by_id[joint.get("name")[:-6]].iter("limit")
                          if node.get("target") == "twist")
                self.assertEqual(numbers(joint, "range"), [float(limit.get("min")), float(limit.get("max"))])
        self.assertAlmostEqual(sum(float(node.get("mass")) for name, body in bodies.items() if name in rigid
                                   for node in body.findall("inertial")),
                               sum(float(node.get("mass")) for node in rigid.values()), delta=1e-3)

    def test_sections_of_a_lizard(self):
        path = example(self.class_folder.name)
        info, root = self.json_of("info", path), self.exported(path)
        flexes = list(root.iter("flex"))
        levels = [section["levels"][0] for section in info["sections"]]
        self.assertEqual([len(flex.get("element").split()) for flex in flexes],
                         [2 * level["springs"] for level in levels])
        self.assertEqual({flex.get("dim") for flex in flexes}, {"1"})
        held = sum(name.endswith(":bone") for flex in flexes for name in flex.get("body").split())
        self.assertEqual(held, info["pins"])
        self.assertIn("gaits: 1", self.said)
        for flex in flexes:
            self.assertGreater(float(flex.find("edge").get("stiffness")), 0)

    def test_a_lattice_between_rigid_bodies(self):
        self.good("convert", BAR, "-o", self.path("a.sbf"))
        info, root = self.json_of("info", self.path("a.sbf")), self.exported(self.path("a.sbf"))
        flex, = root.iter("flex")
        self.assertEqual(len(flex.get("element").split()), 4 * info["tetrahedra"])
        free = [body for body in root.find("worldbody").findall("body") if len(body.findall("joint")) == 3
                and body.find("joint").get("type") == "slide"]
        self.assertEqual(len(free) + info["pins"], len(flex.get("body").split()))
        # A quarter of each tetrahedron's mass belongs to a corner; pinned points have no mass of their own.
        mass, names = 0, {body.get("name") for body in free}
        vertices, points = self.vertices(root, flex), [int(word) for word in flex.get("element").split()]
        for i in range(0, len(points), 4):
            a, b, c, d = (vertices[p] for p in points[i:i + 4])
            u, v, w = ([x - y for x, y in zip(corner, a)] for corner in (b, c, d))
            six = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                   + u[2] * (v[0] * w[1] - v[1] * w[0]))
            self.assertGreater(six, 0)
            mass += 1000 * six / 24 * sum(flex.get("body").split()[p] in names for p in points[i:i + 4])
        self.assertLess(mass, info["mass"])
        self.assertAlmostEqual(sum(float(body.find("inertial").get("mass")) for body in free), mass, delta=1e-3)


if __name__ == "__main__":
    main()
