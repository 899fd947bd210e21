"""Compares the conversion of the thesis's lizard with its files, read by a few lines of Python here, and with
data/lizard/README.md."""

import hashlib
import json
import struct
import xml.etree.ElementTree as ElementTree

from sbfmt_program import ProgramTest, call, liz, lizart, main, needs_lizard, read_bytes, read_text, shared

# Section -> bone: the node each section hangs on in the rig. Three sections have the name of another bone.
BONE_OF_SECTION = {"Head": "Head", "Body.001": "Body.002", "Body.002": "Body"}
for side in "LR":
    for limb, end in (("Arm", "Hand"), ("Leg", "Foot")):
        BONE_OF_SECTION.update({f"{limb}1.{side}": f"{limb}.001.{side}", f"{limb}2.{side}": f"{limb}.002.{side}",
                                f"{end}.{side}": f"{limb}.003.{side}"})
for number in "123":
    BONE_OF_SECTION[f"Tail{number}"] = f"Tail.00{number}"

# Bone of each section that the skinned Body of lizart.glb is cut into.
CUT = {name: name for name in ("Body", "Body.001", "Body.002")}
# Rest places of bones, metres, from lizart.glb.
HEADS = {
    "Bone": (0, 0, -1), "Body": (0, 0.7830, -0.7514), "Body.001": (0, 0.7885, -0.0081),
    "Body.002": (0, 0.8975, 0.7228), "Head": (0, 0.9157, 1.3907), "Arm.001.L": (0.3769, 0.7830, 1.1217),
    "Arm.002.L": (0.8965, 0.4977, 0.9772), "Arm.003.L": (0.7349, 0.0527, 1.0976),
    "Leg.001.L": (0.3173, 0.8773, -0.3819), "Leg.002.L": (0.8529, 0.4951, -0.3065),
    "Leg.003.L": (0.7720, 0.0634, -0.6583), "Leg.003.R": (-0.7720, 0.0634, -0.6583),
    "Tail.002": (0, 0.7830, -1.5771), "Tail.003": (0, 0.7830, -2.2238),
}


def single(number):
    return struct.unpack("<f", struct.pack("<f", float(number)))[0]


def read_obj(path):
    """{group: ([places in source order], [polygons as places in the group])}"""
    positions, groups, current = [], {}, None
    used = {}
    for line in read_text(path).splitlines():
        key, _, rest = line.partition(" ")
        if key == "v":
            positions.append(tuple(single(n) for n in rest.split()))
        elif key in ("g", "o"):
            current = groups.setdefault(rest.strip(), [])
        elif key == "f":
            current.append([int(corner.split("/")[0]) - 1 for corner in rest.split()])
    first = 0
    for name, polygons in groups.items():  # a group's vertices are the run up to its last corner
        last = max(max(p) for p in polygons) + 1
        used[name.split("_")[0]] = (positions[first:last], [[i - first for i in p] for p in polygons])
        first = last
    return used


def numbers(element, path):
    found = element.find(path)
    return [] if found is None or not found.text else [float(n) for n in found.text.split()]


def triples(flat):
    return [tuple(flat[i:i + 3]) for i in range(0, len(flat), 3)]


def polygons_of(mesh):
    sizes, points = numbers(mesh, "polygon_sizes"), [int(n) for n in numbers(mesh, "polygon_points")]
    polygons, at = [], 0
    for size in map(int, sizes):
        polygons.append(points[at:at + size])
        at += size
    return polygons


def by_name(rows):
    return {row["name"]: row for row in rows}


