"""Tests which parts of a skin become soft by default, and options that change this."""

import os
import xml.etree.ElementTree as ElementTree

from sbfmt_program import ROOT, ProgramTest, convert_once, main, shared
from skinned_glb import SkinnedGlb, box

CALF = os.path.join(ROOT, "examples", "calf", "calf.glb")
CHARACTERS = (("fox", "fox.glb"), ("greenman", "greenman.glb"), ("spider", "spider.glb"), ("snake", "snake.glb"))
MOST_BODIES, MOST_SUBSTEPS = 9, 16


def recipes_of(path):
    """The section recipes by the names of their bones."""
    root = ElementTree.parse(path).getroot()
    names = {b.get("id"): b.get("name") for b in root.iter("bone")}
    return {names.get(r.get("bone")): r for r in root.findall("section_recipes/section_recipe")}


def soft_of(path):
    return {name for name, recipe in recipes_of(path).items() if recipe.get("rigid") != "true"}


class Softness(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.calf = convert_once(cls.class_folder.name, "calf.sbf", CALF)

    def converted(self, name, *options):
        out = self.path(name + ".sbf")
        self.good("convert", CALF, "-o", out, *options)
        return out

    def test_visible_parts_are_soft(self):
        soft = soft_of(self.calf)
        self.assertIn("spine", soft)
        self.assertFalse([name for name in soft if "foot" in name or "lower" in name], "lower legs stay with their bones")
        self.assertLessEqual(len(soft), MOST_BODIES)
        self.assertEqual({s["bone"] for s in self.json_of("info", self.calf)["sections"]}, soft)
        self.assertTrue(all(r.get("proposed") == "true" for r in recipes_of(self.calf).values()))

    def test_jiggling_parts_are_not_soft(self):
        """Ears of a glTF file with VRMC_springBone move as pendulums; the same ears are soft without."""
        glb = SkinnedGlb.of(CALF)
        number = {node["name"]: i for i, node in enumerate(glb.json["nodes"]) if "mesh" not in node}
        springs = []
        for ear in ("ear.L", "ear.R"):
            end = glb.node(ear + "_end", number[ear], translation=[0, 0.1, 0])
            springs.append({"name": ear, "joints": [{"node": number[ear]}, {"node": end}]})
        glb.json["extensionsUsed"] = ["VRMC_springBone"]
        glb.json["extensions"] = {"VRMC_springBone": {"specVersion": "1.0", "springs": springs}}
        reported = self.good("convert", glb.write(self.path("swinging.glb")), "-o", self.path("swinging.sbf"), "--no-build").err
        self.assertIn("2 on swinging chains", reported)
        soft = soft_of(self.path("swinging.sbf"))
        self.assertIn("spine", soft)
        self.assertFalse({"ear.L", "ear.R"} & soft)
        self.assertTrue({"ear.L", "ear.R"} <= soft_of(self.calf))

    def test_rigid_parts_keep_their_hulls_and_joints(self):
        info = self.json_of("info", self.calf)
        self.assertEqual((info["rigid_bodies"], info["joints"]), (22, 21))

    def test_the_default_character(self):
        self.assertEqual(self.json_of("validate", self.calf)["messages"], [])
        report = self.json_of("run", self.calf, "--seconds", "3", "--drive", "0.3,0.2")
        self.assertTrue(report["valid"])
        self.assertGreater(report["volume_ratio_least"], 0.9)
        self.assertLess(report["max_strain"], 0.5)
        self.assertLessEqual(report["substeps"], MOST_SUBSTEPS)
        self.assertEqual(report["seam_gap"], 0)

    def test_vertices_beside_a_soft_part_follow_all_their_bones(self):
        """No pose tears the skin between sections and rigid parts: at rest each vertex is at its position, and blends sum to 1."""
        root = ElementTree.parse(self.calf).getroot()
        shares = {}
        for embedding in root.findall("soft_body/level/embedding[@render_mesh]"):
            vertices = embedding.find("vertices").text.split()
            blends = embedding.find("blends").text.split() if embedding.find("blends") is not None else ["1"] * len(vertices)
            for vertex, blend in zip(vertices, blends):
                shares[vertex] = shares.get(vertex, 0) + float(blend)
        self.assertTrue(shares)
        for vertex, fraction in shares.items():
            self.assertAlmostEqual(fraction, 1, delta=1e-3, msg=vertex)

    def test_choices_of_the_caller(self):
        self.assertEqual(soft_of(self.converted("none", "--rigid", "*")), set())
        self.assertEqual(soft_of(self.converted("two", "--rigid", "*", "--soft", "head,tail2")), set(), "rigid comes last")
        self.assertLessEqual({"head", "tail2"}, soft_of(self.converted("more", "--soft", "head,tail2")))
        self.assertEqual(len(soft_of(self.converted("all", "--soft", "*"))), 22)
        self.assertIn("no bone, and no object attached to a bone, has the name 'antlers'", self.fails(1, "convert", CALF, "-o", self.path("x.sbf"), "--soft", "antlers"))
        self.assertFalse(os.path.exists(self.path("x.sbf")))

    def test_firmness_scales_and_materials_are_exact(self):
        def moduli(path):
            return {float(r.find("attributes").get("young_modulus")) for r in recipes_of(path).values()}

        usual, = moduli(self.calf)
        firm, = moduli(self.converted("firm", "--firmness", "2"))
        self.assertAlmostEqual(firm, 2 * usual, delta=0.05 * firm)  # both are rounded to two digits
        self.assertEqual(moduli(self.converted("flesh", "--material", "flesh")), {20000})
        named = self.converted("named", "--material", "head=fat")
        self.assertIn("head", soft_of(named), "what has a material is soft")

    @staticmethod
    def robot():
        """The calf's file, named as a machine."""
        glb = SkinnedGlb.of(CALF)
        for mesh in glb.json["meshes"]:
            mesh["name"] = "Robot"
        for node in glb.json["nodes"]:
            if "mesh" in node:
                node["name"] = "Robot"
        return glb

    def test_large_objects_on_a_machine_are_not_soft(self):
        glb = self.robot()
        joint = [n.get("name") for n in glb.json["nodes"]].index("spine")
        glb.node("turret", joint, mesh=glb.mesh(*box((-0.6, 0.7, -0.6), (0.6, 1.6, 0.6))))
        out = self.path("turret.sbf")
        self.assertIn("1 object attached to bones", self.good("convert", glb.write(self.path("turret.glb")), "-o", out).err)
        self.assertEqual(self.json_of("info", out)["sections"], [])
        self.assertIn("turret", [m["name"] for m in self.json_of("info", out)["render_meshes"]])

    def test_a_machine_is_not_soft(self):
        glb, out = self.robot(), self.path("robot.sbf")
        printed = self.good("convert", glb.write(self.path("robot.glb")), "-o", out).err
        self.assertIn("nothing is soft", printed)
        self.assertIn("of a machine", printed)
        self.assertEqual(self.json_of("info", out)["sections"], [])
        report = self.json_of("run", out, "--seconds", "2", "--drive", "0.3,0")
        self.assertTrue(report["valid"])
        self.assertGreater(report["distance"], 0.3)

    def test_heads_in_any_language_are_not_soft(self):
        """A person's face is painted on its head, under any name of the head."""
        yeti = os.path.join(ROOT, "examples", "yeti", "yeti.glb")
        for head in ("head", "Kopf", "голова", "头"):
            glb, out = SkinnedGlb.of(yeti), self.path("yeti.sbf")
            bone, = (n for n in glb.json["nodes"] if n.get("name") == "head")
            bone["name"] = head
            self.assertIn("1 head or face", self.good("convert", glb.write(self.path("yeti.glb")), "-o", out).err, head)
            self.assertNotIn(head, soft_of(out))

    def test_hair_on_a_rigid_head_is_valid(self):
        """A skinned mesh of its own moves with a head that the conversion itself left rigid."""
        glb, out = SkinnedGlb.of(os.path.join(ROOT, "examples", "yeti", "yeti.glb")), self.path("yeti.sbf")
        head = [n.get("name") for n in glb.json["nodes"]].index("head")
        joint = glb.json["skins"][0]["joints"].index(head)
        points, triangles = box((-0.1, 1.9, -0.1), (0.1, 2.1, 0.1))
        hair = glb.mesh(points, triangles, [(joint, 0, 0, 0)] * len(points), [(1, 0, 0, 0)] * len(points))
        glb.node("hair", mesh=hair, skin=0)
        printed = self.good("convert", glb.write(self.path("yeti.glb")), "-o", out).err
        self.assertNotIn("EMBEDDING_NO_BODY", printed)
        self.assertIn("hair", [m["name"] for m in self.json_of("info", out)["render_meshes"]])
        self.assertNotIn("head", soft_of(out))

    def test_objects_on_bones_are_props(self):
        glb = SkinnedGlb.of(CALF)
        joint = [n.get("name") for n in glb.json["nodes"]].index("head")
        glb.node("hat", joint, mesh=glb.mesh(*box((-0.06, 0.97, 0.45), (0.06, 1.07, 0.57))))
        path, out = glb.write(self.path("hat.glb")), self.path("hat.sbf")
        self.assertIn("1 object attached to bones", self.good("convert", path, "-o", out).err)
        self.assertNotIn("hat", [s["name"] for s in self.json_of("info", out)["sections"]])
        self.assertIn("hat", [m["name"] for m in self.json_of("info", out)["render_meshes"]])
        self.good("convert", path, "-o", out, "--soft", "hat,head")
        self.assertIn("hat", [s["name"] for s in self.json_of("info", out)["sections"]])

    def test_real_characters(self):
        for file in CHARACTERS:
            path = shared(*file)
            if not os.path.exists(path):
                self.skipTest("no shared data")
            with self.subTest(file[-1]):
                out = self.path(file[-1] + ".sbf")
                self.good("convert", path, "-o", out)
                bodies = self.json_of("info", out)["sections"]
                self.assertGreaterEqual(len(bodies), 2)
                self.assertLessEqual(len(bodies), MOST_BODIES)
                report = self.json_of("run", out, "--seconds", "3", "--drive", "0.5,0.2")
                self.assertTrue(report["valid"])
                self.assertGreater(report["volume_ratio_least"], 0.9)
                self.assertLess(report["max_strain"], 0.5)
                self.assertLessEqual(report["substeps"], MOST_SUBSTEPS)


if __name__ == "__main__":
    main()
