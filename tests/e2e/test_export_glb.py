"""Binary glTF: no fault in Khronos's validator, the same counts and the same motion in three.js, in Blender and in our own reader."""

import math
import os
import struct
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import play_files
from bundle_file import numbers, rows
from glb_file import Glb
from sbfmt_program import PROGRAM, ProgramTest, ROOT, convert_once, example, main, read_text, write_bytes

FRAME = 22
SECONDS = 1
DRIVE = ("--drive", "0.3,0.2", "--ground", "noise:0.1,3")
HOP = ("--clip", "0")
NEAR_M = 1e-5


def points_at(cache, frame):
    """Of a PC2 file."""
    with open(cache, "rb") as stream:
        data = stream.read()
    count, = struct.unpack_from("<I", data, 16)
    return rows(struct.unpack_from(f"<{3 * count}f", data, 32 + 12 * count * frame), 3)


def rest_points(bundle):
    found = []
    for mesh in ElementTree.parse(bundle).getroot().iter("render_mesh"):
        found += rows(numbers(mesh.find("polygon_mesh"), "positions"), 3)
    return found


class Weights(ProgramTest):
    def test_weights_of_zero(self):
        """A point whose weights are all 0 follows the root's own joint. Bones of weight 0 are not listed, and every set sums to 1."""
        mesh = ("<polygon_mesh target=\"rendering\"><positions>0 0 0 1 0 0 0 1 0</positions><polygon_sizes>3</polygon_sizes>"
                "<polygon_points>0 1 2</polygon_points></polygon_mesh>")
        skin = ("<skin><influence_counts>2 2 1</influence_counts><bones>0 1 0 1 1</bones><weights>0 0.5 0 0 0.25</weights></skin>")
        write_bytes(self.path("a.sbf"), ("<sbf version=\"1.0\"><skeleton><bone id=\"a\" name=\"a\" head=\"0 0 0\" length=\"1\"/>"
                                         "<bone id=\"b\" name=\"b\" parent=\"a\" head=\"0 1 0\" length=\"1\"/></skeleton>"
                                         f"<render_mesh id=\"m\" name=\"m\">{mesh}{skin}</render_mesh></sbf>").encode())
        self.good("export", self.path("a.sbf"), "-o", self.path("a.glb"))
        glb = Glb(self.path("a.glb"))
        (_, primitive), = glb.primitives()
        positions, joints, weights = (glb.accessor(primitive["attributes"][name]) for name in ("POSITION", "JOINTS_0", "WEIGHTS_0"))
        names = [glb.nodes[node].get("name") for node in glb.json["skins"][0]["joints"]]
        found = {position: {names[j]: w for j, w in zip(joint, weight) if w} for position, joint, weight in zip(positions, joints, weights)}
        self.assertEqual(found[(0, 0, 0)], {"b": 1})
        self.assertEqual(found[(0, 1, 0)], {"b": 1})
        (root, weight), = found[(1, 0, 0)].items()
        self.assertEqual(weight, 1)
        self.assertNotIn(root, ("a", "b"))
        self.assertTrue(all(j == 0 for joint, weight in zip(joints, weights) for j, w in zip(joint, weight) if not w))


