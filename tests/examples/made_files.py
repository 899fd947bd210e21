"""What the tests of one example's files share: they are what its script makes, and its check can fail."""

import os
import subprocess
import sys
import tempfile

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "examples")


class MadeFiles:
    """`script` below examples/, and the name of a file that it makes."""

    script, file = None, None

    def make(self, *arguments):
        script = os.path.join(EXAMPLES, self.script)
        return subprocess.run([sys.executable, "-B", script, *arguments], capture_output=True, text=True, check=False)

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
