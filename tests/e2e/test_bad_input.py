"""Tests faulty inputs and calls: the message names the fault and its location, the exit status is right, no file is left
behind, and the program does not crash even if a third-party reader does."""

import json
import os
import re
import unittest

from sbfmt_program import (ProgramTest, ROOT, call, example, main, needs_bad_files, needs_lizard, read_bytes, shared,
                           write_bytes)

SAMPLES = os.path.join(ROOT, "spec", "samples", "valid")
BAD_INPUT, FAILED = 1, 2
CUBE = b"""v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


@needs_bad_files
class FilesThatBreakOthers(ProgramTest):
    # In the md5mesh assimp writes beyond its memory: whether it dies of it is chance.
    CODES = {"empty.obj": "IMPORT_EMPTY", "malformed.obj": "IMPORT_INDEX", "malformed2.obj": "IMPORT_POLYGON",
             "empty_init_from.dae": "IMPORT_CRASHED", "md5_overflow_vertex.md5mesh": "IMPORT_(CRASHED|EMPTY)",
             "position_bad_count.dae": "IMPORT_EMPTY"}

    def test_every_file_is_refused_with_its_code(self):
        for name, code in self.CODES.items():
            with self.subTest(name):
                message = self.fails(BAD_INPUT, "convert", shared("bad", name), "-o", self.path("out.sbf"))
                self.assertRegex(message, rf"\[{code}\]")
                self.assertIn(name, message)
                self.assert_empty_folder()

    def test_the_table_is_complete(self):
        self.assertEqual(set(os.listdir(shared("bad"))) - {"README.md"}, set(self.CODES))

    def test_messages_of_libraries_become_part_of_the_sentence(self):
        whole = read_bytes(os.path.join(ROOT, "examples", "lizard", "lizard.glb"))
        half = write_bytes(self.path("half.glb"), whole[:len(whole) // 2])
        message = self.fails(BAD_INPUT, "convert", half, "-o", self.path("out.sbf"))
        self.assertRegex(message, r"assimp refuses the file: .*[^.]; export it as .*\[IMPORT_REFUSED\]")
        self.assert_empty_folder(but=["half.glb"])

    def test_packed_meshes_of_gltf_are_refused_by_their_extension(self):
        """Read as plain floats, the numbers of quantized vertices would be any shape at all."""
        for name in ("KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_meshopt_compression"):
            gltf = {"asset": {"version": "2.0"}, "extensionsUsed": [name], "extensionsRequired": [name]}
            packed = write_bytes(self.path("packed.gltf"), json.dumps(gltf).encode())
            message = self.fails(BAD_INPUT, "convert", packed, "-o", self.path("out.sbf"))
            self.assertIn(f"compressed by {name}, which is not supported: export them without compression", message)
            self.assert_empty_folder(but=["packed.gltf"])

    def test_a_failure_keeps_the_old_file(self):
        out = write_bytes(self.path("out.sbf"), b"what was there")
        self.fails(BAD_INPUT, "convert", shared("bad", "empty_init_from.dae"), "-o", out)
        self.assertEqual(read_bytes(out), b"what was there")
        self.assert_empty_folder(but=["out.sbf"])

    def test_several_inputs_end_with_the_worst_status_and_the_good_ones_are_written(self):
        good = os.path.join(ROOT, "examples", "lizard", "lizard.glb")
        self.fails(BAD_INPUT, "convert", shared("bad", "malformed.obj"), good, shared("bad", "empty.obj"), "--out-dir",
                   self.folder)
        self.assert_empty_folder(but=["lizard.sbf", ".sbfmt", "summary.tsv"])


class BundlesThatAreNotValid(ProgramTest):
    OVERLAP = (("o.node", b"5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .1 .1 .8\n"),
               ("o.ele", b"2 4 0\n1 1 2 3 4\n2 1 2 3 5\n"))

    def test_invalid_assets_are_never_written(self):
        for name, content in self.OVERLAP:
            write_bytes(self.path(name), content)
        for ending in ("sbf", "sbfz"):
            for was in (None, b"what was there"):
                out = self.path("out." + ending)
                if was:
                    write_bytes(out, was)
                message = self.fails(BAD_INPUT, "convert", self.path("o.ele"), "-o", out)
                self.assertIn("[LATTICE_OVERLAP]", message)
                self.assertIn("was not written", message)
                self.assertEqual(os.path.exists(out) and read_bytes(out), was or False)
        self.assert_empty_folder(but=["o.node", "o.ele", "out.sbf", "out.sbfz"])

    def test_the_good_ones_of_several_are_written(self):
        for name, content in (*self.OVERLAP, ("cube.obj", CUBE)):
            write_bytes(self.path(name), content)
        self.fails(BAD_INPUT, "convert", self.path("o.ele"), self.path("cube.obj"), "--out-dir", self.path("out"))
        self.assertEqual(sorted(os.listdir(self.path("out"))), [".sbfmt", "cube.sbf", "summary.tsv"])

    def test_repairable_faults_are_repaired_and_reported(self):
        """Repeated tetrahedra, a leaf drawn from both sides, an image path that leads out of the folder."""
        flat = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 4 3 2 1\n"
        for name, content in (("r.node", self.OVERLAP[0][1]), ("r.ele", b"2 4 0\n1 1 2 3 4\n2 1 2 3 4\n"),
                              ("flat.obj", flat), ("lwo.obj", b"mtllib lwo.mtl\nusemtl m\n" + CUBE),
                              ("lwo.mtl", b"newmtl m\nmap_Kd /../LWO\n")):
            write_bytes(self.path(name), content)
        for name, reported in (("r.ele", "with the same four points"), ("flat.obj", ""), ("lwo.obj", "IMPORT_IMAGE")):
            with self.subTest(name):
                out = self.path(name + ".sbf")
                result = call("convert", self.path(name), "-o", out)
                self.assertEqual(result.status, 0, result.err)
                self.assertIn(reported, result.err)
                self.good("validate", out)


class Calls(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = example(cls.class_folder.name)

    def test_a_missing_file_is_a_system_error(self):
        absent = self.path("absent.sbf")
        for arguments in (("info", absent), ("validate", absent), ("pack", absent, "-o", self.path("x.sbfz")),
                          ("unpack", absent, "-o", self.path("x.sbf")), ("build", absent, "-o", self.path("x.sbf")),
                          ("run", absent), ("diff", absent, self.file),
                          ("convert", self.path("absent.obj"), "-o", self.path("x.sbf")),
                          ("convert", self.path("absent.fbx"), "-o", self.path("x.sbf"))):
            with self.subTest(arguments):
                self.assertIn("absent", self.fails(FAILED, *arguments))
        self.assert_empty_folder()

    def test_an_unwritable_output(self):
        nowhere = self.path("no such folder/out.sbf")
        for arguments in (("pack", self.file, "-o", nowhere + "z"), ("unpack", self.file, "-o", nowhere),
                          ("build", self.file, "-o", nowhere),
                          ("run", self.file, "--seconds", "0", "--cache", nowhere + ".pc2"),
                          ("run", self.file, "--seconds", "0", "--pose", nowhere + ".csv"),
                          ("convert", os.path.join(ROOT, "examples", "lizard", "lizard.glb"), "-o", nowhere)):
            with self.subTest(arguments):
                self.fails(FAILED, *arguments)
        self.assert_empty_folder()

    def test_a_folder_at_the_output_path(self):
        os.mkdir(self.path("out.sbf"))
        self.fails(FAILED, "unpack", self.file, "-o", self.path("out.sbf"))
        self.assertEqual(os.listdir(self.path("out.sbf")), [])
        self.assert_empty_folder(but=["out.sbf"])

    @unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full here")
    def test_a_full_standard_output(self):
        mesh = write_bytes(self.path("cube.obj"), CUBE)
        still = ("run", self.file, "--seconds", "0.05", "--hold")
        for arguments in (("--help",), ("--version",), ("help", "run"), ("run", "--help"), ("info", self.file),
                          ("info", self.file, "--format", "json"), ("validate", self.file),
                          ("validate", self.file, "--format", "json"), still, (*still, "--format", "json"),
                          ("convert", mesh, "-o", self.path("cube.sbf")),
                          ("build", self.path("cube.sbf"), "-o", self.path("again.sbf")),
                          ("diff", self.file, self.path("cube.sbf"))):
            with self.subTest(arguments), open("/dev/full", "wb") as full:
                result = call(*arguments, output=full)
                self.assertEqual(result.status, FAILED)
                self.assertIn("error: standard output could not be written", result.err)

    @unittest.skipUnless(os.path.exists("/dev/full"), "no /dev/full here")
    def test_failed_writes_are_not_reported_as_built(self):
        mesh = write_bytes(self.path("cube.obj"), CUBE)
        for arguments in (("convert", mesh, "--elements", "100"), ("build", self.file)):
            with self.subTest(arguments):
                result = call(*arguments, "-o", "/dev/full")
                self.assertEqual(result.status, FAILED)
                self.assertIn("[IO_CANNOT_WRITE]", result.err)
                self.assertEqual(result.out, "")

    def test_a_folder_as_output_is_reported_before_the_work(self):
        mesh = write_bytes(self.path("cube.obj"), CUBE)
        for arguments in (("convert", mesh), ("build", self.file), ("pack", self.file), ("export", self.file)):
            with self.subTest(arguments):
                result = call(*arguments, "-o", self.folder)
                self.assertEqual(result.status, FAILED)
                self.assertRegex(result.err, r"\Asbfmt \w+: error: -o .* is a folder; name a file in it, for example out\.\w+\n\Z")
        self.assert_empty_folder(but=["cube.obj"])

    def test_options_that_would_do_nothing_are_refused(self):
        for option in (("--rig", self.file), ("--unit", "2"), ("--gait", "fly"), ("--soft", "*"), ("--weights", "match")):
            printed = self.fails(FAILED, "convert", self.file, *option, "-o", self.path("x.sbf"))
            self.assertIn(f"is a bundle, which {option[0]} does not change", printed)
        self.assertIn("--of selects the content of a point cache", self.fails(FAILED, "run", self.file, "--of", "skin"))
        self.assertIn("unexpected input '0.2'", self.fails(FAILED, "run", self.file, "--drive", "0.5", "0.2"))
        self.assert_empty_folder()

    def test_remedies_of_unusual_inputs(self):
        self.assertIn("save its content to a file", self.fails(FAILED, "convert", "/dev/null", "-o", self.path("x.sbf")))
        comma = write_bytes(self.path("comma.obj"), CUBE.replace(b"v 1 0 0", b"v 1,0 0 0"))
        self.assertIn('found "1,0" where a line "v" needs a number: use a decimal point',
                      self.fails(BAD_INPUT, "convert", comma, "-o", self.path("x.sbf")))

    def test_pipes_are_refused_before_they_are_opened(self):
        """They have no writer: opening one would not return."""
        mesh = write_bytes(self.path("cube.obj"), CUBE)
        for name in ("p.obj", "p.xml", "p.vtk", "p.glb", "p.sbf"):
            pipe = self.path(name)
            os.mkfifo(pipe)
            for arguments in ((pipe,), (mesh, "--rig", pipe), (mesh, "--motion", pipe)):
                with self.subTest(name, arguments=arguments[1:-1]):
                    printed = self.fails(FAILED, "convert", *arguments, "-o", self.path("x.sbf"), timeout=20)
                    self.assertIn(f"{pipe}: this is a pipe or a device: save its content to a file", printed)
            os.remove(pipe)
        self.assert_empty_folder(but=["cube.obj"])

    def test_contradictory_inputs_and_outputs(self):
        self.assertIn("standard input is not supported", self.fails(FAILED, "info", "-"))
        printed = self.fails(FAILED, "unpack", self.file, "-o", self.path("a.sbf"), "-o", self.path("b.sbf"))
        self.assertIn("-o is given twice", printed)
        self.assert_empty_folder()

    def test_wrong_calls(self):
        for arguments in ((), ("frobnicate",), ("info",), ("info", self.file, self.file), ("info", "--no-such"),
                          ("info", self.file, "--format", "xml"), ("pack", self.file), ("pack", self.file, "-o"),
                          ("pack", self.file, "-o", self.path("x"), "--level", "10"), ("diff", self.file),
                          ("convert", self.file), ("convert", self.file, "-o", "a", "--out-dir", "b"),
                          ("convert", self.file, "-o", self.path("x"), "--unit", "0"),
                          ("convert", self.file, "-o", self.path("x"), "--up", "x"),
                          ("build", self.file, "-o", self.path("x"), "--springs", "rubber"),
                          ("run", self.file, "--seconds", "-1"), ("run", self.file, "--seconds", "nan"),
                          ("run", self.file, "--drive", "0.5"), ("run", self.file, "--drive", "0.5,0.2,1,2"),
                          ("run", self.file, "--ground", "mud"), ("run", self.file, "--ground", "slope:60"),
                          ("run", self.file, "--scheme", "magic"), ("run", self.file, "--threads", "0"),
                          ("run", self.file, "--cache", self.path("x.pc2"), "--of", "hair")):
            with self.subTest(arguments):
                result = call(*arguments)
                self.assertEqual(result.status, FAILED, result.err)
                self.assertTrue(result.err or "Usage" in result.out)
        self.assert_empty_folder()

    def test_inputs_are_never_overwritten(self):
        """A file that is written has an ending of its own form."""
        mesh = write_bytes(self.path("cube.obj"), CUBE)
        bundle = self.path("cube.sbf")
        self.good("convert", mesh, "-o", bundle)
        was = read_bytes(bundle)
        for arguments in (("convert", mesh, "-o", mesh), ("build", bundle, "-o", mesh), ("pack", bundle, "-o", bundle),
                          ("validate", bundle, "--fix", "-o", mesh), ("unpack", bundle, "-o", "-"),
                          ("tune", bundle, "-o", mesh), ("export", bundle, "-o", bundle),
                          ("run", bundle, "--cache", bundle), ("run", bundle, "--pose", bundle),
                          ("run", bundle, "--record", bundle)):
            with self.subTest(arguments):
                self.assertIn("a name with", self.fails(FAILED, *arguments))
                self.assertEqual((read_bytes(mesh), read_bytes(bundle)), (CUBE, was))
        self.good("pack", bundle, "-o", self.path("CUBE.SBFZ"))
        self.assert_empty_folder(but=["cube.obj", "cube.sbf", "CUBE.SBFZ"])

    def test_inputs_of_one_name_do_not_replace_each_other(self):
        for folder in ("a", "b", "c/a"):
            os.makedirs(self.path(folder))
            write_bytes(self.path(folder + "/cube.obj"), CUBE)
        write_bytes(self.path("b/other.obj"), CUBE)
        one, two, three = (self.path(name) for name in ("a/cube.obj", "b/cube.obj", "c/a/cube.obj"))
        message = self.fails(FAILED, "convert", one, three, "--out-dir", self.path("out"))
        self.assertIn("would both become", message)
        self.assert_empty_folder(but=["a", "b", "c"])
        self.good("convert", one, two, self.path("b/other.obj"), "--out-dir", self.path("out"), "--no-build")
        self.assertEqual(sorted(os.listdir(self.path("out"))), [".sbfmt", "a-cube.sbf", "b-cube.sbf", "other.sbf", "summary.tsv"])

    def test_the_output_folder_is_created(self):
        mesh, folder = write_bytes(self.path("cube.obj"), CUBE), self.path("out")
        self.good("convert", mesh, "--out-dir", folder)
        self.assertEqual(sorted(os.listdir(folder)), [".sbfmt", "cube.sbf", "summary.tsv"])
        self.good("convert", mesh, "--out-dir", folder)
        self.assertIn("make it first", self.fails(FAILED, "convert", mesh, "--out-dir", self.path("no/such")))
        self.assertIn("name a folder", self.fails(FAILED, "convert", mesh, "--out-dir", mesh))

    def test_a_missing_location_is_reported_before_the_work(self):
        mesh = write_bytes(self.path("cube.obj"), CUBE)
        result = call("convert", mesh, "-o", self.path("no/such.sbf"))
        self.assertEqual((result.status, result.out), (FAILED, ""))
        self.assertIn("make it first", result.err)

    def test_a_link_to_nothing_is_not_replaced(self):
        for name, arguments in (("out.sbf", ("unpack", self.file, "-o")), ("p.csv", ("run", self.file, "--seconds", "0",
                                                                                    "--pose"))):
            with self.subTest(name):
                os.symlink("absent", self.path(name))
                self.fails(FAILED, *arguments, self.path(name))
                self.assertEqual(os.readlink(self.path(name)), "absent")
        self.assert_empty_folder(but=["out.sbf", "p.csv"])

    def test_help_of_a_verb(self):
        self.assertEqual(self.good("help", "info").out, self.good("info", "--help").out)
        self.assertEqual(self.good("help").out, self.good("--help").out)
        self.assertIn("no verb 'frobnicate'", self.fails(FAILED, "help", "frobnicate"))

    def test_help_is_printed(self):
        for arguments in (("--help",), ("--version",), ("info", "--help"), ("convert", "--help")):
            self.assertTrue(self.good(*arguments).out.startswith("sbfmt"), arguments)

    def test_every_verb_of_the_contract_is_there(self):
        text = self.good("--help").out
        for verb in ("convert", "build", "validate", "info", "pack", "unpack", "diff", "run", "render"):
            self.assertIn(f"\n  {verb} ", text)

    def test_a_missing_import_helper_is_named(self):
        message = self.fails(FAILED, "convert", os.path.join(ROOT, "examples", "lizard", "lizard.glb"), "-o",
                             self.path("x.sbf"), environment={"SBFMT_IMPORT_HELPER": self.path("absent")})
        self.assertIn("IMPORT_HELPER_MISSING", message)


class DamagedBundles(ProgramTest):
    """A bundle cut short anywhere, or with a byte changed, is either refused or read completely."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.xml = os.path.join(SAMPLES, "jelly.sbf")
        cls.packed = cls.made("jelly.sbfz")
        result = call("pack", cls.xml, "-o", cls.packed)
        assert result.status == 0, result.err

    def check_cut(self, path, lengths):
        content = read_bytes(path)
        for length in lengths(len(content)):
            cut = write_bytes(self.path("cut"), content[:length])
            result = call("info", cut)
            self.assertEqual(result.status, BAD_INPUT, f"{length} of {len(content)} bytes: {result.err}")
            self.assertIn("error: ", result.err)

    def test_xml_cut_short(self):
        self.check_cut(self.xml, lambda size: [*range(0, 60), *range(60, size - 8, 131), *range(size - 8, size - 1)])

    def test_packed_cut_short(self):
        self.check_cut(self.packed, lambda size: [*range(0, 130, 3), *range(130, size, 61), size - 1])

    def test_packed_with_a_byte_changed(self):
        content = bytearray(read_bytes(self.packed))
        for position in [*range(0, 64), *range(64, len(content), 47)]:
            content[position] ^= 0x5A
            changed = write_bytes(self.path("changed"), bytes(content))
            content[position] ^= 0x5A
            result = call("validate", changed)
            self.assertIn(result.status, (0, BAD_INPUT), f"byte {position}: {result.err}")
            if result.status == 0:  # a gap between chunks, which no checksum covers
                self.good("unpack", changed, "-o", self.path("whole.sbf"))
                self.assertEqual(read_bytes(self.path("whole.sbf")), read_bytes(self.xml))

    def test_files_that_are_not_bundles(self):
        for content in (b"", b"\0", b"hello", b"<html></html>", b"\x89PNG\r\n\x1a\n", b"<?xml version='1.0'?>",
                        b"\xff\xfe<\0s\0b\0f\0", b"<sbf/>", b"<sbf version='9.0'/>", b"<sbf version='1.0'>",
                        b"<!DOCTYPE sbf [<!ENTITY a 'b'>]><sbf version='1.0'/>"):
            path = write_bytes(self.path("x.sbf"), content)
            self.fails(BAD_INPUT, "info", path)
            self.assertFalse(self.json_of("validate", path, status=BAD_INPUT)["valid"])

    def test_errors_have_line_and_path(self):
        text = read_bytes(self.xml).replace(b'length="0.5"', b'length="long"')
        line = text[:text.index(b'length="long"')].count(b"\n") + 1
        report = self.json_of("validate", write_bytes(self.path("x.sbf"), text), status=BAD_INPUT)
        error, = [m for m in report["messages"] if m["severity"] == "error"]
        self.assertEqual((error["code"], error["line"]), ("XML_BAD_VALUE", line))
        self.assertEqual(error["path"], "/sbf/skeleton/bone[2]/@length")

    def test_a_required_extension_is_named(self):
        text = b"<sbf version='1.0'><extensions><extension name='ACME_fur' required='true'/></extensions></sbf>"
        message = self.fails(BAD_INPUT, "info", write_bytes(self.path("x.sbf"), text))
        self.assertIn("ACME_fur", message)
        self.assertIn("EXTENSION_REQUIRED", message)

    def test_an_optional_extension_is_kept(self):
        text = b"<sbf version='1.0'><extensions><extension name='ACME_fur'><data> a &lt;b/>\n\n\tc &amp; d \xc3\xa9" \
               b"</data></extension></extensions></sbf>"
        source = write_bytes(self.path("x.sbf"), text)
        self.good("pack", source, "-o", self.path("x.sbfz"))
        self.good("unpack", self.path("x.sbfz"), "-o", self.path("y.sbf"))
        kept = b"<data> a &lt;b/&gt;\n\n\tc &amp; d \xc3\xa9</data>"
        self.assertIn(kept, read_bytes(self.path("y.sbf")))
        self.good("pack", self.path("y.sbf"), "-o", self.path("y.sbfz"))
        self.assertEqual(read_bytes(self.path("x.sbfz")), read_bytes(self.path("y.sbfz")))
        self.good("build", self.path("x.sbfz"), "-o", self.path("built.sbf"))
        self.assertIn(kept, read_bytes(self.path("built.sbf")))
        self.good("validate", "--fix", "-o", self.path("fixed.sbf"), self.path("x.sbfz"))
        self.assertIn(kept, read_bytes(self.path("fixed.sbf")))

    def test_a_newer_minor_version_is_read_without_its_additions(self):
        text = b"<sbf version='1.7' mood='calm'><skeleton><bone id='a' head='0 0 0' weather='fine'><fur/></bone>" \
               b"</skeleton><fog density='2'><x>1</x></fog></sbf>"
        self.good("unpack", write_bytes(self.path("x.sbf"), text), "-o", self.path("y.sbf"))
        self.assertEqual(read_bytes(self.path("y.sbf")).split(b"\n", 1)[1],
                         b'<sbf version="1.4">\n  <skeleton>\n    <bone id="a" head="0 0 0"/>\n  </skeleton>\n</sbf>\n')


