"""VRM files, the format of avatars: their springs become chains that swing with their colliders, their humanoid gives the gait its legs, arms and head,
malformed parts are left out, and every .glb has the springs again."""

import json
import math
import os
import unittest
import xml.etree.ElementTree as ElementTree

import play_files
from bundle_file import numbers
from glb_file import Glb
from json_schema import faults
from sbfmt_program import ROOT, SOURCE_PARTS, ProgramTest, main
from vrm_files import Avatar, joints, old_springs, springs

SCHEMAS = os.path.join(os.environ.get("SBFMT_SHARED_DATA", os.path.join(ROOT, os.pardir, "shared", "data")), os.pardir, "vrm-springbone", "schema")


def avatar_1(path, plain=True, change=None, **options):
    avatar = Avatar(plain)
    extension = springs(avatar, **options)
    if change:
        change(extension, avatar)
    return avatar.write(path, VRMC_vrm=avatar.humanoid(), VRMC_springBone=extension)


def avatar_0(path, change=None):
    avatar = Avatar(back=True)
    groups, colliders = old_springs(avatar)
    if change:
        change(groups, colliders, avatar)
    return avatar.write(path, VRM=avatar.old(groups, colliders))


class Bundle:
    def __init__(self, path):
        self.root = ElementTree.parse(path).getroot()
        self.bones = self.root.findall("skeleton/bone")
        self.names = [bone.get("name") for bone in self.bones]
        self.chains = {chain.get("name"): chain for chain in self.root.findall("chains/chain") if chain.find("chain_spring") is not None}
        self.colliders = self.root.findall("chain_colliders/chain_collider")

    def bones_of(self, chain):
        return [self.names[int(i)] for i in numbers(chain, "bones")]

    def values(self, chain, name):
        return list(numbers(self.chains[chain].find("chain_spring"), name))