@needs_lizard
class ObjAndRig(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = liz(cls.class_folder.name)
        cls.info = json.loads(call("info", cls.file, "--format", "json").out)
        cls.tree = ElementTree.parse(cls.file).getroot()
        cls.obj = read_obj(shared("lizard", "liz.obj"))

    def test_sections_are_those_of_the_obj(self):
        sections = by_name(self.info["sections"])
        self.assertEqual(len(self.info["sections"]), 18)
        self.assertEqual(set(sections), set(self.obj))
        for name, (positions, polygons) in self.obj.items():
            self.assertEqual(sections[name]["vertices"], len(positions), name)
            self.assertEqual(sections[name]["polygons"], len(polygons), name)
        self.assertEqual(sum(s["vertices"] for s in sections.values()), 525)
        self.assertEqual(sum(s["polygons"] for s in sections.values()), 489)

    def test_sections_are_attached_to_the_bones_of_their_nodes(self):
        self.assertEqual({s["name"]: s["bone"] for s in self.info["sections"]}, BONE_OF_SECTION)

    def test_positions_and_polygons_are_kept_in_source_order(self):
        sizes = []
        for body in self.tree.findall("soft_body"):
            positions, polygons = self.obj[body.get("name")]
            mesh = body.find("polygon_mesh")
            self.assertEqual(triples([single(n) for n in numbers(mesh, "positions")]), positions, body.get("name"))
            self.assertEqual(polygons_of(mesh), polygons, body.get("name"))
            sizes += [len(p) for p in polygons_of(mesh)]
        self.assertEqual((sizes.count(4), sizes.count(3), len(sizes)), (488, 1, 489))

    def test_bones(self):
        bones = by_name(self.info["bones"])
        self.assertEqual(len(self.info["bones"]), 26)
        self.assertEqual(len(bones), 26)
        self.assertEqual(sorted(b for b in bones if b.endswith("_end")),
                         ["Arm.003.L_end", "Arm.003.R_end", "Head_end", "Leg.003.L_end", "Leg.003.R_end",
                          "Tail.003_end"])
        self.assertIsNone(bones["Bone"]["parent"])
        self.assertEqual({b["parent"] for b in self.info["bones"] if b["name"].endswith("_end")},
                         {"Head", "Arm.003.L", "Arm.003.R", "Leg.003.L", "Leg.003.R", "Tail.003"})
        for child, parent in (("Body", "Bone"), ("Tail.001", "Bone"), ("Body.001", "Body"), ("Leg.001.R", "Body"),
                              ("Body.002", "Body.001"), ("Head", "Body.002"), ("Arm.001.L", "Body.002")):
            self.assertEqual(bones[child]["parent"], parent)

    def test_bones_lie_where_the_rig_has_them_in_metres(self):
        heads = {b.get("name"): tuple(map(float, b.get("head").split())) for b in self.tree.iter("bone")}
        for name, position in HEADS.items():
            for here, there in zip(heads[name], position):
                self.assertAlmostEqual(here, there, delta=2e-4, msg=name)

    def test_height_and_bounds(self):
        low, high = self.info["bounds"]["min"], self.info["bounds"]["max"]
        self.assertAlmostEqual(high[1] - low[1], 1.10, delta=0.005)
        for here, there in zip(low + high, (-0.9474, -0.0021, -2.7719, 0.9474, 1.0984, 2.2939)):
            self.assertAlmostEqual(here, there, delta=1e-3)

    def test_springs_are_those_of_the_thesis(self):
        springs = self.info["springs"]
        self.assertEqual(sum(s["interior_points"] for s in self.info["sections"]), 506)
        self.assertEqual((springs["structural"], springs["shear"]), (977, 976))
        self.assertEqual(springs["internal"], 2965 - 488)
        self.assertEqual(springs["inert"], 488)
        self.assertEqual(springs["cross"], 0)
        self.assertEqual(self.info["pins"], 506)

    def test_springs_of_one_section(self):
        quads = {"Head": (26, 24, 25, 48, 48, 146 - 24), "Hand.L": (40, 38, 39, 76, 76, 230 - 38),
                 "Body.002": (26, 25, 25, 49, 48, 146 - 24), "Arm1.R": (27, 24, 25, 48, 48, 147 - 24)}
        for body in self.tree.findall("soft_body"):
            if body.get("name") not in quads:
                continue
            sets = {s.get("kind"): len(numbers(s, "ends")) // 2 for s in body.findall("level/spring_set")}
            points = len(triples(numbers(body, "level/positions")))
            vertices, polygons, interior, structural, shear, internal = quads[body.get("name")]
            self.assertEqual(points, vertices + interior, body.get("name"))
            self.assertEqual(len(numbers(body, "polygon_mesh/polygon_sizes")), polygons)
            self.assertEqual((sets["structural"], sets["shear"], sets["internal"]), (structural, shear, internal),
                             body.get("name"))

    def test_defects_are_found_with_their_codes(self):
        report = self.json_of("validate", self.file)
        self.assertTrue(report["valid"])
        self.assertEqual(report["errors"], 0)
        found = {(m["code"], m["message"].split("'")[1]) for m in report["messages"]}
        self.assertLessEqual({("SURFACE_STRAY_POLYGON", "Body.002"), ("POINT_UNUSED", "Arm1.R")}, found)
        self.assertEqual({section for _, section in found}, {"Body.002", "Arm1.R"})
        self.assertLessEqual({m["severity"] for m in report["messages"]}, {"warning", "info"})
        stray = next(m for m in report["messages"] if m["code"] == "SURFACE_STRAY_POLYGON")
        section = [b.get("name") for b in self.tree.findall("soft_body")].index("Body.002") + 1
        self.assertEqual((stray["path"], stray["index"]), (f"/sbf/soft_body[{section}]/polygon_mesh/polygon_sizes", 24))
        self.assertEqual(self.json_of("validate", "--strict", self.file, status=1)["valid"], False)

    def test_a_walk_is_proposed_and_marked_so(self):
        self.assertEqual(self.info["gait"]["legs"], 4)
        gait = self.tree.find("gait")
        self.assertEqual(gait.get("proposed"), "true")
        chains = {c.get("id"): c for c in self.tree.findall("ik/ik_chain")}
        bones = {b.get("id"): b.get("name") for b in self.tree.iter("bone")}
        ends = {bones[chains[leg.get("ik")].get("end")] for leg in gait.findall("leg")}
        roots = {bones[chains[leg.get("ik")].get("root")] for leg in gait.findall("leg")}
        self.assertEqual(ends, {f"{limb}.003.{side}" for limb in ("Arm", "Leg") for side in "LR"})
        self.assertEqual(roots, {f"{limb}.001.{side}" for limb in ("Arm", "Leg") for side in "LR"})
        self.assertEqual(bones[gait.find("head_turn").get("bone")], "Head")
        groups = {bones[chains[leg.get("ik")].get("end")]: leg.get("group", "0") for leg in gait.findall("leg")}
        self.assertEqual(groups["Arm.003.L"], groups["Leg.003.R"])
        self.assertEqual(groups["Arm.003.R"], groups["Leg.003.L"])
        self.assertNotEqual(groups["Arm.003.L"], groups["Arm.003.R"])

    def test_sources_are_named_with_their_hashes(self):
        sources = {s.get("path"): s.get("sha256") for s in self.tree.iter("source")}
        self.assertEqual(set(sources), {"liz.obj", "liz.fbx"})
        for name, digest in sources.items():
            self.assertEqual(hashlib.sha256(read_bytes(shared("lizard", name))).hexdigest(), digest)

    def test_the_same_call_gives_the_same_bytes(self):
        again = self.path("again.sbf")
        self.good("convert", shared("lizard", "liz.obj"), "--rig", shared("lizard", "liz.fbx"), "-o", again)
        self.assertEqual(read_bytes(again), read_bytes(self.file))

    def test_a_build_again_gives_the_same_bytes(self):
        again = self.path("again.sbf")
        self.good("build", self.file, "-o", again)
        self.assertEqual(read_bytes(again), read_bytes(self.file))

    def test_unbuilt_files_have_no_derived_parts(self):
        plain, built = self.path("plain.sbf"), self.path("built.sbf")
        self.good("convert", shared("lizard", "liz.obj"), "--rig", shared("lizard", "liz.fbx"), "--no-build", "-o",
                  plain)
        self.assertNotIn("derived=", read_text(plain))
        self.assertEqual(self.json_of("info", plain)["springs"]["structural"], 0)
        self.good("build", plain, "-o", built)
        self.assertEqual(read_bytes(built), read_bytes(self.file))


@needs_lizard
class FbxAlone(ProgramTest):
    def test_centimetres_become_metres(self):
        out = self.path("liz.sbf")
        self.good("convert", shared("lizard", "liz.fbx"), "-o", out)
        info = self.json_of("info", out)
        self.assertAlmostEqual(info["bounds"]["max"][1] - info["bounds"]["min"][1], 1.10, delta=0.005)
        self.assertEqual({s["name"]: s["bone"] for s in info["sections"]}, BONE_OF_SECTION)

    def test_a_stated_unit_overrides(self):
        out = self.path("liz.sbf")
        self.good("convert", shared("lizard", "liz.obj"), "--unit", "0.01", "--no-build", "-o", out)
        bounds = self.json_of("info", out)["bounds"]
        self.assertAlmostEqual(bounds["max"][1] - bounds["min"][1], 0.0110, delta=5e-5)

    def test_z_up_is_turned(self):
        out = self.path("liz.sbf")
        self.good("convert", shared("lizard", "liz.obj"), "--up", "z", "--no-build", "-o", out)
        bounds = self.json_of("info", out)["bounds"]
        self.assertAlmostEqual(bounds["max"][1], 2.2939, delta=1e-3)  # the old z


def read_glb(path):
    """The document and, for each mesh node, the distinct places of its vertices."""
    data = read_bytes(path)
    size, = struct.unpack_from("<I", data, 12)
    document, binary = json.loads(data[20:20 + size]), data[28 + size:]
    distinct = {}
    for node in document["nodes"]:
        if "mesh" not in node:
            continue
        positions = set()
        for primitive in document["meshes"][node["mesh"]]["primitives"]:
            accessor = document["accessors"][primitive["attributes"]["POSITION"]]
            view = document["bufferViews"][accessor["bufferView"]]
            start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
            step = view.get("byteStride", 12)
            positions |= {binary[start + i * step:start + i * step + 12] for i in range(accessor["count"])}
        distinct[node["name"]] = positions
    return document, distinct


@needs_lizard
class Glb(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = lizart(cls.class_folder.name)
        cls.info = json.loads(call("info", cls.file, "--format", "json").out)
        cls.document, cls.distinct = read_glb(shared("lizard", "lizart.glb"))

    def test_it_is_valid(self):
        report = self.json_of("validate", self.file)
        self.assertEqual((report["valid"], report["errors"]), (True, 0), report["messages"])

    def test_sections_are_attached_to_their_parent_nodes(self):
        nodes, expected = self.document["nodes"], {}
        for parent in nodes:
            for child in parent.get("children", []):
                if "mesh" in nodes[child] and "skin" not in nodes[child]:
                    expected[nodes[child]["name"]] = parent["name"]
        self.assertEqual(len(expected), 16)
        self.assertEqual({s["name"]: s["bone"] for s in self.info["sections"] if s["name"] not in CUT}, expected)

    def test_the_skinned_body_is_cut_into_a_section_for_each_of_its_bones(self):
        """The bones that have no mesh of their own; in liz.obj and lizart.obj three sections hang on them."""
        self.assertEqual({s["name"]: s["bone"] for s in self.info["sections"] if s["name"] in CUT}, CUT)
        bodies = {b.get("name"): b for b in ElementTree.parse(self.file).getroot().findall("soft_body")}
        self.assertEqual({name for name, body in bodies.items() if body.get("derived")}, set(CUT))
        self.assertNotIn("EMBEDDING_NO_BODY", [m["code"] for m in self.json_of("validate", self.file)["messages"]])

    def test_vertices_are_welded_within_sections_by_their_bits(self):
        for section in self.info["sections"]:
            if section["name"] not in CUT:
                self.assertEqual(section["vertices"], len(self.distinct[section["name"]]), section["name"])

    def test_the_skinned_body_is_a_render_mesh_with_its_weights(self):
        tree = ElementTree.parse(self.file).getroot()
        mesh = next(m for m in tree.findall("render_mesh") if m.find("skin") is not None)
        counts = [int(n) for n in numbers(mesh, "skin/influence_counts")]
        weights, at = numbers(mesh, "skin/weights"), 0
        self.assertEqual(len(counts), len(triples(numbers(mesh, "polygon_mesh/positions"))))
        for count in counts:
            self.assertAlmostEqual(sum(weights[at:at + count]), 1, delta=1e-4)
            at += count
        self.assertEqual(len(numbers(mesh, "polygon_mesh/polygon_sizes")), 80)

    def test_bones_are_the_joints_of_the_skin(self):
        joints = {self.document["nodes"][j]["name"] for j in self.document["skins"][0]["joints"]}
        self.assertEqual({b["name"] for b in self.info["bones"]}, joints)
        self.assertEqual(len(self.info["bones"]), 20)

    def test_it_has_legs(self):
        self.assertEqual(self.info["gait"]["legs"], 4)


if __name__ == "__main__":
    main()
