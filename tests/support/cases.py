"""Runs a file of Python tests so that each case that it skips is known: cases.py FILE [ARGUMENT...].

For every case that is skipped it prints "SKIP case: reason", and in the end "CASES n", how many there were. tests/report.py counts both.
Tests inside Blender take `Result` from here."""

import os
import runpy
import sys
import unittest


class Result(unittest.TextTestResult):
    """As unittest's own, with the lines that tests/report.py reads."""

    whole_classes = 0  # cases of classes that were skipped before any of them ran

    def addSkip(self, test, reason):
        super().addSkip(test, reason)
        for case in self.cases_of(test):
            self.stream.writeln(f"\nSKIP {case}: {' '.join(str(reason).split())}")

    def cases_of(self, test):
        """The case itself; all of a class whose setUpClass skipped."""
        if isinstance(test, unittest.TestCase):
            return [test.id().removeprefix("__main__.")]
        name = test.id().removeprefix("setUpClass (").removesuffix(")")
        module, _, short = name.rpartition(".")
        found = getattr(sys.modules.get(module), short, None)
        names = unittest.defaultTestLoader.getTestCaseNames(found) if found else ["*"]
        self.whole_classes += len(names)
        return [f"{short}.{one}" for one in names]

    def stopTestRun(self):
        super().stopTestRun()
        self.stream.writeln(f"\nCASES {self.testsRun + self.whole_classes}")


def main():
    file = os.path.abspath(sys.argv[1])
    sys.argv = sys.argv[1:]
    sys.path[0] = os.path.dirname(file)
    unittest.TextTestRunner.resultclass = Result
    runpy.run_path(file, run_name="__main__")


if __name__ == "__main__":
    main()
