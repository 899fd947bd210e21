#!/usr/bin/env python3
"""tests/report.py counts cases and sees skips that are not allowed; tests/support/cases.py names the cases that Python tests skip."""
import os
import re
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

from repo_files import ROOT

sys.path.insert(0, os.path.join(ROOT, "tests"))
import report  # noqa: E402

JUNIT = """<?xml version="1.0"?>
<testsuite name="x">
  <testcase name="build/test_lattice" status="run"><system-out>SKIP real_surfaces: shared/data/spot.obj is not there
SKIP real_surfaces: shared/data/bunny.obj is not there
CASES 12
</system-out></testcase>
  <testcase name="repo/check_names" status="run"><system-out>names: good</system-out></testcase>
  <testcase name="web/page" status="notrun"><skipped message="SKIP_RETURN_CODE=77"/><system-out>skipped: no chromium
</system-out></testcase>
  <testcase name="e2e/test_clips" status="notrun"><system-out>
SKIP Clips.test_a: no shared data
SKIP Clips.test_b: no shared data
CASES 2</system-out></testcase>
  <testcase name="e2e/test_drop" status="fail"><system-out>CASES 4</system-out></testcase>
</testsuite>
"""

CASES = """import unittest
class Some(unittest.TestCase):
    def test_runs(self): pass
    def test_lacks(self): self.skipTest("no gnuplot")
@unittest.skipIf(True, "no node")
class Decorated(unittest.TestCase):
    def test_a(self): pass
    def test_b(self): pass
class Late(unittest.TestCase):
    @classmethod
    def setUpClass(cls): raise unittest.SkipTest("no screen")
    def test_c(self): pass
    def test_d(self): pass
unittest.main()
"""


def summed(stages, junit, *options, logs=()):
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("stages", stages), ("strict.xml", junit), *logs):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        return subprocess.run([sys.executable, "-B", os.path.join(ROOT, "tests", "report.py"), *options,
                               os.path.join(folder, "stages"), folder], capture_output=True, text=True, check=False)


class Report(unittest.TestCase):
    def test_every_skipped_case_is_one(self):
        done = summed("FAILED 3 strict gcc\n", JUNIT)
        self.assertIn("11 passed, 1 failed, 5 skipped", done.stdout)  # 10 of the first, and the second
        self.assertIn("  web/page all: no chromium\n", done.stdout)
        self.assertIn("  e2e/test_clips Clips.test_b: no shared data\n", done.stdout)
        self.assertEqual(done.returncode, 1)

    def test_only_an_allowed_skip_passes_strictly(self):
        kernels = '<testsuite><testcase name="runtime/test_kernels" status="run"><system-out>SKIP a: {}\nCASES 9</system-out></testcase></testsuite>'
        for reason, status in (("this processor does not have AVX-512", 0), ("no wish to", 1)):
            done = summed("passed 3 strict gcc\n", kernels.format(reason), "--strict")
            self.assertEqual(done.returncode, status, done.stdout)
            self.assertIn(f"8 passed, 0 failed, 1 skipped, {status} of them", done.stdout)
            self.assertEqual(summed("passed 3 strict gcc\n", kernels.format(reason)).returncode, 0)

    def test_stages_that_run_no_tests(self):
        stages = "passed 3 strict gcc\nskipped 1 other_system newer\nFAILED 1 first_run fresh\n"
        done = summed(stages, '<testsuite><testcase name="a/b" status="run"/></testsuite>',
                      logs=(("other_system.log", "...\nSKIP newer Blender and Godot: only root\n"),))
        self.assertIn("1 passed, 1 failed, 1 skipped", done.stdout)
        self.assertIn("  stage/other_system newer Blender and Godot: only root\n", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^skipped +1 s  newer$")

    def test_a_stage_may_be_skipped_only_where_its_system_cannot_be_made(self):
        for absent in (True, False):
            allowed = list(report.allowances(os.path.join(ROOT, "tests", "allowed_skips")))
            with mock.patch.dict(report.WHERE, {"no-archive": lambda: absent, "not-root": lambda: False}):
                for stage in ("other_system", "first_run", "every_first_run"):
                    skip = report.Skip("stage/" + stage, "all", "debootstrap failed")
                    self.assertEqual(report.is_allowed(skip, allowed), absent, stage)

    def test_a_stage_that_broke_outside_of_its_tests_has_failed(self):
        done = summed("FAILED 3 strict gcc\n", '<testsuite><testcase name="a/b" status="run"/></testsuite>')
        self.assertIn("1 passed, 1 failed, 0 skipped", done.stdout)
        self.assertEqual(done.returncode, 1)

    def test_the_list_names_tests_that_exist_and_can_be_read(self):
        for test, _, reason in report.allowances(os.path.join(ROOT, "tests", "allowed_skips")):
            self.assertTrue(reason)
            folder = test.split("/")[0]
            self.assertTrue(folder in ("*", "stage") or os.path.isdir(os.path.join(ROOT, "tests", folder)) or folder == "bench", test)

    def test_a_line_that_cannot_be_read(self):
        with tempfile.NamedTemporaryFile("w", suffix=".skips") as file:
            file.write("e2e/* somewhere any reason\n")
            file.flush()
            with self.assertRaises(SystemExit):
                list(report.allowances(file.name))


class Cases(unittest.TestCase):
    def test_cases_classes_and_late_skips_are_named(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "test_some.py")
            with open(path, "w", encoding="utf-8") as file:
                file.write(CASES)
            done = subprocess.run([sys.executable, "-B", os.path.join(ROOT, "tests", "support", "cases.py"), path],
                                  capture_output=True, text=True, check=False)
        printed = done.stdout + done.stderr
        self.assertEqual(done.returncode, 0, printed)
        self.assertEqual(set(re.findall(r"^SKIP (.*)$", printed, re.M)), {
            "Some.test_lacks: no gnuplot", "Decorated.test_a: no node", "Decorated.test_b: no node", "Late.test_c: no screen",
            "Late.test_d: no screen"})
        self.assertIn("\nCASES 6\n", printed)


if __name__ == "__main__":
    unittest.main()
