"""The figure over bones: its files are what the script makes, and its check can fail."""

import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir)
SCRIPT = os.path.join(ROOT, "examples", "bones", "make_figure.py")


def make_figure(*arguments):
    return subprocess.run([sys.executable, "-B", SCRIPT, *arguments], capture_output=True, text=True, check=False)


class Figure(unittest.TestCase):
    def test_the_file_is_up_to_date(self):
        done = make_figure("--check")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_another_file_is_found_out(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(make_figure("-o", folder).returncode, 0)
            self.assertEqual(make_figure("--check", "-o", folder).returncode, 0)
            with open(os.path.join(folder, "figure.sbf"), "a", encoding="utf-8") as stream:
                stream.write(" ")
            done = make_figure("--check", "-o", folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn("figure.sbf is stale", done.stderr)


if __name__ == "__main__":
    unittest.main()
