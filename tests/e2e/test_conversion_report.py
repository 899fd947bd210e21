"""Tests `sbfmt convert --report`: the JSON fits its schema, the page needs no other files, and no partial file is written."""

import base64
import html.parser
import json
import os
import re
import unittest

import json_schema
import scene_files
from sbfmt_program import ProgramTest, ROOT, SHARED, main, read_bytes, read_text, shared, write_bytes
from vtu_files import vtu

LIZARD = os.path.join(ROOT, "examples", "lizard", "lizard")
SCHEMA = os.path.join(ROOT, "spec", "conversion.schema.json")
NO_EGL = {"__EGL_VENDOR_LIBRARY_FILENAMES": "/dev/null", "EGL_PLATFORM": "none"}


class Page(html.parser.HTMLParser):
    """Tags that are open, and all that a page would fetch."""

    EMPTY = {"meta", "img"}

    def __init__(self, text):
        super().__init__()
        self.open, self.fetched, self.scripts, self.words = [], [], 0, []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        if tag not in self.EMPTY:
            self.open.append(tag)
        self.scripts += tag == "script"
        self.fetched += [value for key, value in attrs if key in ("src", "href")]

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open)
        self.open.pop()

    def handle_data(self, data):
        self.words.append(data)


class Reports(ProgramTest):
    def report(self, *arguments, drawn=False):
        """Without pictures, which take seconds, unless they are asked for."""
        self.good("convert", *arguments, "-o", self.path("out.sbfz"), "--report", self.path("out.json"),
                  environment={} if drawn else NO_EGL)
        found = json.loads(read_text(self.path("out.json")))
        self.assertEqual(json_schema.faults(found, json.loads(read_text(SCHEMA))), [])
        return found

    def test_an_object_by_its_schema(self):
        r = self.report(LIZARD + ".obj", "--rig", LIZARD + ".glb")
        self.assertEqual([s["file"] for s in r["sources"]], ["lizard.obj", "lizard.glb"])
        obj, rig = r["sources"]
        self.assertEqual((obj["form"], obj["unit_from"], obj["axes_from"]), ("obj", "assumed", "assumed"))
        self.assertEqual((rig["form"], rig["unit_from"], rig["unit_m"]), ("glb", "file", 1))
        self.assertEqual(obj["bytes"], os.path.getsize(LIZARD + ".obj"))
        self.assertTrue(all(re.fullmatch("[0-9a-f]{64}", s["sha256"]) for s in r["sources"]))
        self.assertEqual(r["bundle"], self.json_of("info", self.path("out.sbfz")))
        self.assertIn("gait", {p["what"] for p in r["proposed"]})
        self.assertEqual(len(r["quality"]["bodies"]), len(r["bundle"]["sections"]))

    def test_unit_and_axes_from_the_call(self):
        path = write_bytes(self.path("a.ply"), scene_files.ply())
        r = self.report(path, "--unit", "0.01", "--up", "z")
        source, = r["sources"]
        self.assertEqual((source["unit_m"], source["unit_from"], source["axes_from"]), (0.01, "call", "call"))
        self.assertEqual((source["points"], source["polygons"]), (8, 6))

    def test_quality_of_elements(self):
        r = self.report(write_bytes(self.path("a.vtu"), vtu()))
        t = r["quality"]["tetrahedra"]
        self.assertEqual((t["count"], t["inverted"]), (2, 0))
        self.assertAlmostEqual(t["volume_m3"], 0.5, places=6)  # a corner of the cube and the regular one behind it
        self.assertAlmostEqual(t["least_dihedral_deg"], 54.7356, places=3)
        self.assertAlmostEqual(t["most_dihedral_deg"], 90, places=3)
        self.assertEqual(sum(t["dihedrals"]), 12)
        # the regular one has 1; the corner: inner radius 1 / (3 + sqrt 3), outer sqrt 3 / 2
        self.assertAlmostEqual(t["least_radius_ratio"], 3 / (3 + 3 ** 0.5) / (3 ** 0.5 / 2), places=5)
        self.assertAlmostEqual(t["mean_radius_ratio"], (1 + t["least_radius_ratio"]) / 2, places=5)
        self.assertEqual((t["radius_ratios"][7], t["radius_ratios"][9]), (1, 1))
        self.assertIsNone(r["quality"]["springs"])

    def test_lengths_of_springs(self):
        path = write_bytes(self.path("a.ply"), scene_files.ply())
        s = self.report(path, "--springs", "surface")["quality"]["springs"]
        self.assertEqual(sum(s["lengths"]), s["count"])
        self.assertAlmostEqual(s["least_m"], 1, places=5)
        self.assertLessEqual(s["least_m"], s["mean_m"])
        self.assertLessEqual(s["mean_m"], s["most_m"])
        self.assertIn("lengths of springs: 1 to ", self.good("convert", path, "--springs", "surface", "-o",
                                                             self.path("b.sbf")).out)

    def test_softness_of_skin_sections_is_reported(self):
        calf = os.path.join(ROOT, "examples", "calf", "calf.glb")
        report = self.report(calf)
        chosen = [m for kind in ("guessed", "notes") for m in report[kind] if m["code"] == "SOFTNESS_PROPOSED"]
        self.assertEqual(len(chosen), 2, "what is soft, and how fine it is")
        self.assertRegex(chosen[1]["message"], r"^sections follow lattices of about [0-9]+ tetrahedra: ")
        self.assertRegex(chosen[0]["message"], r"[0-9] of 22 parts of the skin are soft, with a modulus of .* kPa: .*; these move with their bones: ")
        self.assertNotIn("MATERIAL_GUESSED", {m["code"] for m in report["guessed"]})

    def test_repeated_findings_print_one_line_and_are_all_reported(self):
        """Ten plates, each thinner than two of its elements: the first is named, and how many more there are."""
        lines = []
        for n in range(10):
            lines.append(f"o plate{n}")
            lines += [f"v {x + 3 * n} {y * 0.05} {z}" for x in (0, 2) for y in (0, 1) for z in (0, 2)]
            lines += ["f " + " ".join(str(8 * n + k) for k in side)
                      for side in ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4))]
        path = write_bytes(self.path("plates.obj"), "\n".join(lines).encode() + b"\n")
        call = self.good("convert", path, "-o", self.path("out.sbfz"), "--cell", "0.2", "--no-calibration", "--report",
                         self.path("out.json"), environment=NO_EGL)
        self.assertEqual(call.err.count("[LATTICE_THIN] at"), 1)
        self.assertIn("9 more findings of this kind, which --verbose prints [LATTICE_THIN]", call.err)
        printed = json.loads(read_text(self.path("out.json")))
        thin = [m for kind in ("mended", "guessed", "lost", "notes") for m in printed[kind] if m["code"] == "LATTICE_THIN"]
        self.assertEqual(len(thin), 10)
        self.assertIn("a smaller cell", thin[0]["message"])

    @unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
    def test_repaired_and_lost_parts(self):
        r = self.report("--no-build", shared("lizard", "lizart.glb"))
        self.assertEqual({m["code"] for m in r["mended"]}, {"IMPORT_INSIDE_OUT", "IMPORT_POINTS_JOINED"})
        r = self.report("--no-build", shared("armadillo", "armadillo_1k.obj"))
        self.assertEqual({m["code"] for m in r["lost"]}, {"IMPORT_MATERIALS_MISSING"})

    def test_a_page_is_self_contained(self):
        self.good("convert", LIZARD + ".glb", "-o", self.path("out.sbf"), "--report", self.path("out.html"))
        page = Page(read_text(self.path("out.html")))
        self.assertEqual((page.open, page.scripts), ([], 0))
        for fetched in page.fetched:
            self.assertTrue(fetched.startswith("data:image/png;base64,"))
            png = base64.b64decode(fetched.split(",")[1], validate=True)
            self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        words = " ".join(page.words)
        for title in ("What came in", "What was guessed", "How well the elements are shaped", "Sections", "lizard.glb"):
            self.assertIn(title, words)
        self.assertEqual(bool(page.fetched), "No pictures could be drawn" not in words)

    def test_a_page_of_cloth_with_render_levels(self):
        sheet = write_bytes(self.path("sheet.obj"), b"".join(
            [b"v %d 0 %d\n" % (i % 9, i // 9) for i in range(81)]
            + [b"f %d %d %d %d\n" % (c + 1, c + 10, c + 11, c + 2) for c in range(71) if c % 9 < 8]))
        self.good("convert", sheet, "--render-levels", "1", "-o", self.path("out.sbf"), "--report", self.path("out.html"),
                  environment=NO_EGL)
        words = " ".join(Page(read_text(self.path("out.html"))).words)
        self.assertIn("Render levels", words)
        self.assertIn("What was mended \n Nothing.", words)
        self.assertRegex(words, r"Without tetrahedra, bones, materials, images and clips")

    def test_names_are_no_markup(self):
        content = scene_files.dae().replace(b'id="n" name="box"', b'id="&lt;script&gt;" name="&lt;b&gt;"')
        self.good("convert", write_bytes(self.path("a.dae"), content), "-o", self.path("out.sbf"), "--report",
                  self.path("out.html"), environment=NO_EGL)
        page = Page(read_text(self.path("out.html")))
        self.assertEqual((page.open, page.scripts), ([], 0))

    def test_without_egl_the_run_continues_and_reports_it(self):
        r = self.report(LIZARD + ".glb")
        self.assertEqual(r["pictures"], [])
        self.assertIn("EGL", r["drawing_failed"])
        self.assertGreater(r["quality"]["springs"]["count"], 0)
        self.good("convert", LIZARD + ".glb", "-o", self.path("out.sbf"), "--report", self.path("out.html"),
                  environment=NO_EGL)
        self.assertIn("No pictures could be drawn here", read_text(self.path("out.html")))

    def test_the_same_call_gives_the_same_object(self):
        path = write_bytes(self.path("a.ply"), scene_files.ply())
        first = self.report(path, "--springs", "surface", drawn=True)
        self.assertEqual(self.report(path, "--springs", "surface", drawn=True), first)
        if not first["drawing_failed"]:
            self.assertEqual([p["name"] for p in first["pictures"]], ["skin", "sections", "springs"])
            # Unasked, a body that no bone runs through is filled with tetrahedra.
            unasked = self.report(path, drawn=True)
            self.assertEqual([p["name"] for p in unasked["pictures"]], ["skin", "sections", "lattice"])

    def test_wrong_calls_give_no_output(self):
        for arguments in (("--report", self.path("out.txt")), ("--report", self.path("no folder/out.html"))):
            with self.subTest(arguments):
                self.fails(2, "convert", LIZARD + ".glb", "-o", self.path("out.sbf"), *arguments, environment=NO_EGL)
                self.assertFalse(os.path.exists(arguments[1]))
        self.fails(2, "convert", LIZARD + ".glb", LIZARD + ".obj", "--out-dir", self.folder, "--report",
                   self.path("out.html"))

    def test_a_failed_conversion_keeps_the_old_report(self):
        old = write_bytes(self.path("out.html"), b"what was there")
        self.fails(1, "convert", write_bytes(self.path("a.obj"), b""), "-o", self.path("out.sbf"), "--report", old)
        self.assertEqual(read_bytes(old), b"what was there")
        self.assert_empty_folder(but=["out.html", "a.obj"])


if __name__ == "__main__":
    main()
