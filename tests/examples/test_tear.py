"""The bar that tears."""

import unittest

from made_files import MadeFiles


class Bar(MadeFiles, unittest.TestCase):
    script, file = "tear/make_bar.py", "bar.sbf"


if __name__ == "__main__":
    unittest.main()