class Vrm(ProgramTest):
    def converted(self, path, *options):
        out = path + ".sbf"
        result = self.good("convert", path, *SOURCE_PARTS, "-o", out, *options)
        return Bundle(out), result.err

    def test_springs_of_1_0_become_chains(self):
        bundle, reported = self.converted(avatar_1(self.path("avatar.vrm")))
        self.assertNotIn("IMPORT_SPRING", reported)
        self.assertEqual(sorted(bundle.chains), ["hair", "lock"])
        self.assertEqual(bundle.bones_of(bundle.chains["hair"]), [f"hair{i}" for i in range(5)])
        spacing = numbers(bundle.chains["hair"], "spacing")
        self.assertEqual(spacing[-1], 0)  # the last joint is only an end
        self.assertAlmostEqual(spacing[0], math.dist((0, 1.70, -0.10), (0, 1.66, -0.22)), 5)
        drag = -60 * math.log(0.7)
        self.assertAlmostEqual(bundle.values("hair", "drag")[0], drag, 4)
        for found, stiffness in zip(bundle.values("hair", "stiffness"), (0.4, 0.6, 0.4, 0.4, 0.4)):
            self.assertAlmostEqual(found, stiffness * drag / 0.3, 3)
        for found, gravity in zip(bundle.values("hair", "gravity"), (0, -0.3 * drag / 0.3, 0)):
            self.assertAlmostEqual(found, gravity, 4)
        self.assertEqual(bundle.values("hair", "radius"), [0.02])
        self.assertEqual(bundle.values("hair", "colliders"), [0, 1, 4, 2, 3])  # as the groups list them
        self.assertEqual(bundle.chains["lock"].find("chain_spring").get("center"), "bone.head")

    def test_all_kinds_of_colliders_are_read(self):
        bundle, _ = self.converted(avatar_1(self.path("avatar.vrm")))
        kinds = [(c.get("shape"), c.get("bone"), c.get("inside")) for c in bundle.colliders]
        self.assertEqual(kinds, [("sphere", "bone.head", None), ("capsule", "bone.chest", None), ("sphere", "bone.head", "true"),
                                 ("capsule", "bone.spine", "true"), ("plane", "bone.chest", None)])
        for collider, position in zip(bundle.colliders, ((0, 1.65, -0.02), (0, 1.28, -0.03), (0, 1.55, -0.1), (0, 0.9, 0), (0, 1.28, -0.12))):
            self.assertLess(math.dist([float(n) for n in collider.get("position").split()], position), 1e-5)
        self.assertLess(math.dist([float(n) for n in bundle.colliders[1].get("end").split()], (0, 1.48, -0.04)), 1e-5)
        self.assertEqual(bundle.colliders[4].get("normal"), "0 0 -1")
        self.assertEqual([float(c.get("radius", 0)) for c in bundle.colliders], [0.11, 0.14, 0.55, 0.5, 0])

    def test_secondary_animation_of_0_x_becomes_chains(self):
        bundle, reported = self.converted(avatar_0(self.path("avatar.vrm")))
        self.assertNotIn("IMPORT_", reported)
        self.assertEqual(bundle.bones_of(bundle.chains["hair"]), [f"hair{i}" for i in range(5)])
        self.assertAlmostEqual(numbers(bundle.chains["hair"], "spacing")[-1], 0.07, 6)  # a point beyond the last bone
        self.assertAlmostEqual(bundle.values("hair", "stiffness")[0], -0.4 * 60 * math.log(0.7) / 0.3, 3)
        self.assertEqual(bundle.values("hair", "colliders"), [0, 1, 2])
        self.assertEqual(bundle.chains["lock"].find("chain_spring").get("center"), "bone.head")
        # It faced -Z, and the offsets' z were against glTF's.
        for collider, position in zip(bundle.colliders, ((0, 1.65, -0.02), (0, 1.38, -0.05), (0, 1.23, -0.05))):
            self.assertLess(math.dist([float(n) for n in collider.get("position").split()], position), 1e-5)
        hair = bundle.bones[bundle.names.index("hair2")]
        self.assertLess(float(hair.get("head").split()[2]), -0.2)
        left = bundle.bones[bundle.names.index("thigh.L")]
        self.assertGreater(float(left.get("head").split()[0]), 0.05)

    def test_branches_of_0_x_are_chains_of_their_own(self):
        def change(groups, _, avatar):
            groups[:] = [{**groups[0], "bones": [avatar.node["head"]]}]  # hair and lock are both below the head

        bundle, _ = self.converted(avatar_0(self.path("avatar.vrm"), change))
        found = sorted(bundle.bones_of(chain) for chain in bundle.root.findall("chains/chain"))
        self.assertEqual(found, [["head"] + [f"hair{i}" for i in range(5)], [f"lock{i}" for i in range(3)]])

    def test_the_humanoid_gives_legs_arms_and_head(self):
        for plain in (True, False):  # names that say nothing
            bundle, reported = self.converted(avatar_1(self.path(f"avatar{plain}.vrm"), plain))
            names = {node: name for name, node in Avatar(plain).node.items()}
            bone = {found.get("id"): names[int(found.get("name")[1:])] if not plain else found.get("name") for found in bundle.bones}
            gait = bundle.root.find("gait")
            ik = {chain.get("id"): (bone[chain.get("root")], bone[chain.get("end")]) for chain in bundle.root.findall("ik/ik_chain")}
            self.assertEqual([ik[leg.get("ik")] for leg in gait.findall("leg")], [("thigh.L", "foot.L"), ("thigh.R", "foot.R")])
            self.assertEqual(bone[gait.find("head_turn").get("bone")], "head")
            posed = {bone[key.get("bone")] for key in bundle.root.find(f"poses/pose[@id='{gait.get('rest_pose')}']")}
            self.assertTrue({"arm.L", "arm.R"} <= posed, posed)
            self.assertIn("the file names its legs", reported)

    def test_springs_win_over_a_proposed_tail(self):
        avatar = Avatar(tail=True)
        tail = joints(avatar.chain("tail", 4), stiffness=1)
        extension = {"specVersion": "1.0", "springs": [{"name": "tail", "joints": tail}]}
        bundle, _ = self.converted(avatar.write(self.path("stiff.vrm"), VRMC_vrm=avatar.humanoid()))
        self.assertIsNotNone(bundle.root.find("gait/tail"))
        bundle, _ = self.converted(avatar.write(self.path("tail.vrm"), VRMC_vrm=avatar.humanoid(), VRMC_springBone=extension))
        self.assertIsNone(bundle.root.find("gait/tail"))
        self.assertEqual(list(bundle.chains), ["tail"])
        self.good("validate", "--strict", self.path("tail.vrm.sbf"))

    def test_malformed_parts_are_left_out_and_reported(self):
        def joint(index, **values):
            return lambda extension, _: extension["springs"][0]["joints"][index].update(values)

        def collider(**values):
            return lambda extension, _: extension["colliders"][0].update(values)

        def spring(**values):
            return lambda extension, _: extension["springs"][0].update(values)

        def fraction(extension, _):
            extension["springs"].append({"joints": extension["springs"][0]["joints"][1:3]})

        def missing(extension, _):
            del extension["springs"][0]["joints"][1]["node"]

        def reverse(extension, _):
            extension["springs"][0]["joints"].reverse()

        def repeat(extension, _):
            extension["springs"][0]["joints"][2] = extension["springs"][0]["joints"][1]

        both, lock, hair = ["hair", "lock"], ["lock"], ["hair"]
        cases = (("a node that is not there", joint(1, node=999), lock), ("a negative node", joint(1, node=-1), lock), ("no node", missing, lock),
                 ("no chain", reverse, lock), ("a cycle", repeat, lock), ("a shared joint", fraction, both),
                 ("one joint", lambda e, _: e["springs"][0].update(joints=e["springs"][0]["joints"][:1]), lock),
                 ("joints that are no list", spring(joints=3), lock), ("a negative radius", joint(1, hitRadius=-1), both),
                 ("too much drag", joint(1, dragForce=7), both), ("a text", joint(1, stiffness="much"), both),
                 ("too large a number", joint(1, stiffness=1e300), both), ("two numbers", joint(1, gravityDir=[0, 1]), both),
                 ("no such group", spring(colliderGroups=[0, 99, -1, "x"]), both), ("a collider nowhere", collider(node=999), both),
                 ("a collider without a shape", collider(shape={}), both), ("a collider inside out", collider(shape={"sphere": {"radius": -1}}), both),
                 ("a center below", lambda e, a: e["springs"][1].update(center=a.node["lock1"]), both),
                 ("a center beside", lambda e, a: e["springs"][1].update(center=a.node["hand.L"]), both),
                 ("a plane without a normal", lambda e, _: e["colliders"][4]["extensions"]["VRMC_springBone_extended_collider"]["shape"]["plane"].update(normal=[0, 0, 0]), both),
                 ("another version", lambda e, _: e.update(specVersion="2.0"), []), ("a mesh", lambda e, a: e["springs"][0]["joints"][4].update(node=len(a.glb.json["nodes"]) - 1), lock))
        for what, change, kept in cases:
            with self.subTest(what):
                path = avatar_1(self.path("bad.vrm"), change=change)
                bundle, reported = self.converted(path)
                self.assertIn("IMPORT_SPRING", reported)
                self.assertEqual(sorted(bundle.chains), sorted(kept))
                self.good("validate", path + ".sbf")
                run = self.json_of("run", path + ".sbf", "--seconds", "0.2")
                self.assertTrue(run["valid"])
        self.assertEqual(hair, ["hair"])

    def test_malformed_parts_of_0_x_are_left_out_and_reported(self):
        cases = (("a bone that is not there", lambda g, c, a: g[0].update(bones=[999, a.node["hair0"]])), ("a bone of two groups", lambda g, c, a: g[1].update(bones=[a.node["hair1"]])),
                 ("no such group", lambda g, c, a: g[0].update(colliderGroups=[7])), ("a collider nowhere", lambda g, c, a: c[0].update(node=-4)),
                 ("a negative radius", lambda g, c, a: c[0]["colliders"][0].update(radius=-2)), ("a text", lambda g, c, a: g[0].update(dragForce="x")),
                 ("no numbers", lambda g, c, a: c[0]["colliders"][0].update(offset=[1])))
        for what, change in cases:
            with self.subTest(what):
                bundle, reported = self.converted(avatar_0(self.path("bad.vrm"), change))
                self.assertIn("IMPORT_SPRING", reported)
                self.assertIn("hair", bundle.chains)
                self.good("validate", self.path("bad.vrm.sbf"))

    def test_a_character_swings_and_comes_to_rest(self):
        path = avatar_1(self.path("avatar.vrm"))
        bundle = self.converted(path)[0]
        with open(self.path("script"), "w", encoding="ascii") as stream:
            stream.write("0 drive 1.2 1\n1.5 drive 0 0\n")
        report = self.json_of("run", path + ".sbf", "--seconds", "8", "--script", self.path("script"), "--pose", self.path("pose.csv"))
        self.assertTrue(report["valid"])
        with open(self.path("pose.csv"), encoding="ascii") as stream:
            rows = [line.split(",") for line in stream.readlines()[1:]]
        ends = [tuple(map(float, row[3:6])) for row in rows if row[2] == "hair4"]
        heads = [tuple(map(float, row[3:6])) for row in rows if row[2] == "hair0"]
        self.assertEqual(len(ends), len(heads))
        hangs = [a[1] - b[1] for a, b in zip(ends, heads)]
        self.assertGreater(max(hangs) - min(hangs), 0.02)
        self.assertLess(math.dist(ends[-1], ends[-2]), 1e-5)
        self.assertEqual(len(bundle.chains), 2)

    def exported(self, source):
        """The extension in a .glb without soft bodies, and in a packed one."""
        self.good("export", source, "-o", self.path("plain.glb"))
        self.good("pack", source, "-o", self.path("whole.glb"))
        return [Glb(self.path(name)) for name in ("plain.glb", "whole.glb")]

    def test_a_glb_has_the_springs_again(self):
        for make in (avatar_1, avatar_0):
            path = make(self.path("avatar.vrm"))
            self.converted(path)
            files = self.exported(path + ".sbf")
            for glb in files:
                self.assertIn("VRMC_springBone", glb.json["extensionsUsed"])
                self.assertEqual("VRMC_springBone_extended_collider" in glb.json["extensionsUsed"], make is avatar_1)
                extension = glb.json["extensions"]["VRMC_springBone"]
                by_name = {spring["name"]: spring for spring in extension["springs"]}
                hair, nodes = by_name["hair"]["joints"], glb.json["nodes"]
                self.assertEqual([nodes[joint["node"]]["name"] for joint in hair][:5], [f"hair{i}" for i in range(5)])
                self.assertEqual(len(hair), 5 if make is avatar_1 else 6)
                if make is avatar_0:
                    self.assertEqual(nodes[hair[5]["node"]]["name"], "hair4_end")
                    self.assertEqual(glb.parents[hair[5]["node"]], hair[4]["node"])
                for name, value in (("stiffness", 0.4), ("dragForce", 0.3), ("gravityPower", 0.3), ("hitRadius", 0.02)):
                    self.assertAlmostEqual(hair[0][name], value, 5)
                self.assertEqual(nodes[by_name["lock"]["center"]]["name"], "head")
                self.assertEqual(len(extension["colliders"]), 5 if make is avatar_1 else 3)
                extended = ["extensions" in collider for collider in extension["colliders"]]
                self.assertEqual(extended, [False, False, True, True, True] if make is avatar_1 else [False] * 3)
                self.assertNotIn("inside", str([collider["shape"] for collider in extension["colliders"]]))
            self.good("unpack", self.path("whole.glb"), "-o", self.path("back.sbf"))
            with open(path + ".sbf", "rb") as before, open(self.path("back.sbf"), "rb") as after:
                self.assertEqual(before.read(), after.read())  # SBF_soft_body states it exactly
            bundle = self.converted(self.path("plain.glb"))[0]
            self.assertEqual(sorted(bundle.chains), ["hair", "lock"])
            self.assertEqual(len(bundle.colliders), 5 if make is avatar_1 else 3)
            before = Bundle(path + ".sbf")
            self.assertEqual(bundle.names, before.names)  # nodes at ends are no bones
            for name, chain in before.chains.items():
                self.assertEqual(bundle.bones_of(bundle.chains[name]), before.bones_of(chain))
                for one, other in zip(numbers(bundle.chains[name], "spacing"), numbers(chain, "spacing")):
                    self.assertAlmostEqual(one, other, 5)

    def test_a_packed_character_may_be_called_vrm(self):
        path = avatar_1(self.path("avatar.vrm"))
        self.converted(path)
        self.good("pack", path + ".sbf", "-o", self.path("whole.glb"))
        os.rename(self.path("whole.glb"), self.path("whole.vrm"))
        self.good("convert", self.path("whole.vrm"), *SOURCE_PARTS, "-o", self.path("back.sbf"))
        with open(path + ".sbf", "rb") as before, open(self.path("back.sbf"), "rb") as after:
            self.assertEqual(before.read(), after.read())
        self.assertTrue(self.json_of("run", self.path("whole.vrm"), "--seconds", "0.1")["valid"])

    def test_a_baked_motion_has_no_springs(self):
        path = avatar_1(self.path("avatar.vrm"))
        self.converted(path)
        self.good("export", path + ".sbf", "-o", self.path("moved.glb"), "--seconds", "0.2")
        self.assertNotIn("VRMC_springBone", Glb(self.path("moved.glb")).json.get("extensionsUsed", []))

    def test_tails_chains_and_followers_swing_too(self):
        with open(self.path("bones.sbf"), "w", encoding="ascii") as stream:
            stream.write("""<?xml version="1.0" encoding="UTF-8"?>
<sbf version="1.4"><skeleton>
<bone id="hips" name="hips" head="0 1 0" length="0.2"/>
<bone id="t0" name="t0" parent="hips" head="0 1 -0.1" rotation="-0.70710677 0 0 0.70710677" length="0.2"/>
<bone id="t1" name="t1" parent="t0" head="0 1 -0.3" rotation="-0.70710677 0 0 0.70710677" length="0.25"/>
<bone id="r0" name="r0" parent="hips" head="0.1 1 0" length="0.1"/>
<bone id="r1" name="r1" parent="r0" head="0.1 1.1 0" length="0.1"/>
<bone id="ear" name="ear" parent="hips" head="0 1.2 0" length="0.1"/>
<bone id="nose" name="nose" parent="hips" head="0 1.2 0.1"/>
<bone id="tip" name="tip" parent="ear" head="0 1.3 0"/>
<bone id="odd" name="t1_end" parent="hips" head="0 1.5 0"/>
</skeleton>
<gait id="g" body="hips" kind="none"><tail chain="tail" frequency="1.5" damping_ratio="0.3"/></gait>
<chains><chain id="tail" name="tail"><bones>1 2</bones></chain><chain id="rope" name="rope" kind="distance" damping="4"><bones>3 4</bones></chain>
<chain id="again" name="again"><bones>1 2</bones></chain></chains>
<followers><follower id="wag" name="wag" bone="ear" frequency="3" damping_ratio="0.4"/><follower id="none" bone="nose"/>
<follower id="squash" bone="t0" channel="squash"/></followers></sbf>""")
        reported = self.good("export", self.path("bones.sbf"), "-o", self.path("bones.glb")).err
        self.assertIn("chains: 1", reported)
        self.assertIn("followers: 2", reported)
        glb = Glb(self.path("bones.glb"))
        by_name = {spring["name"]: spring["joints"] for spring in glb.json["extensions"]["VRMC_springBone"]["springs"]}
        self.assertEqual({name: [glb.nodes[j["node"]]["name"] for j in found] for name, found in by_name.items()},
                         {"tail": ["t0", "t1", "t1_end_end"], "rope": ["r1", "r1_end"], "wag": ["ear", "tip"]})
        # The step of 1/60 s has the modes of the system: their product and sum.
        for joint, length, hz, ratio in ((by_name["tail"][0], 0.2, 1.5, 0.3), (by_name["tail"][1], 0.25, 1.5, 0.3), (by_name["wag"][0], 0.1, 3, 0.4)):
            c, kept, w = joint["stiffness"] / 60 / length, 1 - joint["dragForce"], 2 * math.pi * hz / 60
            self.assertAlmostEqual(kept / (1 + c), math.exp(-2 * ratio * w), 5)
            self.assertAlmostEqual((1 + kept) / (1 + c), 2 * math.exp(-ratio * w) * math.cos(w * math.sqrt(1 - ratio ** 2)), 5)
        rope = by_name["rope"][0]
        self.assertEqual(rope["dragForce"], 1)
        self.assertAlmostEqual(1 / (1 + rope["stiffness"] / 60 / 0.1), math.exp(-4 / 60), 5)

    @unittest.skipUnless(os.path.isdir(SCHEMAS), "../shared/vrm-springbone is not there")
    def test_the_extension_fits_its_schemas(self):
        def schema(name):
            with open(os.path.join(SCHEMAS, name), encoding="utf-8") as stream:
                return json.load(stream)

        path = avatar_1(self.path("avatar.vrm"))
        self.converted(path)
        for glb in self.exported(path + ".sbf"):
            extension = glb.json["extensions"]["VRMC_springBone"]
            self.assertEqual(fits(extension, schema("VRMC_springBone.schema.json"), schema), [])
            for collider in extension["colliders"]:
                extended = collider.get("extensions", {}).get("VRMC_springBone_extended_collider")
                if extended:
                    self.assertEqual(fits(extended, schema("VRMC_springBone_extended_collider.schema.json"), schema), [])

    @play_files.needs_node
    def test_the_validator_finds_no_error(self):
        for make in (avatar_1, avatar_0):
            path = make(self.path("avatar.vrm"))
            self.converted(path)
            self.exported(path + ".sbf")
            for name in ("plain.glb", "whole.glb"):
                issues = play_files.node("validate_gltf.mjs", self.path(name))["issues"]
                self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), issues["messages"])


