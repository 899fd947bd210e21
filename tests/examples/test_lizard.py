"""The example lizard: what its files hold, read back by other means than those that wrote them; and that the checks
behind `make_lizard.py --check` can fail."""

import collections
import json
import math
import os
import struct
import subprocess
import sys
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir)
LIZARD = os.path.join(ROOT, "examples", "lizard")
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(ROOT, "examples", "modelling"))

from made_files import where_they_were_made  # noqa: E402
from quad_mesh import QuadMesh, check_mirror, check_section, subdivided  # noqa: E402


def read_obj(path):
    """{object: ([points], [(corner indices within the object, material)])}"""
    objects, first, points, material, current = {}, 0, 0, None, None
    with open(path, encoding="ascii") as stream:
        for line in stream:
            key, *rest = line.split()
            if key == "o":
                current, first = objects.setdefault(rest[0], ([], [])), points
            elif key == "v":
                current[0].append(tuple(map(float, rest)))
                points += 1
            elif key == "usemtl":
                material = rest[0]
            elif key == "f":
                current[1].append((tuple(int(c.split("/")[0]) - 1 - first for c in rest), material))
    return objects


def read_glb(path):
    with open(path, "rb") as stream:
        data = stream.read()
    magic, version, total = struct.unpack_from("<4sII", data)
    size, kind = struct.unpack_from("<I4s", data, 12)
    assert (magic, version, total, kind) == (b"glTF", 2, len(data), b"JSON")
    return json.loads(data[20:20 + size]), data[20 + size + 8:]


def accessor(document, binary, index):
    entry = document["accessors"][index]
    view = document["bufferViews"][entry["bufferView"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3}[entry["type"]]
    letter = {5126: "f", 5123: "H"}[entry["componentType"]]
    flat = struct.unpack_from(f"<{entry['count'] * width}{letter}", binary, view["byteOffset"])
    return [flat[i:i + width] for i in range(0, len(flat), width)]


def rotated(q, v):
    x, y, z, w = q
    t = (2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0]))
    return (v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0])


