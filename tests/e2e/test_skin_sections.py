"""A character that is one skinned mesh: all of it cut into sections, built again, walked, and left to its bones where that is
asked for (test_softness.py tests which are soft by default). Uses real characters if present."""

import json
import os
import struct
import xml.etree.ElementTree as ElementTree

from glb_file import Glb
from sbfmt_program import ROOT, ProgramTest, convert_once, main, read_bytes, shared, write_bytes
from skinned_glb import SkinnedGlb, box

CALF = os.path.join(ROOT, "examples", "calf", "calf.glb")
# file, at least so many sections, and whether it walks
CHARACTERS = ((("fox", "fox.glb"), 15, True), (("greenman", "greenman.glb"), 6, True), (("spider", "spider.glb"), 20, True),
              (("snake", "snake.glb"), 10, False), (("kenney-fbx", "kenney_character.fbx"), 20, True),
              (("walk-dae", "walk.dae"), 18, True))
# Accessories of a calf: the bone, and two corners of each box, in the calf's rest position
WORN = {"hat": ("head", ((-0.06, 0.97, 0.45), (0.06, 1.07, 0.57))),
        "eyes": ("head", ((-0.10, 0.84, 0.54), (-0.07, 0.87, 0.57)), ((0.07, 0.84, 0.54), (0.10, 0.87, 0.57))),
        "belly": ("spine", ((-0.14, 0.34, -0.12), (0.14, 0.52, 0.12))),
        "cape": ("chest", ((-0.17, 0.70, -0.25), (0.17, 0.72, 0.20)))}
ABOUT_THE_SOURCE = {"UNIT_LOOKS_WRONG", "CLIP_EMPTY"}


def with_limits(glb, node_name, limits):
    """The bytes of a GLB in which a node states limits."""
    size, = struct.unpack_from("<I", glb, 12)
    scene = json.loads(glb[20:20 + size])
    node, = [n for n in scene["nodes"] if n.get("name") == node_name]
    node["extras"] = {"sbf_limits": limits}
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    rest = glb[20 + size:]
    return (glb[:8] + struct.pack("<III", 20 + len(text) + len(rest), len(text), 0x4E4F534A)) + text + rest


def wearing(path, bone, *boxes):
    """Writes the calf with boxes on one of its bones."""
    calf, source = SkinnedGlb.of(CALF), Glb(CALF)
    skin = calf.json["skins"][0]
    joint = [n.get("name") for n in calf.json["nodes"]].index(bone)
    bind = source.accessor(skin["inverseBindMatrices"])[skin["joints"].index(joint)]
    for number, corners in enumerate(boxes):
        node = calf.node(f"worn{number}", joint, mesh=calf.mesh(*box(*corners)))
        calf.json["nodes"][node]["matrix"] = list(bind)  # the mesh's own node is at the origin
    return calf.write(path)


