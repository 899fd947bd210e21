"""The example calf: its file is what the script makes, and its check can fail."""

import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir)
SCRIPT = os.path.join(ROOT, "examples", "calf", "make_calf.py")


def make_calf(*arguments):
    return subprocess.run([sys.executable, "-B", SCRIPT, *arguments], capture_output=True, text=True, check=False)


class Calf(unittest.TestCase):
    def test_the_file_is_up_to_date(self):
        done = make_calf("--check")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("4256 quads, 22 bones", done.stdout)

    def test_another_file_is_found_out(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(make_calf("-o", folder).returncode, 0)
            self.assertEqual(make_calf("--check", "-o", folder).returncode, 0)
            with open(os.path.join(folder, "calf.glb"), "ab") as stream:
                stream.write(b"more")
            done = make_calf("--check", "-o", folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn("calf.glb is stale", done.stderr)


if __name__ == "__main__":
    unittest.main()