class Motion(ProgramTest):
    """Three characters: one whose skin has weights, one of parts that hang on bones, one that squashes."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.bundles = {
            "pup": convert_once(cls.class_folder.name, "pup.sbf", os.path.join(ROOT, "examples", "pup", "pup.glb")),
            "lizard": example(cls.class_folder.name), "pudding": os.path.join(cls.class_folder.name, "pudding.sbf")}
        maker = os.path.join(ROOT, "examples", "pudding", "make_pudding_bundle.py")
        subprocess.run([sys.executable, "-B", maker, PROGRAM, cls.bundles["pudding"]], capture_output=True, check=True)

    def moved(self, name):
        """The exported walk; the points of the skin at rest and at the frame, as a run has them."""
        bundle, out, cache = self.bundles[name], self.made(name + "_walk.glb"), self.made(name + ".pc2")
        moves = HOP if name == "pudding" else DRIVE
        if not os.path.exists(out):
            self.good("export", bundle, "-o", out, "--seconds", SECONDS, *moves)
            self.good("run", bundle, "--seconds", SECONDS, "--fps", "30", *moves, "--cache", cache)
        return out, rest_points(bundle), points_at(cache, FRAME)

    def assert_plays(self, meshes, rest, now):
        """Every vertex is where one of the points is that it lay on at rest."""
        positions = {}
        for i, point in enumerate(rest):
            positions.setdefault(tuple(round(c, 4) for c in point), []).append(i)
        maximum = minimum = 0
        for mesh in meshes:
            for before, after in zip(mesh["rest"], mesh["now"]):
                key = tuple(round(c, 4) for c in before)
                near = positions.get(key) or [i for i, p in enumerate(rest) if math.dist(p, before) < 2e-4]
                self.assertTrue(near, f"{mesh['name']}: no point at {before}")
                maximum = max(maximum, min(math.dist(now[i], after) for i in near))
                minimum = max(minimum, min(math.dist(rest[i], after) for i in near))
        self.assertLess(maximum, NEAR_M)
        self.assertGreater(minimum, 0.01, "nothing moved")

    @play_files.needs_node
    def test_the_validator_gives_no_warnings(self):
        for name, bundle in self.bundles.items():
            out = self.moved(name)[0]
            for path, options in ((out, None), (self.path("rest.glb"), ()),
                                  (self.path("coarse.glb"), ("--render-level", "1", "--seconds", "0.2"))):
                if options is not None:
                    self.good("export", bundle, "-o", path, *options)
                issues = play_files.node("validate_gltf.mjs", path)["issues"]
                self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), issues["messages"])

    @play_files.needs_node
    def test_three_js_plays_it(self):
        for name, bundle in self.bundles.items():
            out, rest, now = self.moved(name)
            info = self.json_of("info", bundle)
            shown = play_files.node("three_gltf.mjs", out, FRAME / 30)
            self.assertEqual(shown["animations"], ["hop", "motion"] if name == "pudding" else ["motion"])
            self.assertEqual(sum(mesh["triangles"] for mesh in shown["meshes"]),
                             sum(mesh["triangles"] for mesh in info["render_meshes"]))
            self.assert_plays(shown["meshes"], rest, now)

    @play_files.needs_blender
    def test_blender_plays_it(self):
        for name, bundle in self.bundles.items():
            if name == "pudding":
                continue  # of two animations it shows the first, a clip
            out, rest, now = self.moved(name)
            info = self.json_of("info", bundle)
            shown = play_files.blender("blender_gltf.py", out, FRAME)
            self.assertEqual(shown["joints"], len(info["bones"]))
            self.assertEqual(len(shown["meshes"]), len(info["render_meshes"]))
            self.assertEqual(sum(mesh["triangles"] for mesh in shown["meshes"]),
                             sum(mesh["triangles"] for mesh in info["render_meshes"]))
            for mesh in shown["meshes"]:
                self.assertEqual(mesh["keys"], 30 * SECONDS + 1)
            self.assert_plays(shown["meshes"], rest, now)

    def test_squash_is_exported_as_targets(self):
        """Compressed at landing by morph targets, because joints alone do not change its width."""
        out, rest, now = self.moved("pudding")
        glb = Glb(out)
        motion, = (a for a in glb.json["animations"] if any(c["target"]["path"] == "weights" for c in a["channels"]))
        worlds = glb.worlds({key: keys for key, keys in glb.tracks(motion).items() if key[1] != "weights"}, FRAME / 30)
        widths = [max(xs) - min(xs) for xs in ([p[0] for p in points] for points in (
            rest, now, glb.skinned(worlds), glb.skinned(worlds, FRAME)))]
        self.assertGreater(widths[1], 1.03 * widths[0])
        self.assertAlmostEqual(widths[2], widths[0], delta=1e-3 * widths[0])
        self.assertAlmostEqual(widths[3], widths[1], delta=NEAR_M)

    def test_normals_of_targets_rotate_with_the_soft_body(self):
        """A normal keeps its angle to the faces around it that share it: triangles here, so it is compared with the sum of their area vectors."""
        glb, sums, rows_of, turned = Glb(self.moved("pup")[0]), ({}, {}), [], 0
        for node, primitive in glb.primitives():
            rest, normals = (glb.accessor(primitive["attributes"][name]) for name in ("POSITION", "NORMAL"))
            offsets, bends = (glb.accessor(primitive["targets"][FRAME][name]) for name in ("POSITION", "NORMAL"))
            corners = [row[0] for row in glb.accessor(primitive["indices"])]
            keys = [(node, *p, *n) for p, n in zip(rest, normals)]
            now = [[a + b for a, b in zip(p, o)] for p, o in zip(rest, offsets)]
            for points, found in zip((rest, now), sums):
                for i in range(0, len(corners), 3):
                    a, b, c = (points[k] for k in corners[i:i + 3])
                    u, v = ([y - x for x, y in zip(a, end)] for end in (b, c))
                    area = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
                    for k in corners[i:i + 3]:
                        found[keys[k]] = [x + y for x, y in zip(found.get(keys[k], (0, 0, 0)), area)]
            rows_of += zip(keys, normals, bends)
        for key, normal, bend in rows_of:
            after = [a + b for a, b in zip(normal, bend)]
            self.assertAlmostEqual(math.hypot(*after), 1, delta=1e-4)
            if not all(math.hypot(*found[key]) > 0 for found in sums):
                continue
            cosines = [sum(x * y for x, y in zip(n, found[key])) / math.hypot(*found[key]) for n, found in zip((normal, after), sums)]
            self.assertAlmostEqual(cosines[0], cosines[1], delta=1e-3)
            turned += math.hypot(*bend) > 0.02
        self.assertGreater(turned, 100)

    def test_it_reads_back(self):
        for bundle in self.bundles.values():
            self.good("export", bundle, "-o", self.path("a.glb"))
            self.good("convert", self.path("a.glb"), "-o", self.path("b.sbf"), "--no-build")
            before, after = (self.json_of("info", path) for path in (bundle, self.path("b.sbf")))
            self.assertEqual([bone["name"] for bone in after["bones"] if bone["name"] != "Skeleton"],
                             [bone["name"] for bone in before["bones"]])
            self.assertEqual(sum(mesh["triangles"] for mesh in after["render_meshes"]),
                             sum(mesh["triangles"] for mesh in before["render_meshes"]))
            for end in ("min", "max"):
                for a, b in zip(after["bounds"][end], before["bounds"][end]):
                    self.assertAlmostEqual(a, b, delta=1e-5)

    def test_the_same_call_gives_the_same_bytes(self):
        for name in "ab":
            self.good("export", self.bundles["pup"], "-o", self.path(name + ".glb"), "--seconds", "0.2")
        with open(self.path("a.glb"), "rb") as a, open(self.path("b.glb"), "rb") as b:
            self.assertEqual(a.read(), b.read())


class Everything(ProgramTest):
    """The sample that has something of all there is."""

    def setUp(self):
        super().setUp()
        self.source = os.path.join(ROOT, "spec", "samples", "valid", "everything.sbf")
        self.left_out = self.good("export", self.source, "-o", self.path("all.glb")).err
        self.glb = Glb(self.path("all.glb"))

    def test_counts_and_names_are_kept(self):
        info = self.json_of("info", self.source)
        root = ElementTree.parse(self.source).getroot()
        self.assertEqual(self.glb.joint_count(), len(info["bones"]))
        self.assertEqual(len([mesh for mesh in self.glb.json["meshes"] if "name" in mesh]), len(info["render_meshes"]))
        self.assertEqual([m["name"] for m in self.glb.json["materials"]],
                         [m.get("name") or m.get("id") for m in root.find("materials")])
        keys = [key.get("name") for key in root.iter("shape_key")]
        self.assertTrue(keys)
        self.assertEqual([name for mesh in self.glb.json["meshes"] for name in mesh.get("extras", {}).get("targetNames", ())],
                         keys)
        self.assertEqual([one["name"] for one in self.glb.json["animations"]],
                         [one.get("name") for one in root.iter("clip")])

    def test_omissions_are_reported(self):
        for what in ("soft bodies: ", "pulleys: 1", "breaking forces of joints: 1", "gaits: ", "EXPORT_LEFT_OUT"):
            self.assertIn(what, self.left_out)

    @play_files.needs_node
    def test_the_validator_finds_no_error(self):
        issues = play_files.node("validate_gltf.mjs", self.path("all.glb"))["issues"]
        self.assertEqual(issues["numErrors"], 0, issues["messages"])

    def test_names_are_escaped(self):
        text = read_text(self.source)
        self.assertIn('name="Hips"', text)
        write_bytes(self.path("odd.sbf"), text.replace('name="Hips"', 'name="a&quot;\\b&#10;"').encode())
        self.good("export", self.path("odd.sbf"), "-o", self.path("odd.glb"))
        self.assertIn('a"\\b\n', [node["name"] for node in Glb(self.path("odd.glb")).nodes])

    def test_a_motion_is_for_glb_alone(self):
        self.assertIn(".glb", self.fails(2, "export", self.source, "-o", self.path("a.obj"), "--seconds", "1"))


if __name__ == "__main__":
    main()