def fits(value, schema, load, path="$"):
    """Faults by a schema whose parts are in other files; glTF's own types are not looked into."""
    found = []
    own = {word: rule for word, rule in schema.items() if word in ("type", "required", "minimum", "maximum", "minItems", "maxItems", "enum", "const")}
    if "const" in own:
        found += [] if value == own.pop("const") else [f"{path} is not {schema['const']}"]
    low, high = own.pop("minimum", -math.inf), own.pop("maximum", math.inf)
    if isinstance(value, (int, float)) and not isinstance(value, bool) and not low <= value <= high:
        found.append(f"{path} is not from {low} to {high}")
    if isinstance(value, list) and not own.pop("minItems", 0) <= len(value) <= own.pop("maxItems", math.inf):
        found.append(f"{path} has {len(value)} items")
    own = {word: rule for word, rule in own.items() if word in ("type", "required", "enum")}
    found += faults(value, own)
    if schema.get("$ref", "").startswith("VRM"):
        found += fits(value, load(schema["$ref"]), load, path)
    for part in schema.get("allOf", ()):
        found += fits(value, part, load, path)
    for name, rule in schema.get("properties", {}).items():
        if isinstance(value, dict) and name in value and isinstance(rule, dict):
            found += fits(value[name], rule, load, f"{path}.{name}")
    if isinstance(value, list) and isinstance(schema.get("items"), dict):
        for i, item in enumerate(value):
            found += fits(item, schema["items"], load, f"{path}[{i}]")
    return found


if __name__ == "__main__":
    main()
