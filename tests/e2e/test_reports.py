"""Invalid samples: each gives the report that stands beside it, every report fits its schema, every code that the
readers and the validator can give has a sample.

    python3 tests/e2e/test_reports.py --rewrite

writes the reports anew, for review in a diff."""

import glob
import json
import os
import re
import subprocess
import sys

import json_schema
from sbfmt_program import PROGRAM, ProgramTest, ROOT, call, main, read_text, write_bytes

SPEC = os.path.join(ROOT, "spec")
INVALID = os.path.join(SPEC, "samples", "invalid")
SAMPLES = sorted(glob.glob(os.path.join(INVALID, "*.sbf")) + glob.glob(os.path.join(INVALID, "*.sbfz")))

# Codes of the folders below that no small file can show, and why.
UNSHOWN = {
    "OUT_OF_MEMORY": "a matter of the machine",
    "BAD_CALL": "a matter of the program that calls",
    "IO_CANNOT_READ": "a matter of the machine",
    "IO_CANNOT_WRITE": "a matter of the machine",
    "IO_TOO_LARGE": "a file of four gibibytes",
    "LIST_TOO_LONG": "a list of a thousand million items",
}
REPORTING = ("libsbfmt/model", "libsbfmt/xml", "libsbfmt/packed", "libsbfmt/validate")


def report_beside(sample):
    return os.path.splitext(sample)[0] + ".json"


def report_of(sample):
    """What the program prints for a sample, called in its folder: names in it have no path."""
    done = subprocess.run([PROGRAM, "validate", "--format", "json", os.path.basename(sample)], cwd=INVALID,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60,
                          check=False)
    return done.returncode, done.stdout.decode("utf-8")


def codes_named_in(folder):
    names = set()
    for path in glob.glob(os.path.join(ROOT, folder, "*.c")):
        names.update(re.findall(r"\bSBF_CODE_([A-Z0-9_]+)\b", read_text(path)))
    return names - {"NONE"}


def known_codes():
    rows = (line.split() for line in read_text(os.path.join(SPEC, "sbf.codes")).splitlines())
    return {row[0]: row for row in rows if len(row) > 4 and not row[0].startswith("#")}


