"""Runs in Blender: enables the add-on as a user does, then runs the test modules named after `--`. The environment variable ONLY
selects tests whose names contain a word."""

import importlib
import os
import sys
import unittest

import addon_utils

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from cases import Result  # noqa: E402


def main(names):
    if addon_utils.enable("soft_body_format", default_set=True) is None:
        sys.exit("the add-on can't be enabled")
    unittest.defaultTestLoader.testNamePatterns = ["*" + os.environ["ONLY"] + "*"] if "ONLY" in os.environ else None
    suite = unittest.TestSuite(unittest.defaultTestLoader.loadTestsFromModule(importlib.import_module(name)) for name in names)
    result = unittest.TextTestRunner(stream=sys.stdout, verbosity=2, resultclass=Result).run(suite)
    sys.stdout.flush()
    if not result.wasSuccessful():
        raise RuntimeError("tests failed")


main(sys.argv[sys.argv.index("--") + 1:])
