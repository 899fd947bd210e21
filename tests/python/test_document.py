"""sbfmt.document: the format's objects without the library, byte for byte as the library writes them."""

import glob
import math
import os
import random
import struct
import sys
import tempfile
import unittest
from array import array

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.realpath(os.path.join(HERE, os.pardir, os.pardir))
sys.path.insert(0, os.path.join(ROOT, "exporters", "python"))
sys.path.insert(0, os.path.join(ROOT, "spec", "reader"))
import sbf_numbers  # noqa: E402
import sbfmt  # noqa: E402
from sbfmt.document import Record, from_xml, save_whole, to_xml  # noqa: E402
from sbfmt.document.elements import ELEMENTS  # noqa: E402
from sbfmt.document.number_text import float_words, nine_digits  # noqa: E402

SAMPLES = sorted(glob.glob(os.path.join(ROOT, "spec", "samples", "**", "*.sbf"), recursive=True))
CANONICAL = [path for path in SAMPLES if f"{os.sep}invalid{os.sep}" not in path]


def bytes_of(path):
    with open(path, "rb") as file:
        return file.read()


def some_numbers():
    chance = random.Random(7)
    bits = [chance.getrandbits(32) & 0xFF7FFFFF for _ in range(2000)]
    plain = [chance.uniform(-2, 2) for _ in range(5000)] + [round(chance.uniform(-2, 2), 4) for _ in range(5000)]
    edges = [0.0, -0.0, 1e-45, 1.1754944e-38, 3.4028235e38, 16777216.0, 16777217.0, 0.1, 1e-4, 1.2e-4, 1e5, 123456.0, 1e6]
    return array("f", [struct.unpack("<f", struct.pack("<I", one))[0] for one in bits] + plain + edges +
                 [10.0**power for power in range(-44, 38)] + [chance.randrange(1 << 28) for _ in range(2000)])


class Numbers(unittest.TestCase):
    def test_floats_are_written_by_the_specification(self):
        numbers = some_numbers()
        for number, word in zip(numbers, float_words(numbers)):
            self.assertEqual(word, sbf_numbers.print_float(number))

    def test_nine_digits_read_back(self):
        numbers = some_numbers()
        back = array("f", [sbf_numbers.read_float(word.encode()) for word in nine_digits(numbers).split()])
        self.assertEqual(back.tobytes(), numbers.tobytes())

    def test_invalid_numbers_are_refused(self):
        for number in (math.inf, math.nan):
            with self.assertRaises(ValueError):
                to_xml(Record("asset", environment=Record("environment", gravity=(0, number, 0))))


class Documents(unittest.TestCase):
    def test_samples_round_trip_byte_for_byte(self):
        self.assertGreaterEqual(len(CANONICAL), 3)
        for path in CANONICAL:
            self.assertEqual(to_xml(from_xml(bytes_of(path))), bytes_of(path), path)

    def test_no_field_hides_behind_a_method(self):
        hidden = [(element.name, field.name) for element in ELEMENTS.values() for field in element.fields
                  if hasattr(Record, field.name)]
        self.assertEqual(hidden, [])

    def test_defaults_are_there_without_being_written(self):
        asset = Record("asset")
        self.assertEqual([round(g, 6) for g in asset.environment.gravity], [0, -9.81, 0])  # a float32's
        asset.environment.gravity = (0, -9.81, 0)
        asset.add("bones", id="hip", head=(0, 1, 0))
        self.assertEqual(to_xml(asset).decode(), '<?xml version="1.0" encoding="UTF-8"?>\n<sbf version="1.0">\n'
                         '  <skeleton>\n    <bone id="hip" head="0 1 0"/>\n  </skeleton>\n</sbf>\n')

    def test_lists_accept_any_sequence(self):
        body = Record("soft_body", id="a", interior=[(0, 1, 2), (3, 4, 5)])
        self.assertEqual(body.interior, array("f", range(6)))
        with self.assertRaisesRegex(ValueError, "not a multiple of 3"):
            body.interior = [1, 2]

    def test_mistakes_are_named(self):
        with self.assertRaisesRegex(AttributeError, "a bone has no heads"):
            Record("bone", heads=1)
        with self.assertRaisesRegex(ValueError, "one of opaque, mask, blend"):
            Record("material", alpha_mode="clear")
        with self.assertRaisesRegex(ValueError, "takes 3 numbers"):
            Record("bone", head=(1, 2))

    def test_equality_sees_through_defaults(self):
        one, other = Record("bone", id="a"), Record("bone", id="a", inherit_scale=True)
        self.assertEqual(one, other)
        other.length = 2
        self.assertNotEqual(one, other)

    def test_texts_with_signs_of_xml_come_back(self):
        asset = Record("asset")
        asset.info.title = 'a<b> & "c"\n\td\r'
        asset.add("extensions", name="X_y", data="<&>\r\n\t\"")
        self.assertEqual(from_xml(to_xml(asset)), asset)

    def test_a_failed_write_leaves_the_old_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.sbf")
            save_whole(path, b"old")
            with self.assertRaises(TypeError):
                save_whole(path, None)
            self.assertEqual(bytes_of(path), b"old")
            self.assertEqual(os.listdir(folder), ["a.sbf"])


@unittest.skipUnless(os.path.exists(os.environ.get("SBFMT_LIBRARY", "")), "no shared library is named")
class Beside(unittest.TestCase):
    def test_the_library_writes_the_same_bytes(self):
        built = sbfmt.convert(os.path.join(ROOT, "examples", "lizard", "lizard.obj"),
                              rig=os.path.join(ROOT, "examples", "lizard", "lizard.glb"),
                              helper=os.environ.get("SBFMT_IMPORT_HELPER")).to_xml()
        record = from_xml(built)
        self.assertEqual(to_xml(record), built)
        with tempfile.TemporaryDirectory() as folder:
            quick = os.path.join(folder, "quick.sbf")
            save_whole(quick, to_xml(record, canonical=False))
            self.assertEqual(sbfmt.load(quick).to_xml(), built)
        with sbfmt.load_document(record) as given:
            self.assertEqual(given.to_xml(), built)

    def test_bytes_and_faults_of_a_document_given(self):
        record = Record("asset")
        record.add("textures", id="t", media_type="image/png", bytes=b"no image \0 but bytes")
        record.add("soft_bodies", id="soft", interior=[0, 0, 0, 1, 2, 3])
        with sbfmt.load_document(record) as made:
            self.assertEqual(from_xml(made.to_xml()), record)
        record.soft_bodies[0].interior = [0, 0, float("nan")]
        with self.assertRaises(sbfmt.Error) as caught:
            sbfmt.load_document(record)
        self.assertEqual(caught.exception.code, "VALUE_NOT_FINITE")


if __name__ == "__main__":
    unittest.main(verbosity=2)
