"""Characters as binary glTF: packed and unpacked to the same bytes, shown by viewers, simulated, and refused where damaged."""

import glob
import json
import os
import shutil
import struct

import json_schema
import play_files
import textured_box
from glb_file import Glb
from sbfmt_program import ProgramTest, ROOT, call, example, main, read_bytes, shared, write_bytes

EXTENSION = "SBF_soft_body"
VALID = os.path.join(ROOT, "spec", "samples", "valid")
SCHEMA = os.path.join(ROOT, "spec", "gltf", EXTENSION, "schema", EXTENSION + ".schema.json")


def glb_of(document, binary):
    """Bytes of a binary glTF."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(binary)
    return (struct.pack("<4sII", b"glTF", 2, size) + struct.pack("<I4s", len(text), b"JSON") + text +
            struct.pack("<I4s", len(binary), b"BIN\0") + binary)


class GlbBundles(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.xml = example(cls.class_folder.name)
        cls.glb = cls.made("example.glb")
        result = call("pack", cls.xml, "-o", cls.glb)
        assert result.status == 0, result.err

    def assert_goes_round(self, bundle):
        packed, out, again = self.path("a.glb"), self.path("a.sbf"), self.path("b.glb")
        self.good("pack", bundle, "-o", packed)
        self.good("unpack", packed, "-o", out)
        self.assertEqual(read_bytes(out), read_bytes(bundle), bundle)
        self.good("pack", out, "-o", again)
        self.assertEqual(read_bytes(again), read_bytes(packed), bundle)
        return packed

    def test_it_round_trips_to_the_same_bytes(self):
        self.assert_goes_round(self.xml)
        self.good("pack", self.xml, "-o", self.path("stored.glb"), "--store")
        self.good("unpack", self.path("stored.glb"), "-o", self.path("stored.sbf"))
        self.assertEqual(read_bytes(self.path("stored.sbf")), read_bytes(self.xml))
        self.good("diff", self.xml, self.glb)

    def test_every_sample_round_trips(self):
        shutil.copytree(os.path.join(VALID, "textures"), self.path("textures"))
        for sample in sorted(glob.glob(os.path.join(VALID, "*.sbf"))):
            canonical = self.path(os.path.basename(sample))
            self.good("unpack", sample, "-o", canonical)
            self.assert_goes_round(canonical)

    def test_files_of_other_programs_round_trip(self):
        zoo = sorted(glob.glob(os.path.join(shared(os.pardir, "zoo"), "*", "*.glb")))
        if not zoo:
            self.skipTest("no shared data")
        for source in zoo[::9]:
            made = self.path("stranger.sbf")
            self.good("convert", source, "-o", made)
            self.assert_goes_round(made)

    def test_it_moves_as_the_bundle_does(self):
        drive = ("--seconds", "1", "--drive", "0.3,0.2")
        self.assertEqual(self.json_of("run", self.glb, *drive)["state_hash"], self.json_of("run", self.xml, *drive)["state_hash"])

    def test_every_verb_reads_it(self):
        self.good("validate", self.glb)
        self.assertEqual(self.json_of("info", self.glb)["sections"], self.json_of("info", self.xml)["sections"])
        self.good("render", self.glb, "-o", self.path("a.png"), "--size", "64x48")
        self.good("build", self.glb, "-o", self.path("built.glb"))
        self.good("export", self.glb, "-o", self.path("a.obj"))
        self.good("convert", self.glb, "-o", self.path("same.sbf"), "--no-build")
        self.assertEqual(len(self.json_of("info", self.path("same.sbf"))["sections"]), len(self.json_of("info", self.xml)["sections"]))

    def test_convert_writes_one(self):
        self.good("convert", os.path.join(ROOT, "examples", "lizard", "lizard_skin.glb"), "-o", self.path("c.glb"))
        self.good("convert", os.path.join(ROOT, "examples", "lizard", "lizard_skin.glb"), "-o", self.path("c.sbf"))
        self.good("diff", self.path("c.glb"), self.path("c.sbf"))

    def test_the_meshes_are_there_once(self):
        """The extension holds no copy of what the glTF has."""
        found = Glb(self.glb).json["extensions"][EXTENSION]
        for mesh in found["render_meshes"]:
            self.assertTrue(mesh["mesh"]["positions"]["gltf"])
            self.assertNotIn("bufferView", mesh["mesh"]["positions"])
            self.assertTrue(mesh["mesh"]["polygon_points"]["gltf"])

    def test_the_extension_follows_its_schema(self):
        with open(SCHEMA, encoding="utf-8") as file:
            schema = json.load(file)
        everything = self.path("everything.glb")
        self.good("pack", os.path.join(VALID, "everything.sbf"), "-o", everything)
        for path in (self.glb, everything):
            self.assertEqual(json_schema.faults(Glb(path).json["extensions"][EXTENSION], schema), [])

    @play_files.needs_node
    def test_the_validator_finds_no_error(self):
        issues = play_files.node("validate_gltf.mjs", self.glb)["issues"]
        self.assertEqual((issues["numErrors"], issues["numWarnings"]), (0, 0), issues["messages"])

    def test_images_beside_a_bundle_travel_in_it(self):
        image = textured_box.png_of(8, 8, (255, 0, 0))
        bundle, elsewhere = self.path("box.sbf"), os.path.join(self.folder, "elsewhere")
        self.good("convert", textured_box.write(self.folder, image), "-o", bundle)
        os.mkdir(elsewhere)
        moved, out = os.path.join(elsewhere, "box.glb"), os.path.join(elsewhere, "box.sbf")
        self.good("pack", bundle, "-o", moved)
        shown = self.good("render", moved, "-o", self.path("box.png"), "--size", "64x48")
        self.assertNotIn("IMAGE_NOT_DRAWN", shown.err)
        self.good("build", moved, "-o", os.path.join(elsewhere, "again.glb"))
        self.assertEqual(len(Glb(os.path.join(elsewhere, "again.glb")).json["images"]), 1)
        self.good("unpack", moved, "-o", out)
        self.assertEqual(read_bytes(out), read_bytes(bundle))
        self.assertEqual(read_bytes(os.path.join(elsewhere, "red.png")), image)

    def changed(self, change):
        document = Glb(self.glb)
        change(document.json)
        return write_bytes(self.path("changed.glb"), glb_of(document.json, document.binary))

    def test_a_change_of_the_mesh_is_reported(self):
        document = Glb(self.glb)
        primitive = document.json["meshes"][0]["primitives"][0]
        view = document.json["bufferViews"][document.json["accessors"][primitive["attributes"]["POSITION"]]["bufferView"]]
        moved = bytearray(document.binary)
        struct.pack_into("<f", moved, view["byteOffset"], 7.5)
        path = write_bytes(self.path("moved.glb"), glb_of(document.json, bytes(moved)))
        self.assertIn("GLTF_CHANGED", self.fails(1, "validate", path))

    def renumbered(self, bundle):
        """The bundle as a .glb whose nodes, meshes, clips and images another program reversed, the extension's text as it was."""
        packed, changed = self.path("packed.glb"), self.path("renumbered.glb")
        self.good("pack", bundle, "-o", packed)
        glb = Glb(packed)
        document, last = glb.json, {name: len(glb.json.get(name, ())) - 1 for name in ("nodes", "meshes", "images", "animations")}
        for name, end in last.items():
            if end >= 0:
                document[name].reverse()
        for node in document["nodes"]:
            if "mesh" in node:
                node["mesh"] = last["meshes"] - node["mesh"]
            if "children" in node:
                node["children"] = [last["nodes"] - child for child in node["children"]]
            node.pop("extensions", None)  # names nodes as well
        document["extensions"] = {EXTENSION: document["extensions"][EXTENSION]}
        for scene in document["scenes"]:
            scene["nodes"] = [last["nodes"] - node for node in scene["nodes"]]
        for skin in document.get("skins", ()):
            skin["joints"] = [last["nodes"] - joint for joint in skin["joints"]]
            skin["skeleton"] = last["nodes"] - skin["skeleton"]
        for texture in document.get("textures", ()):
            if "source" in texture:
                texture["source"] = last["images"] - texture["source"]
        for animation in document.get("animations", ()):
            for channel in animation["channels"]:
                channel["target"]["node"] = last["nodes"] - channel["target"]["node"]
        write_bytes(changed, glb_of(document, glb.binary))
        return packed, changed

    def test_renumbered_parts_are_found_and_rewritten(self):
        for bundle in (self.xml, os.path.join(VALID, "everything.sbf")):
            packed, changed = self.renumbered(bundle)
            printed = self.fails(1, "validate", changed)
            self.assertIn("GLTF_CHANGED", printed)
            self.assertIn("`sbfmt validate --fix`", printed)
            fixed = self.path("fixed.glb")
            done = self.json_of("validate", changed, "--fix", "-o", fixed)["fixed"]
            self.assertTrue({"GLTF_RENUMBERED"} <= {one["code"] for one in done})
            self.assertTrue(any("meshes is now number" in one["message"] and "checksum" in one["message"] for one in done))
            self.good("validate", fixed)
            self.good("diff", packed, fixed)

    def test_a_moved_point_is_not_repaired(self):
        packed, changed = self.renumbered(self.xml)
        glb = Glb(changed)
        accessor = glb.json["accessors"][glb.json["meshes"][-1]["primitives"][0]["attributes"]["POSITION"]]
        view = glb.json["bufferViews"][accessor["bufferView"]]
        binary = bytearray(glb.binary)
        binary[view.get("byteOffset", 0)] ^= 1
        write_bytes(changed, glb_of(glb.json, bytes(binary)))
        self.assertIn("GLTF_CHANGED", self.fails(1, "validate", changed, "--fix", "-o", self.path("fixed.glb")))
        self.assertFalse(os.path.exists(self.path("fixed.glb")))

    def test_foreign_files_are_reported(self):
        path = self.changed(lambda document: document.pop("extensions"))
        printed = self.fails(1, "info", path)
        self.assertIn("GLTF_NO_SOFT_BODY", printed)
        self.assertIn("sbfmt convert", printed)
        path = self.changed(lambda document: document["extensions"][EXTENSION].update(unheard_of=1))
        self.assertIn("unheard_of", self.fails(1, "info", path))

    def test_a_newer_version_is_read_with_a_warning(self):
        def newer(document):
            document["extensions"][EXTENSION].update(version="1.99", unheard_of={"a": [1]})
        result = call("info", self.changed(newer))
        self.assertEqual(result.status, 0, result.err)
        self.assertIn("VERSION_NEWER", result.err)

    def test_edits_beside_the_character_are_kept_out_of_it(self):
        def add(document):
            document["nodes"].append({"name": "Lamp"})
            document["scenes"][0]["nodes"].append(len(document["nodes"]) - 1)
            document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = [1, 0, 0, 1]
        self.good("diff", self.changed(add), self.xml)


if __name__ == "__main__":
    main()