class SkinSections(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.calf = convert_once(cls.class_folder.name, "calf.sbf", CALF, "--soft", "*")

    def walks(self, path, walks=True):
        report = self.json_of("run", path, "--seconds", "2", "--drive", "0.3,0")
        self.assertTrue(report["valid"])
        self.assertGreater(report["volume_ratio"], 0.9)
        if walks:
            self.assertGreater(report["distance"], 0.3)

    def test_the_calf(self):
        info = self.json_of("info", self.calf)
        self.assertEqual(len(info["sections"]), 22)
        self.assertEqual({s["bone"] for s in info["sections"]}, {b["name"] for b in info["bones"]})
        self.assertEqual((info["rigid_bodies"], info["joints"], info["gait"]["legs"]), (22, 21, 4))
        self.assertGreaterEqual(info["embedded_vertices"], 4258)
        self.assertEqual(info["tetrahedra"], 0, "what the embeddings went by is no second model")
        self.assertEqual(self.json_of("validate", self.calf)["messages"], [])
        self.walks(self.calf)

    def test_a_build_of_a_built_file_gives_its_bytes(self):
        again = self.path("again.sbf")
        self.good("build", self.calf, "-o", again)
        self.assertEqual(read_bytes(again), read_bytes(self.calf))

    def test_the_source_is_unchanged(self):
        root = ElementTree.parse(self.calf).getroot()
        self.assertIsNone(root.find("render_mesh").get("derived"))
        self.assertIsNotNone(root.find("render_mesh/skin"))
        for part in (*root.findall("soft_body"), *root.findall("joints/spherical_joint"),
                     *root.findall("rigid_bodies/rigid_body")):
            self.assertIsNotNone(part.get("derived"), part.get("id"))

    def test_clothes_do_not_change_the_calfs_sections(self):
        def skin_of(path):
            """The skin's vertices that each of its sections carries, the worn bodies, and the skin's id."""
            root = ElementTree.parse(path).getroot()
            skin = root.find("render_mesh[skin]").get("id")
            bodies = {b.get("name"): b for b in root.findall("soft_body") if not b.get("name").startswith("worn")}
            carried = {name: [e.find("vertices").text for e in b.iter("embedding") if e.get("render_mesh") == skin]
                       for name, b in bodies.items()}
            return carried, [b for b in root.findall("soft_body") if b.get("name") not in bodies], skin

        bare = skin_of(self.calf)[0]

        def least_volume_of(path):
            """Of several walks: clothes have a mass, which changes each walk a little."""
            reports = [self.json_of("run", path, "--seconds", "2", "--drive", drive) for drive in ("0.3,0", "0.5,0")]
            self.assertTrue(all(report["valid"] for report in reports))
            return min(report["volume_ratio_least"] for report in reports)

        minimum = least_volume_of(self.calf)
        for name, (bone, *boxes) in WORN.items():
            with self.subTest(name):
                out = self.path(name + ".sbf")
                self.good("convert", wearing(self.path(name + ".glb"), bone, *boxes), "-o", out, "--soft", "*", "--material", "tail2=rubber")
                carried, worn, skin = skin_of(out)
                self.assertTrue(all(carried.values()))
                self.assertEqual(carried, bare)
                self.assertEqual(len(worn), len(boxes))
                for body in worn:
                    self.assertNotIn(skin, [e.get("render_mesh") for e in body.iter("embedding")])
                self.assertEqual([m for m in self.json_of("validate", out)["messages"] if m["severity"] == "error"], [])
                self.assertGreater(least_volume_of(out), minimum - 1e-3)

    def test_no_sections(self):
        plain = self.path("plain.sbf")
        self.good("build", self.calf, "-o", plain, "--sections", "none")
        self.assertEqual(self.json_of("info", plain)["sections"], [])
        self.fails(2, "build", self.calf, "-o", plain, "--sections", "some")

    def test_a_stated_overlap_widens_sections(self):
        wide = self.path("wide.sbf")
        self.good("build", self.calf, "-o", wide, "--overlap", "0.1")
        points = [sum(s["vertices"] for s in self.json_of("info", path)["sections"]) for path in (self.calf, wide)]
        self.assertGreater(points[1], 1.2 * points[0])

    def test_sections_get_the_joint_limits_of_the_rig(self):
        rig, out = self.path("limits.glb"), self.path("limits.sbf")
        write_bytes(rig, with_limits(read_bytes(CALF), "fore_lower.L", {"swing_z": [-0.5, 1.25], "twist": [-0.25, 0.25]}))
        self.good("convert", rig, "-o", out)
        root = ElementTree.parse(out).getroot()
        joints = {j.get("name"): j for j in root.findall("joints/*")}
        self.assertEqual(len(joints), 21)
        stated = joints.pop("fore_lower.L")
        self.assertIsNone(stated.get("proposed"))
        self.assertEqual([(e.get("target"), e.get("min"), e.get("max")) for e in stated.iter("limit")],
                         [("twist", "-0.25", "0.25"), ("swing_z", "-0.5", "1.25")])
        for joint in joints.values():
            self.assertEqual((joint.get("proposed"), list(joint.iter("limit"))), ("true", []), joint.get("name"))
        self.assertEqual(len(root.findall("rigid_bodies/rigid_body/polygon_mesh")), 22, "hulls of all")
        self.assertEqual(self.json_of("validate", out)["messages"], [])

    def test_materials_of_sections(self):
        out, again = self.path("flesh.sbf"), self.path("again.sbf")
        self.good("convert", CALF, "-o", out, "--soft", "*", "--material", "flesh", "--material", "tail2=rubber")

        def moduli(path):
            return {b.get("name"): b.find("attributes").get("young_modulus")
                    for b in ElementTree.parse(path).getroot().findall("soft_body")}

        self.assertEqual(moduli(out), {name: "1200000" if name == "tail2" else "20000" for name in moduli(self.calf)})
        self.good("build", out, "-o", again)
        self.assertEqual(read_bytes(again), read_bytes(out), "what sections are made of is source")
        self.good("build", out, "-o", again, "--material", "bone.head=muscle")
        self.assertEqual({n: m for n, m in moduli(again).items() if m != "20000"}, {"tail2": "1200000", "head": "30000"})
        self.good("build", self.calf, "-o", again, "--material", "tail2=rubber")
        self.assertEqual({n: m for n, m in moduli(again).items() if m != moduli(self.calf)[n]}, {"tail2": "1200000"})
        self.assertIn("no soft body or bone has the name 'tail9'", self.fails(2, "build", out, "-o", again, "--material", "tail9=fat"))

    def test_points_painted_on_the_skin_are_pinned(self):
        out, again = self.path("held.sbf"), self.path("again.sbf")
        self.good("convert", CALF, "-o", out, "--soft", "*", "--budget", "none", "--hold", "head", "--hold", "tail3=tail2",
                  "--goal", "0,0.8")
        root = ElementTree.parse(out).getroot()
        painted = {s.get("name"): s for s in root.findall("render_mesh/pins/pin_set")}
        self.assertEqual({name: s.get("bone") for name, s in painted.items()}, {"head": None, "tail3": "bone.tail2"})
        self.assertTrue(all(abs(float(s.get("maximum")) - 0.8 / 1.2) < 1e-6 for s in painted.values()))
        held = {b.get("name"): {s.get("name"): s for s in b.findall("level/pins/pin_set")} for b in root.findall("soft_body")}
        for body, sets in held.items():
            for name, pins in sets.items():
                bone = "bone.tail2" if name == "tail3" else "bone." + body
                self.assertEqual((pins.get("bone"), pins.get("derived")), (bone, "build"), (body, name))
            points = [p for pins in sets.values() for p in pins.find("points").text.split()]
            self.assertEqual(len(points), len(set(points)), body)
        self.assertGreater(len(held["head"]["head"].find("points").text.split()), 20)
        self.assertIn("tail3", held["tail3"])
        self.assertNotIn("head", held["tail3"])
        self.assertEqual(self.json_of("validate", out)["messages"], [])
        self.assertTrue(self.json_of("run", out, "--seconds", "2", "--drive", "0.3,0")["valid"])
        self.good("build", out, "-o", again)
        self.assertEqual(read_bytes(again), read_bytes(out))
        self.assertIn("named 'antlers'", self.fails(1, "convert", CALF, "-o", again, "--hold", "antlers"))
        self.assertIn("no bone 'antlers'", self.fails(1, "convert", CALF, "-o", again, "--hold", "head=antlers"))

    def test_real_characters(self):
        for number, (file, sections, walks) in enumerate(CHARACTERS):
            path = shared(*file)
            if not os.path.exists(path):
                self.skipTest("no shared data")
            with self.subTest(file[-1]):
                out = self.path(f"{number}.sbf")
                self.good("convert", path, "-o", out, "--soft", "*")
                self.assertGreaterEqual(len(self.json_of("info", out)["sections"]), sections)
                self.assertLessEqual({m["code"] for m in self.json_of("validate", out)["messages"]}, ABOUT_THE_SOURCE)
                self.walks(out, walks)


if __name__ == "__main__":
    main()
