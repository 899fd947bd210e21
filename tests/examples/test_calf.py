"""The example calf."""

import unittest

from made_files import MadeFiles


class Calf(MadeFiles, unittest.TestCase):
    script, file = "calf/make_calf.py", "calf.glb"

    def test_it_has_the_documented_parts(self):
        self.assertIn("4256 quads, 22 bones", self.make("--check").stdout)


if __name__ == "__main__":
    unittest.main()