@needs_lizard
class HalfACharacter(ProgramTest):
    def test_a_mesh_without_a_rig_is_one_unpinned_body_each(self):
        out = self.path("x.sbf")
        result = self.good("convert", shared("lizard", "liz.obj"), "-o", out)
        self.assertIn("IMPORT_NO_RIG", result.err)
        info = self.json_of("info", out)
        self.assertEqual((len(info["bones"]), len(info["sections"])), (0, 18))
        self.assertEqual({s["bone"] for s in info["sections"]}, {None})
        self.assertEqual(info["pins"], 0)

    def test_a_rig_without_a_skeleton(self):
        message = self.fails(BAD_INPUT, "convert", shared("lizard", "liz.obj"), "--rig", shared("lizard", "liz.obj"),
                             "-o", self.path("x.sbf"))
        self.assertIn("IMPORT_NO_BONES", message)
        self.assert_empty_folder()

    @unittest.skipUnless(os.path.exists(shared("mocap", "cmu_01_01.bvh")), "no motion capture")
    def test_a_skeleton_without_a_mesh(self):
        out = self.path("x.sbf")
        result = self.good("convert", shared("mocap", "cmu_01_01.bvh"), "-o", out)
        self.assertIn("warning", result.err)
        info = self.json_of("info", out)
        self.assertEqual((info["render_meshes"], info["sections"]), ([], []))
        self.assertGreaterEqual(len(info["bones"]), 31)

    def test_motion_capture_states_no_unit(self):
        """Bones of a person in inches: the unit said is about theirs, and whoever states one is believed."""
        text = ("HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation "
                "Xrotation\n%s}\nMOTION\nFrames: 1\nFrame Time: 0.01\n0 36 0 0 0 0 %s\n")
        joint = "JOINT %s\n{\nOFFSET 0 %d 0\nCHANNELS 3 Zrotation Yrotation Xrotation\nEnd Site\n{\nOFFSET 0 %d 0\n}\n}\n"
        source = write_bytes(self.path("walk.bvh"), (text % (joint % ("Head", 28, 6) + joint % ("Foot", -36, -2),
                                                             "0 0 0 0 0 0")).encode())
        printed = self.good("convert", source, "-o", self.path("x.sbf")).err
        self.assertIn("UNIT_LOOKS_WRONG", printed)
        self.assertAlmostEqual(float(re.search(r"--unit (\S+), which makes them", printed).group(1)), 0.0254, delta=0.003)
        self.assertNotIn("UNIT_LOOKS_WRONG",
                         self.good("convert", source, "--unit", "0.0254", "-o", self.path("y.sbf")).err)

    def test_points_too_far_from_the_origin_are_reported(self):
        """A scan in the coordinates of a map: at 500 km a float has steps of 3 to 6 cm."""
        for far, reported in ((0, False), (1000, False), (500000, True)):
            moved = CUBE.replace(b"v 0 ", b"v %d " % far).replace(b"v 1 ", b"v %d " % (far + 1))
            source = write_bytes(self.path("scan.obj"), moved)
            for arguments in ((), ("--unit", "1")):
                printed = self.good("convert", source, "-o", self.path("x.sbf"), "--no-build", *arguments).err
                self.assertEqual(reported, "[IMPORT_FAR]" in printed, printed)
        self.assertRegex(printed, r"object '.*' lies 5e\+05 m from the origin, .* of 0\.06 m, 6 % of its size of 1 m: move it")

    def test_a_missing_material_library_is_a_warning(self):
        source = write_bytes(self.path("x.obj"), b"mtllib gone.mtl\no a\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 1 0\n"
                             b"usemtl skin\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n")
        result = self.good("convert", source, "-o", self.path("x.sbf"))
        self.assertIn("IMPORT_MATERIALS_MISSING", result.err)


if __name__ == "__main__":
    main()
