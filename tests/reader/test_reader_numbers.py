"""The second reader's numbers: nearest binary32, ties to even, and the shortest text."""

import math
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "spec", "reader"))
from sbf_elements import Fault  # noqa: E402
from sbf_numbers import bits_of, from_bits, print_float, read_float, read_integers  # noqa: E402


class Reading(unittest.TestCase):
    def test_ties_go_to_the_even_neighbour(self):
        self.assertEqual(read_float(b"1.000000059604644775390625"), 1.0)
        self.assertEqual(bits_of(read_float(b"1.000000178813934326171875")), bits_of(1.0) + 2)

    def test_double_rounding_is_avoided(self):
        self.assertEqual(bits_of(read_float(b"1.00000005960464477539062500000000001")), bits_of(1.0) + 1)
        self.assertEqual(bits_of(read_float(b"1.00000017881393432617187499999999999")), bits_of(1.0) + 1)

    def test_subnormal_numbers(self):
        self.assertEqual(bits_of(read_float(b"1e-45")), 1)
        self.assertEqual(bits_of(read_float(b"7.006492321624085354618e-46")), 0)
        self.assertEqual(bits_of(read_float(b"7.0064923216240853546187e-46")), 1)
        self.assertEqual(math.copysign(1.0, read_float(b"-1e-60")), -1.0)

    def test_numbers_that_round_to_infinity_are_refused(self):
        self.assertEqual(read_float(b"3.4028235677973362e38"), from_bits(0x7F7FFFFF))
        for word in (b"3.4028235677973367e38", b"-1e39", b"1e999", b"inf", b"nan", b"1_0", b"0x1", b"1e", b".", b""):
            with self.assertRaises(Fault):
                read_float(word)

    def test_integers(self):
        self.assertEqual(read_integers([b"+4294967295", b"-0", b"007"], "uint"), [4294967295, 0, 7])
        for word in (b"4294967296", b"-1", b"1.0", b"1" * 5000):
            with self.assertRaises(Fault):
                read_integers([word], "uint")


class Printing(unittest.TestCase):
    def test_canonical_forms(self):
        for bits, text in ((0x00000000, "0"), (0x80000000, "-0"), (0x3DCCCCCD, "0.1"), (0x4B800000, "16777216"),
                           (0x47C35000, "1e+05"), (0x447A0000, "1000"), (0x3A83126F, "0.001"), (0x00000001, "1e-45"),
                           (0x7F7FFFFF, "3.4028235e+38"), (0x4CEB79A3, "123456792"),
                           (0x40490FDB, "3.1415927")):
            self.assertEqual(print_float(from_bits(bits)), text)


if __name__ == "__main__":
    unittest.main(verbosity=2)
