"""Tests characters of unknown users: beside the origin, several in a file, lying, tiny. Each walks, or a message says what to do."""

import json
import re

from bundle_file import Bundle, matrix_of
from sbfmt_program import SOURCE_PARTS, ProgramTest, main, read_bytes, read_text, write_bytes
from skinned_glb import SkinnedGlb, box
from stranger_rigs import add_person, people, turned, write_person_bvh, write_person_obj
from textured_box import png_of


class StrangerRigs(ProgramTest):
    def converted(self, *placed, options=()):
        """The messages of the conversion of a file with people at these positions."""
        people(self.path("in.glb"), *placed)
        return self.good("convert", self.path("in.glb"), *SOURCE_PARTS, *options, "-o", self.path("out.sbf")).err

    def walk(self, *options):
        return self.json_of("run", self.path("out.sbf"), "--seconds", "2", "--drive", "0.4,0.3", *options)

    def test_a_character_beside_the_origin_walks_equally(self):
        self.converted(matrix_of())
        expected = self.walk()
        self.assertGreater(expected["distance"], 0.3)
        printed = self.converted(matrix_of((2, 0, 0)))
        self.assertIn("[IMPORT_GROUND]", printed)
        self.assertNotIn("[RIG_NO_LEGS]", printed)
        self.assertEqual(self.walk()["steps_taken"], expected["steps_taken"])
        self.assertAlmostEqual(self.walk()["distance"], expected["distance"], delta=1e-4)
        self.assertIn("[IMPORT_GROUND]", self.converted(turned("y", 90, (2, 0, 3))))
        self.assertAlmostEqual(self.walk()["distance"], expected["distance"], delta=0.05)

    def test_a_second_character_is_named(self):
        for placed in ([(0, 0, 0), (2, 0, 0)], [(-1, 0, 0), (1, 0, 0)], [(1, 0, 1), (-4, 0, 0)]):
            printed = self.converted(*map(matrix_of, placed))
            self.assertRegex(printed, r"only the skeleton of 'p1_hips', and the skeleton of 'p2_hips' .* its own file \[RIG_OTHER_SKELETON\]")
            self.assertEqual(set(self.walk()["steps_taken"]), {"p1_foot.L", "p1_foot.R"})
        printed = self.converted(*(matrix_of((x, 0, 0)) for x in (0, 2, 4)), options=("--verbose",))
        self.assertEqual(printed.count("[RIG_OTHER_SKELETON]"), 2)
        self.assertNotIn("RIG_OTHER_SKELETON", self.converted(matrix_of()))

    def test_a_lying_character_gets_advice_how_to_stand(self):
        printed = self.converted(turned("x", 90, (0, 0.2, 0)))
        self.assertRegex(printed, r"legs point along -Z .*: stand it up with --up z \[RIG_LIES\]")
        printed = self.converted(turned("x", 90, (0, 0.2, 0)), options=("--up", "z"))
        self.assertNotIn("[RIG_LIES]", printed)
        self.assertGreater(self.walk()["distance"], 0.3)
        self.assertIn("--up y [RIG_LIES]", self.converted(matrix_of(), options=("--up", "z")))
        self.assertRegex(self.converted(turned("x", -90, (0, 0.2, 0))), r"along \+Z .* in its program .*\[RIG_LIES\]")
        self.assertRegex(self.converted(turned("z", 180, (0, 1.8, 0))), r"along \+Y .* on its head.*\[RIG_LIES\]")
        self.assertNotIn("[RIG_LIES]", self.converted(turned("y", 180)))

    def source_parts(self, name):
        """The converted file without the title and the sources, which include its name."""
        self.good("convert", self.path(name), *SOURCE_PARTS, "-o", self.path("out.sbf"))
        text = read_text(self.path("out.sbf"))
        return re.sub(r'<source [^>]*>| title="[^"]*"', "", text)

    def test_a_gltf_finds_files_whose_names_have_blanks(self):
        """As exporters write them: percent-encoded, or as they are."""
        glb = SkinnedGlb()
        add_person(glb)
        glb.json["images"] = [{"uri": "my%20skin.png"}]
        glb.json["textures"] = [{"source": 0}]
        glb.json["materials"] = [{"name": "skin", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
        glb.json["meshes"][0]["primitives"][0]["material"] = 0
        write_bytes(self.path("my skin.png"), png_of(2, 2, (200, 0, 0)))
        write_bytes(self.path("my d\u00e4ta.bin"), glb.binary)
        found = []
        for uri in ("my%20d%C3%A4ta.bin", "my d\u00e4ta.bin"):
            glb.json["buffers"] = [{"byteLength": len(glb.binary), "uri": uri}]
            write_bytes(self.path("in.gltf"), json.dumps({k: v for k, v in glb.json.items() if v != []}).encode())
            found.append(self.source_parts("in.gltf"))
            self.assertIn('path="my skin.png"', found[-1])
        self.assertEqual(*found)
        glb.json["buffers"][0]["uri"] = "gone.bin"
        write_bytes(self.path("in.gltf"), json.dumps({k: v for k, v in glb.json.items() if v != []}).encode())
        printed = self.fails(1, "convert", self.path("in.gltf"), "-o", self.path("none.sbf"))
        self.assertRegex(printed, r'"gone.bin"; put the referenced file at that path.*\[IMPORT_REFUSED\]')

    def test_a_binary_gltf_of_any_name_is_read_as_one(self):
        people(self.path("in.glb"), matrix_of())
        expected, content = self.source_parts("in.glb"), read_bytes(self.path("in.glb"))
        for name in ("in.vrm", "in.fbx", "in"):
            with self.subTest(name):
                write_bytes(self.path(name), content)
                self.assertEqual(self.source_parts(name), expected)

    def test_the_unit_of_a_mesh_on_motion_capture_is_the_mesh_s(self):
        for mesh, bones, unit in ((1 / 0.0254, 100, "0.0254"), (100, 1 / 0.0254, "0.01"), (1000, 100, "0.001"),
                                  (1 / 0.3048, 100, "0.3048")):
            with self.subTest(unit):
                files = (write_person_obj(self.path("in.obj"), mesh), "--rig", write_person_bvh(self.path("in.bvh"), bones))
                printed = self.good("convert", *files, *SOURCE_PARTS, "-o", self.path("out.sbf")).err
                found = re.search(r"the input measures (\S+) of its units, the bones of \S*in.bvh measure (\S+) of theirs, .* "
                                  r"--unit (\S+) for the input, which makes it (\S+) m.*\[UNIT_LOOKS_WRONG\]", printed)
                self.assertTrue(found, printed)
                self.assertEqual(found.group(3), unit)
                self.assertAlmostEqual(float(found.group(1)), 1.79 * mesh, delta=0.02 * mesh)
                self.assertAlmostEqual(float(found.group(2)), 1.46 * bones, delta=0.02 * bones)
                self.assertAlmostEqual(float(found.group(4)), 1.79, delta=0.02)
                printed = self.good("convert", *files, "--unit", unit, *SOURCE_PARTS, "-o", self.path("out.sbf")).err
                self.assertNotIn("UNIT_LOOKS_WRONG", printed)
                low, high = (self.json_of("info", self.path("out.sbf"))["bounds"][k][1] for k in ("min", "max"))
                self.assertAlmostEqual(high - low, 1.79, delta=0.02)

    def test_motion_capture_of_blender_has_the_pose_of_the_input(self):
        """Blender writes the armature's own axes, and bones without a parent below a root that it invents."""
        mesh = write_person_obj(self.path("in.obj"), 1)
        for axes, rotated in ((("x", "-y", "-z"), "by 180 degrees about x"), (("x", "-z", "y"), "by -90 degrees about x")):
            for loose in ((), ("foot.L", "foot.R")):
                with self.subTest(axes=axes, loose=loose):
                    rig = write_person_bvh(self.path("in.bvh"), 1, axes, loose)
                    printed = self.good("convert", mesh, "--rig", rig, *SOURCE_PARTS, "-o", self.path("out.sbf"), "--verbose").err
                    self.assertRegex(printed, rf"in.bvh states no axes, .* the rig was rotated {rotated};.*\[RIG_ALIGNED\]")
                    self.assertNotIn("[RIG_LIES]", printed)
                    self.assertEqual(printed.count("[RIG_BONE_REHUNG]"), len(loose))
                    self.assertNotIn("__0", read_text(self.path("out.sbf")))
                    report = self.walk()
                    self.assertEqual(set(report["steps_taken"]), {"foot.L", "foot.R"})
                    self.assertGreater(report["distance"], 0.3)

    def test_a_floor_does_not_determine_the_unit(self):
        glb = SkinnedGlb()
        add_person(glb)
        glb.node("Floor", mesh=glb.mesh(*box((-50, -0.1, -50), (50, 0, 50))))
        glb.write(self.path("in.glb"))
        printed = self.good("convert", self.path("in.glb"), *SOURCE_PARTS, "-o", self.path("out.sbf")).err
        self.assertRegex(printed, r"object 'Floor' measures 100 m, the bones measure 1.4\d* m.*\[UNIT_LOOKS_WRONG\]")
        self.assertNotIn("--unit", printed)

    def test_no_unit_is_proposed_that_the_option_refuses(self):
        self.assertIn("scale it in its program", self.converted(matrix_of(scale=(1e-15,) * 3)))
        printed = self.converted(matrix_of(scale=(1e-6,) * 3))
        unit = re.search(r"--unit (\S+), which makes it", printed).group(1)
        self.converted(matrix_of(scale=(1e-6,) * 3), options=("--unit", unit))

    def test_equal_names_of_nodes_are_reported_with_a_remedy(self):
        glb = SkinnedGlb()
        for i in range(2):
            add_person(glb, f"person{i}", matrix_of((2 * i, 0, 0)))
        glb.write(self.path("in.glb"))
        printed = self.good("convert", self.path("in.glb"), *SOURCE_PARTS, "--verbose", "-o", self.path("out.sbf")).err
        self.assertRegex(printed, r'several nodes have the name "hips", .*the skins of all follow the first one, and lie on it; '
                               r'give the bones of each armature their own names, or export each .*\[IMPORT_NAME_AMBIGUOUS\]')
        self.assertEqual(printed.count("IMPORT_NAME_AMBIGUOUS"), 1)
        for mesh in Bundle(self.path("out.sbf")).meshes:  # both on the first
            self.assertLess(max(abs(x) for x, _, _ in Bundle(self.path("out.sbf")).positions(mesh)), 1)

    def test_a_tiny_one_has_steps_that_a_tick_resolves(self):
        self.converted(matrix_of(scale=(1 / 1800,) * 3))
        codes = {m["code"] for m in self.json_of("validate", self.path("out.sbf"))["messages"]}
        self.assertEqual(codes, {"UNIT_LOOKS_WRONG"})
        report = self.json_of("run", self.path("out.sbf"), "--seconds", "5", "--drive", "0.0002,0")
        self.assertGreater(report["distance"], 0.0002)
        self.assertGreater(min(report["steps_taken"].values()), 0)

    def test_a_vertical_speed_of_a_walker_is_reported(self):
        self.converted(matrix_of())
        for verb in ("run", "render"):
            out = ("-o", self.path("out.png"), "--size", "64x48") if verb == "render" else ()
            options = (self.path("out.sbf"), "--seconds", "0.1", *out)
            self.assertRegex(self.good(verb, *options, "--drive", "0.2,0,0.5").err, "warning: the vertical speed of --drive is ignored.*walk")
            self.assertNotIn("vertical", self.good(verb, *options, "--drive", "0.2,0,0").err)

    def test_an_export_without_a_motion_refuses_its_options(self):
        self.converted(matrix_of())
        printed = self.fails(2, "export", self.path("out.sbf"), "--drive", "1,0", "-o", self.path("out.glb"))
        self.assertIn("--drive is for a motion", printed)
        self.assertIn("leave out --fps", self.fails(2, "export", self.path("out.sbf"), "--fps", "25", "-o", self.path("out.obj")))
        self.good("export", self.path("out.sbf"), "--drive", "1,0", "--seconds", "0.1", "-o", self.path("out.glb"))


if __name__ == "__main__":
    main()
