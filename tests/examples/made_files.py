"""Base class for tests of an example's files: they match its script, and the script's check can fail."""

import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))
import report  # noqa: E402

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "examples")

# Sines of another system's library differ in their last digit, and with them the bytes of what the scripts make.
where_they_were_made = unittest.skipUnless(report.debian_12(), "the files were made on Debian 12, whose mathematics rounds its own way")


class MadeFiles:
    """`script` below examples/, and the name of a file that it makes."""

    script, file = None, None

    def make(self, *arguments):
        script = os.path.join(EXAMPLES, self.script)
        return subprocess.run([sys.executable, "-B", script, *arguments], capture_output=True, text=True, check=False)

    @where_they_were_made
    def test_they_are_up_to_date(self):
        done = self.make("--check")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_another_file_is_found_out(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(self.make("-o", folder).returncode, 0)
            self.assertEqual(self.make("--check", "-o", folder).returncode, 0)
            with open(os.path.join(folder, self.file), "ab") as stream:
                stream.write(b" ")
            done = self.make("--check", "-o", folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn(self.file + " is stale", done.stderr)