class Reports(ProgramTest):
    def test_each_sample_gives_its_expected_report(self):
        self.assertGreater(len(SAMPLES), 200)
        for sample in SAMPLES:
            with self.subTest(os.path.basename(sample)):
                status, text = report_of(sample)
                self.assertEqual(text, read_text(report_beside(sample)), "python3 tests/e2e/test_reports.py --rewrite")
                self.assertEqual(status, 0 if json.loads(text)["valid"] else 1)

    def test_no_report_is_left_behind(self):
        self.assertEqual({report_beside(s) for s in SAMPLES}, set(glob.glob(os.path.join(INVALID, "*.json"))))

    def test_every_report_fits_the_schema(self):
        schema = json.loads(read_text(os.path.join(SPEC, "report.schema.json")))
        for sample in SAMPLES:
            report = json.loads(read_text(report_beside(sample)))
            self.assertEqual(json_schema.faults(report, schema), [], sample)
        self.assertNotEqual(json_schema.faults({"valid": 1, "messages": [{"code": "bad code"}]}, schema), [])

    def test_every_code_has_a_sample(self):
        shown = {m["code"] for s in SAMPLES for m in json.loads(read_text(report_beside(s)))["messages"]}
        reported = set().union(*map(codes_named_in, REPORTING))
        self.assertEqual(sorted(reported - shown - set(UNSHOWN)), [])
        self.assertEqual(sorted(shown & set(UNSHOWN)), [])
        self.assertGreaterEqual(len(shown), 60)
        self.assertEqual({int(known_codes()[code][1]) // 100 for code in shown}, set(range(1, 9)), "families")

    def test_severity_follows_the_code(self):
        codes = known_codes()
        for sample in SAMPLES:
            for message in json.loads(read_text(report_beside(sample)))["messages"]:
                self.assertEqual(message["severity"], codes[message["code"]][2], sample)

    def test_a_sample_named_after_a_code_shows_it(self):
        codes = known_codes()
        for sample in SAMPLES:
            name = os.path.splitext(os.path.basename(sample))[0].upper()
            if name in codes:
                found = {m["code"] for m in json.loads(read_text(report_beside(sample)))["messages"]}
                self.assertIn(name, found)

    def test_messages_name_the_location(self):
        for sample in SAMPLES:
            for message in json.loads(read_text(report_beside(sample)))["messages"]:
                self.assertTrue(message["path"] or "line" in message or "offset" in message or
                                message["code"].startswith("IO_"), message)


class Calls(ProgramTest):
    def test_folders_are_searched_in_order_of_names(self):
        os.makedirs(self.path("b/deep"))
        good = b"<sbf version='1.0'/>"
        for name in ("b/deep/z.sbf", "b/a.SBF", "c.sbf", "a.sbf", "notes.txt", ".hidden.sbf"):
            write_bytes(self.path(name), good)
        report = self.json_of("validate", self.folder, "--threads", "3")
        names = [os.path.relpath(row["file"], self.folder) for row in report["files"]]
        self.assertEqual(names, ["a.sbf", "b/a.SBF", "b/deep/z.sbf", "c.sbf"])

    def test_threads_do_not_change_the_order_of_files(self):
        once = call("validate", INVALID, "--threads", "1", "--format", "json")
        again = call("validate", INVALID, "--threads", "4", "--format", "json")
        self.assertEqual(once, again)
        self.assertEqual(len(json.loads(once.out)["files"]), len(SAMPLES))

    def test_the_summary_counts(self):
        sample = os.path.join(INVALID, "surface_open.sbf")
        result = call("validate", sample, os.path.join(INVALID, "empty.sbf"))
        self.assertEqual(result.status, 1)
        self.assertIn("2 files, 1 not valid: 1 error, 1 warning, 0 notes", result.out)

    def test_strict_makes_warnings_fail(self):
        sample = os.path.join(INVALID, "surface_open.sbf")
        self.assertTrue(self.json_of("validate", sample)["valid"])
        self.assertFalse(self.json_of("validate", "--strict", sample, status=1)["valid"])

    def test_a_folder_without_files_is_a_wrong_call(self):
        self.assertIn("no .sbf", self.fails(2, "validate", self.folder))

    def test_an_absent_file_does_not_hide_the_others(self):
        report = self.json_of("validate", self.path("absent.sbf"), os.path.join(INVALID, "surface_open.sbf"), status=2)
        self.assertEqual([m["code"] for m in report["messages"]], ["IO_CANNOT_READ", "SURFACE_OPEN"])

    def test_an_image_is_searched_beside_the_file(self):
        text = b"<sbf version='1.0'><textures><texture id='t' path='images/skin.png'/></textures></sbf>"
        path = write_bytes(self.path("a.sbf"), text)
        self.assertEqual([m["code"] for m in self.json_of("validate", path)["messages"]], ["TEXTURE_MISSING"])
        os.mkdir(self.path("images"))
        write_bytes(self.path("images/skin.png"), b"")
        self.assertEqual(self.json_of("validate", path)["messages"], [])


class Fixes(ProgramTest):
    """--fix mends every sample of a fault that has one right answer, and leaves the others as they are."""

    # Findings that remain in the written file, if there are any.
    LEFT = {"tetrahedron_flat": {"LATTICE_POINT_UNUSED"}}
    REPAIRED = ("tetrahedron_inverted", "tetrahedron_flat", "tetrahedron_duplicate", "surface_winding",
              "surface_inside_out", "point_unused", "mesh_point_unused", "spring_same_point", "spring_inert",
              "spring_duplicate", "pin_repeated", "skin_sum", "embedding_sum", "embedding_blend", "rotation_not_unit",
              "joint_frame", "normal_not_unit", "derived_stale")

    def schema(self):
        return json.loads(read_text(os.path.join(SPEC, "report.schema.json")))

    def fix(self, sample, status=0):
        report = self.json_of("validate", "--fix", "-o", self.path("out.sbf"), sample, status=status)
        self.assertEqual(json_schema.faults(report, self.schema()), [])
        return report

    def test_repairable_faults_are_repaired(self):
        for name in self.REPAIRED:
            with self.subTest(name):
                sample = os.path.join(INVALID, name + ".sbf")
                before = {m["code"] for m in json.loads(read_text(report_beside(sample)))["messages"]}
                report = self.fix(sample)
                self.assertEqual({m["code"] for m in report["fixed"]}, before)
                self.assertEqual({m["code"] for m in report["messages"]}, self.LEFT.get(name, set()))
                self.assertEqual(report["output"], self.path("out.sbf"))
                again = self.json_of("validate", self.path("out.sbf"))
                self.assertEqual({m["code"] for m in again["messages"]}, self.LEFT.get(name, set()))

    def test_ambiguous_faults_are_not_repaired(self):
        for sample in SAMPLES:
            name = os.path.basename(sample)
            expected = json.loads(read_text(report_beside(sample)))
            loads = not any(m["code"] in structural() for m in expected["messages"])
            if os.path.splitext(name)[0] in self.REPAIRED or not loads:
                continue
            with self.subTest(name):
                report = self.fix(sample, status=0 if expected["valid"] else 1)
                self.assertEqual(report["fixed"], [])
                self.assertEqual([m["code"] for m in report["messages"]], [m["code"] for m in expected["messages"]])

    def test_an_unrepairable_file_is_rejected(self):
        report = self.fix(os.path.join(INVALID, "id_repeated.sbf"), status=1)
        self.assertEqual(report["fixed"], [])
        self.assertNotIn("output", report)
        self.assertEqual([m["code"] for m in report["messages"]], ["ID_REPEATED"])
        self.assert_empty_folder()

    def test_the_list_names_the_location(self):
        report = self.fix(os.path.join(INVALID, "tetrahedron_inverted.sbf"))
        self.assertEqual([(m["code"], m["line"], m["index"]) for m in report["fixed"]],
                         [("TETRAHEDRON_INVERTED", 9, 1)])
        result = self.good("validate", "--fix", "-o", self.path("out.sbfz"),
                           os.path.join(INVALID, "tetrahedron_inverted.sbf"))
        self.assertIn("inverted tetrahedra reordered: 1 [TETRAHEDRON_INVERTED]", result.out)
        self.good("info", self.path("out.sbfz"))

    def test_wrong_calls(self):
        sample = os.path.join(INVALID, "skin_sum.sbf")
        self.assertIn("-o OUT", self.fails(2, "validate", "--fix", sample))
        self.assertIn("one file", self.fails(2, "validate", "--fix", "-o", self.path("o.sbf"), sample, sample))
        self.assertIn("--fix", self.fails(2, "validate", "-o", self.path("o.sbf"), sample))
        self.fails(2, "validate", "--fix", "-o", self.path("no/such/folder.sbf"), sample)
        self.assert_empty_folder()


def structural():
    """Codes of what a load refuses, families 1 to 3 and 8, and those of the others that it refuses as well."""
    refused = {name for name, row in known_codes().items() if int(row[1]) // 100 in (1, 2, 3, 8)}
    return refused | {"REF_UNKNOWN", "BONE_ORDER", "EXTENSION_REQUIRED", "TETRAHEDRON_INVERTED"}


def rewrite():
    for sample in SAMPLES:
        write_bytes(report_beside(sample), report_of(sample)[1].encode("utf-8"))


if __name__ == "__main__":
    if "--rewrite" in sys.argv[1:]:
        rewrite()
    else:
        main()