class Placed:
    """The GLB's nodes by name: parent's name, and a function from local to asset space."""

    def __init__(self, document):
        self.nodes, self.parent, self.chain = document["nodes"], {}, {}
        self.walk(document["scenes"][0]["nodes"][0], [])

    def walk(self, index, above):
        node = self.nodes[index]
        self.chain[node["name"]] = [*above, node]
        self.parent[node["name"]] = above[-1]["name"] if above else None
        for child in node.get("children", ()):
            self.walk(child, self.chain[node["name"]])

    def world(self, name, point=(0.0, 0.0, 0.0)):
        for node in reversed(self.chain[name]):
            turned = rotated(node.get("rotation", (0, 0, 0, 1)), point)
            point = tuple(a + b for a, b in zip(turned, node.get("translation", (0, 0, 0))))
        return point


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.objects = read_obj(os.path.join(LIZARD, "lizard.obj"))
        cls.document, cls.binary = read_glb(os.path.join(LIZARD, "lizard.glb"))
        cls.placed = Placed(cls.document)

    @where_they_were_made
    def test_script_finds_nothing_wrong_and_nothing_stale(self):
        script = os.path.join(LIZARD, "make_lizard.py")
        done = subprocess.run([sys.executable, "-B", script, "--check"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_quads_and_closed_sections(self):
        faces = [face for _, part in self.objects.values() for face, _ in part]
        self.assertGreaterEqual(len(faces), 1200)
        self.assertEqual({len(face) for face in faces}, {4})
        for name, (points, part) in self.objects.items():
            sides = collections.Counter((f[i - 1], f[i]) for f, _ in part for i in range(4))
            self.assertEqual(set(sides.values()), {1}, name)
            self.assertEqual(set(sides), {(b, a) for a, b in sides}, name)
            self.assertEqual({c for f, _ in part for c in f}, set(range(len(points))), name)

    def test_height_and_length(self):
        points = [p for part, _ in self.objects.values() for p in part]
        self.assertEqual(min(p[1] for p in points), 0.0)
        self.assertAlmostEqual(max(p[2] for p in points) - min(p[2] for p in points), 1.2, delta=0.05)
        self.assertAlmostEqual(self.placed.world("upper_leg.L")[1], 0.2, delta=0.03)

    def test_each_section_is_a_mesh_node_under_its_bone(self):
        meshes = [node["name"] for node in self.placed.nodes if "mesh" in node]
        self.assertEqual(sorted(meshes), sorted(self.objects))
        bones = [self.placed.parent[name] for name in meshes]
        self.assertEqual(len(set(bones)), len(bones))
        self.assertEqual(self.placed.parent["Head"], "head")
        self.assertEqual(self.placed.parent["UpperArm.L"], "upper_arm.L")

    def test_glb_has_the_triangles_of_the_obj(self):
        for node in self.placed.nodes:
            if "mesh" not in node:
                continue
            points, faces = self.objects[node["name"]]
            area = collections.defaultdict(float)
            seen = set()
            for primitive in self.document["meshes"][node["mesh"]]["primitives"]:
                attributes = primitive["attributes"]
                local = accessor(self.document, self.binary, attributes["POSITION"])
                seen.update(local)
                for normal in accessor(self.document, self.binary, attributes["NORMAL"]):
                    self.assertAlmostEqual(math.hypot(*normal), 1.0, delta=1e-5)
                name = self.document["materials"][primitive["material"]]["name"]
                area[name] += self.document["accessors"][primitive["indices"]]["count"] / 6
            self.assertEqual(dict(area), dict(collections.Counter(material for _, material in faces)))
            self.assertEqual(len(seen), len(points), "positions that weld to the section's points")
            worlds = sorted(self.placed.world(node["name"], p) for p in seen)
            for axis in range(3):
                self.assertAlmostEqual(min(p[axis] for p in worlds), min(p[axis] for p in points), delta=1e-6)
                self.assertAlmostEqual(sum(p[axis] for p in worlds), sum(p[axis] for p in points), delta=1e-4)

    def test_bones_run_along_their_y_and_mirror(self):
        for name, chain in self.placed.chain.items():
            node = chain[-1]
            if "mesh" in node or name in ("Lizard", "root"):
                continue
            self.assertTrue("sbf_limits" in node.get("extras", {}) or name.endswith("_end"), name)
            if ".L" in name:
                x, y, z = self.placed.world(name)
                self.assertGreater(x, 0.0)
                for a, b in zip(self.placed.world(name.replace(".L", ".R")), (-x, y, z)):
                    self.assertAlmostEqual(a, b, delta=1e-6)
        for bone, after in (("spine", "chest"), ("tail2", "tail3"), ("head", "head_end"),
                            ("upper_leg.R", "lower_leg.R"), ("lower_arm.L", "hand.L"), ("foot.L", "foot.L_end")):
            tip = self.placed.world(after)
            reach = math.dist(self.placed.world(bone), tip)
            for a, b in zip(self.placed.world(bone, (0.0, reach, 0.0)), tip):
                self.assertAlmostEqual(a, b, delta=1e-5)

    def test_elbows_point_back_knees_forward(self):
        for upper, lower, end, sign in (("upper_arm.L", "lower_arm.L", "hand.L", -1),
                                        ("upper_leg.L", "lower_leg.L", "foot.L", 1)):
            hip, knee, ankle = (self.placed.world(n) for n in (upper, lower, end))
            self.assertGreater(sign * (knee[2] - 0.5 * (hip[2] + ankle[2])), 0.03)
            self.assertLess(math.dist(hip, ankle), 0.85 * (math.dist(hip, knee) + math.dist(knee, ankle)))

    def test_positive_swing_z_bends_the_knee_further(self):
        """swing_z turns about the bone's local +X: a small positive turn brings the ankle nearer to the hip."""
        for upper, lower, end in (("upper_arm.L", "lower_arm.L", "hand.L"), ("upper_leg.R", "lower_leg.R", "foot.R")):
            hip, knee, ankle = (self.placed.world(n) for n in (upper, lower, end))
            x = [a - b for a, b in zip(self.placed.world(lower, (1.0, 0.0, 0.0)), knee)]
            half = 0.05
            turn = (*(math.sin(half) * c for c in x), math.cos(half))
            moved = rotated(turn, tuple(a - b for a, b in zip(ankle, knee)))
            self.assertLess(math.dist(hip, [a + b for a, b in zip(knee, moved)]), math.dist(hip, ankle) - 1e-3)


class Skin(unittest.TestCase):
    """The files of the animal as one skin."""

    def test_one_closed_surface(self):
        (name, (points, faces)), = read_obj(os.path.join(LIZARD, "lizard_skin.obj")).items()
        sides = collections.Counter((f[i - 1], f[i]) for f, _ in faces for i in range(len(f)))
        self.assertEqual((name, set(sides.values())), ("Lizard", {1}))
        self.assertEqual(set(sides), {(b, a) for a, b in sides})
        self.assertEqual(len(points) - len(sides) // 2 + len(faces), 2)
        self.assertEqual({(-x + 0.0, y, z) for x, y, z in points}, set(points))

    def test_the_glb_has_the_same_points_on_the_same_bones(self):
        document, binary = read_glb(os.path.join(LIZARD, "lizard_skin.glb"))
        points = set(read_obj(os.path.join(LIZARD, "lizard_skin.obj"))["Lizard"][0])
        rows = [p for primitive in document["meshes"][0]["primitives"]
                for p in accessor(document, binary, primitive["attributes"]["POSITION"])]
        self.assertEqual({tuple(round(c, 6) + 0.0 for c in p) for p in rows}, points)
        of_sections = Placed(read_glb(os.path.join(LIZARD, "lizard.glb"))[0])
        placed = Placed(document)
        for joint in document["skins"][0]["joints"]:
            name = document["nodes"][joint]["name"]
            for a, b in zip(placed.world(name), of_sections.world(name)):
                self.assertAlmostEqual(a, b, delta=1e-6)
            self.assertEqual(document["nodes"][joint].get("extras"), of_sections.chain[name][-1].get("extras"), name)


def box():
    mesh = QuadMesh("box")
    for i in range(8):
        mesh.add_point((2.0 * (i & 1) - 1.0, float(i >> 1 & 1), float(i >> 2)))
    for corners in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
        mesh.add_face(corners, ((0.0, 0.0),) * 4, "m")
    return mesh


class Checks(unittest.TestCase):
    def faults(self, change):
        mesh = box()
        change(mesh)
        return " ".join(check_section(mesh))

    def test_a_box_is_sound(self):
        self.assertEqual(check_section(box()), [])
        self.assertEqual(check_mirror(box(), box()), [])
        self.assertAlmostEqual(box().volume(), 2.0)

    def test_faults_are_found(self):
        self.assertIn("open", self.faults(lambda m: m.faces.pop()))
        self.assertIn("unused", self.faults(lambda m: m.add_point((9.0, 9.0, 9.0))))
        self.assertIn("inward", self.faults(lambda m: m.flipped()))
        self.assertIn("same direction", self.faults(lambda m: m.faces.append(m.faces[0])))
        self.assertIn("not convex", self.faults(lambda m: m.points.__setitem__(7, (-0.6, 0.3, 1.0))))
        self.assertIn("coincide", self.faults(lambda m: m.points.__setitem__(7, m.points[6])))

    def test_asymmetry_is_found(self):
        mesh = box()
        mesh.points[7] = (1.0, 1.0, 1.000001)
        self.assertEqual(len(check_mirror(mesh, mesh)), 1)
        self.assertEqual(check_mirror(mesh, mesh.mirrored("other")), [])
        with self.assertRaises(ValueError):
            mesh.points[7] = (1.0, 1.0, 1.1)
            mesh.symmetrise()

    def test_subdivision_keeps_a_box_closed_and_rounds_it(self):
        fine = subdivided(box())
        self.assertEqual(check_section(fine), [])
        self.assertEqual(len(fine.faces), 24)
        self.assertLess(fine.volume(), 2.0)


if __name__ == "__main__":
    unittest.main()
