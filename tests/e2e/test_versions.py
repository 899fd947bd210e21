"""Tests versions (section 5 of the specification) and gaps (packed.md): the library and the second reader treat them equally."""

import os
import struct
import sys
import zlib

from sbfmt_program import ProgramTest, ROOT, call, main, read_bytes, write_bytes

sys.path.insert(0, os.path.join(ROOT, "spec", "reader"))
import sbf  # noqa: E402
from sbf_elements import Fault  # noqa: E402

TEXT = '<sbf version="{}"><materials><material id="a"{}>{}</material></materials>{}</sbf>'
TRANSFORM = '<base_color_uv scale="2 2"/>'


class Versions(ProgramTest):
    def text(self, version, more="", inside="", behind="", name="in.sbf"):
        return write_bytes(self.path(name), TEXT.format(version, more, inside, behind).encode())

    def packed(self, path, out="in.sbfz"):
        self.good("pack", path, "-o", self.path(out))
        return bytearray(read_bytes(self.path(out)))

    def sealed(self, data, name="changed.sbfz"):
        """Writes a packed file with its checksums of the header and the table made right."""
        table, size = struct.unpack_from("<QQ", data, 24)
        struct.pack_into("<I", data, 44, zlib.crc32(data[table:table + size]))
        struct.pack_into("<I", data, 60, zlib.crc32(data[:60]))
        return write_bytes(self.path(name), bytes(data))

    def both_take(self, path, takes, code=None):
        result = call("validate", path)
        self.assertEqual(result.status == 0, takes, result.err)
        if code:
            self.assertIn(code, result.err)
        try:
            sbf.load(read_bytes(path))
            second = True
        except Fault:
            second = False
        self.assertEqual(second, takes, path)

    def test_a_field_of_a_later_version_than_stated_is_refused(self):
        self.both_take(self.text("1.0", inside=TRANSFORM), False, "VERSION_FIELD")
        self.both_take(self.text("1.1", inside=TRANSFORM), True)
        self.both_take(self.text("1.0"), True)
        data = self.packed(self.text("1.1", inside=TRANSFORM))
        self.assertEqual(struct.unpack_from("<HHHH", data, 8), (1, 1, 1, 0))
        struct.pack_into("<H", data, 10, 0)
        self.both_take(self.sealed(data), False, "VERSION_FIELD")

    def test_a_writer_states_the_lowest_sufficient_version(self):
        for stated, inside, written in (("1.0", "", "1.0"), ("1.1", "", "1.1"), ("1.1", TRANSFORM, "1.1")):
            self.good("unpack", self.text(stated, inside=inside), "-o", self.path("out.sbf"))
            self.assertIn(f'<sbf version="{written}">'.encode(), read_bytes(self.path("out.sbf")))

    def test_additions_of_a_newer_version_are_left_out_and_reported(self):
        newer = self.text("1.99", ' gloss="2"', "<glow><x>1</x></glow>", '<fog density="2"/>')
        self.both_take(newer, True, "VERSION_NEWER")
        printed = "has version 1.99, this library knows 1.4: 3 parts of it were left out, the first is " \
               "/sbf/materials/material[1]/@gloss"
        for verb, *options in (("unpack", "-o", self.path("out.sbf")), ("pack", "-o", self.path("out.sbfz")),
                               ("build", "-o", self.path("built.sbf")), ("convert", "-o", self.path("converted.sbf")),
                               ("validate", "--fix", "-o", self.path("fixed.sbf")), ("info",)):
            with self.subTest(verb):
                result = call(verb, newer, *options)
                self.assertEqual(result.status, 0, result.err)
                self.assertIn(printed, result.err)
                self.assertIn("VERSION_NEWER", result.err)
        for verb in ("chart", "tune"):  # which find nothing to run in it, but say so first
            self.assertIn(printed, call(verb, newer, "-o", self.path(verb + ".sbf")).err)
        self.assertIn(b'<material id="a"/>', read_bytes(self.path("out.sbf")))
        self.assertEqual(call("validate", "--strict", newer).status, 1)
        self.assertNotIn("VERSION_NEWER", call("validate", self.text("1.99")).err)

    def test_a_packed_newer_one_too(self):
        data = self.packed(self.text("1.1"))
        record, = (e for e in [struct.unpack_from("<4sIIHHBBHIQQQQII", data, 64)])
        offset, stored = record[9], record[10]
        fields = bytes(data[offset:offset + stored])
        self.assertEqual(record[6], 0, "a record this short is stored as it is")
        more = struct.pack("<HHI", 999, 1, 5) + b"hello\0\0\0"
        grown = data[:offset] + fields + more
        struct.pack_into("<QQQQI", grown, 64 + 24, offset, len(fields + more), len(fields + more), len(fields + more),
                         zlib.crc32(fields + more))
        struct.pack_into("<Q", grown, 16, len(grown))
        for minor, takes in ((1, False), (7, True)):
            struct.pack_into("<H", grown, 10, minor)
            self.both_take(self.sealed(grown), takes)
        result = call("unpack", self.path("changed.sbfz"), "-o", self.path("out.sbf"))
        self.assertEqual(result.status, 0, result.err)
        self.assertIn("has version 1.7, this library knows 1.4: 1 part of it was left out, the first is field 999 of /sbf", result.err)

    def test_padding_is_zero_in_known_versions(self):
        whole = self.packed(self.text("1.1"))
        for filler, minor, takes in ((b"\0", 1, True), (b"\1", 1, False), (b"\1", 9, True)):
            data = whole + b"\0" * 63 + filler
            struct.pack_into("<Q", data, 16, len(data))
            struct.pack_into("<H", data, 10, minor)
            with self.subTest(filler=filler, minor=minor):
                self.both_take(self.sealed(data), takes)


if __name__ == "__main__":
    main()
