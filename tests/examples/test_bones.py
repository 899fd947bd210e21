"""The figure over bones."""

import unittest

from made_files import MadeFiles


class Figure(MadeFiles, unittest.TestCase):
    script, file = "bones/make_figure.py", "figure.sbf"


if __name__ == "__main__":
    unittest.main()
