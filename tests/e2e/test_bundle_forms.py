"""Tests both forms of a bundle: they pack and unpack to the same bytes, and compare, validate and info treat them equally."""

import os
import re
import struct
import zlib

from sbfmt_program import ProgramTest, call, example, main, read_bytes, read_text, write_bytes

MAGIC = b"\x89SBF\r\n\x1a\n"
ENTRY = struct.Struct("<4sIIHHBBHIQQQQII")


def chunks_of(packed):
    """The table of contents, read as packed.md says."""
    table, size, count = struct.unpack_from("<QQI", packed, 24)
    assert size == ENTRY.size * count
    return [ENTRY.unpack_from(packed, table + i * ENTRY.size) for i in range(count)]


class Forms(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.xml = example(cls.class_folder.name)
        cls.packed, cls.stored = cls.made("example.sbfz"), cls.made("stored.sbfz")
        for out, *options in ((cls.packed,), (cls.stored, "--store")):
            result = call("pack", cls.xml, "-o", out, *options)
            assert result.status == 0, result.err

    def test_xml_round_trips_to_the_same_bytes(self):
        for packed in (self.packed, self.stored):
            out = self.path("again.sbf")
            self.good("unpack", packed, "-o", out)
            self.assertEqual(read_bytes(out), read_bytes(self.xml))

    def test_packed_round_trips_to_the_same_bytes(self):
        for packed, *options in ((self.packed,), (self.stored, "--store")):
            xml, again = self.path("a.sbf"), self.path("a.sbfz")
            self.good("unpack", packed, "-o", xml)
            self.good("pack", xml, "-o", again, *options)
            self.assertEqual(read_bytes(again), read_bytes(packed))
            self.good("pack", packed, "-o", again, *options)
            self.assertEqual(read_bytes(again), read_bytes(packed))

    def test_convert_writes_the_form_its_output_is_named_for(self):
        out = self.path("direct.sbfz")
        self.good("build", self.xml, "-o", out)
        self.assertEqual(read_bytes(out), read_bytes(self.packed))

    def test_xml_is_made_canonical(self):
        text = read_text(self.xml)
        odd = re.sub(r'<bone id="([^"]*)" name="([^"]*)"', r"<bone  name='\2'   id='\1'", text)
        odd = odd.replace("\n", "\r\n").replace("<skeleton>", "<!-- the rig --><skeleton>")
        self.assertNotEqual(odd, text)
        source, out = write_bytes(self.path("odd.sbf"), odd.encode()), self.path("mended.sbf")
        self.good("unpack", source, "-o", out)
        self.assertEqual(read_text(out), text)

    def test_the_packed_file_is_laid_out_as_specified(self):
        for path, is_stored in ((self.packed, False), (self.stored, True)):
            data = read_bytes(path)
            self.assertEqual(data[:8], MAGIC)
            self.assertEqual(struct.unpack_from("<HHHHQ", data, 8), (1, 0, 1, 0, len(data)))
            entries = chunks_of(data)
            self.assertEqual((entries[0][0], entries[0][3]), (b"ROOT", 0))
            self.assertEqual(struct.unpack_from("<I", data, 60)[0], zlib.crc32(data[:60]))
            end = 64 + 64 * len(entries)
            self.assertEqual(struct.unpack_from("<I", data, 44)[0], zlib.crc32(data[64:end]))
            for kind, _, _, field, _, _, codec, flags, stride, offset, stored, raw, count, crc, _ in entries:
                self.assertEqual(offset % 64, 0)
                self.assertGreaterEqual(offset, end)
                self.assertEqual(data[end:offset], bytes(offset - end), "gaps are zero")
                self.assertEqual(zlib.crc32(data[offset:offset + stored]), crc)
                self.assertEqual((raw, flags), (count * stride, 0 if kind == b"OUTL" else 1))
                if is_stored or codec == 0:
                    self.assertEqual((codec, stored), (0, raw), (kind, field))
                end = offset + stored
            self.assertEqual(end, len(data))
        self.assertLess(os.path.getsize(self.packed), 0.4 * os.path.getsize(self.xml))

    def test_equal_files_differ_in_nothing(self):
        for a, b in ((self.xml, self.xml), (self.xml, self.packed), (self.packed, self.stored)):
            self.assertEqual(self.good("diff", a, b).out, "")

    def test_a_difference_is_named(self):
        text, count = re.subn(r"<attributes ", '<attributes density="1001" ', read_text(self.xml), count=1)
        self.assertEqual(count, 1)
        other = write_bytes(self.path("other.sbf"), text.encode())
        result = call("diff", self.xml, other)
        self.assertEqual(result.status, 1, result.err)
        self.assertIn("soft_body[1]", result.out)
        self.assertIn("density", result.out)

    def test_unreadable_files_are_neither_equal_nor_different(self):
        self.fails(2, "diff", self.xml, self.path("absent.sbf"))
        broken = write_bytes(self.path("broken.sbf"), read_bytes(self.xml)[:-10])
        self.fails(2, "diff", broken, self.xml)

    def test_info_is_the_same_for_both_forms(self):
        reports = [self.json_of("info", path) for path in (self.xml, self.packed, self.stored)]
        for report, path in zip(reports, (self.xml, self.packed, self.stored)):
            self.assertEqual(report.pop("bytes"), os.path.getsize(path))
        self.assertEqual(reports[0], reports[1])
        self.assertEqual(reports[0], reports[2])

    def test_info_holds_the_keys_of_the_contract(self):
        report = self.json_of("info", self.xml)
        self.assertLessEqual({"format_version", "render_meshes", "bones", "sections", "springs", "tetrahedra",
                              "embedded_vertices", "pins", "attachments", "rigid_bodies", "joints", "gait", "levels",
                              "bounds", "mass", "bytes"}, set(report))
        self.assertEqual(report["format_version"], "1.0")
        for row in report["render_meshes"]:
            self.assertLessEqual({"name", "vertices", "polygons", "triangles", "material"}, set(row))
        for row in report["bones"]:
            self.assertLessEqual({"id", "name", "parent", "joint"}, set(row))
        for row in report["sections"]:
            self.assertLessEqual({"name", "bone", "vertices", "polygons", "interior_points", "tetrahedra", "pins"},
                                 set(row))
        self.assertLessEqual({"structural", "shear", "flexion", "internal", "cross"}, set(report["springs"]))
        for key in ("tetrahedra", "embedded_vertices", "pins", "attachments", "rigid_bodies", "joints", "levels",
                    "bytes"):
            self.assertIs(type(report[key]), int, key)

    def test_validate_agrees_for_both_forms(self):
        for path in (self.xml, self.packed, self.stored):
            report = self.json_of("validate", path)
            self.assertEqual((report["valid"], report["errors"]), (True, 0), report["messages"])

    def test_validate_of_several_files_fails_with_the_worst(self):
        broken = write_bytes(self.path("broken.sbf"), b"<sbf version='1.0'><bone/></sbf>")
        report = self.json_of("validate", self.xml, broken, self.packed, status=1)
        self.assertFalse(report["valid"])
        self.assertEqual([m["code"] for m in report["messages"] if m["severity"] == "error"],
                         ["XML_UNKNOWN_ELEMENT"])
        for message in report["messages"]:
            self.assertLessEqual({"code", "severity", "message", "path"}, set(message))
            self.assertTrue("line" in message or "offset" in message or message["path"])

    def test_validate_finds_damage_in_chunks_that_a_load_does_not_read(self):
        """The outline's checksum, and the zeros between chunks."""
        whole = read_bytes(self.packed)
        count = int.from_bytes(whole[40:44], "little")
        entries = [whole[64 * (i + 1):64 * (i + 2)] for i in range(count)]
        positions = [(int.from_bytes(e[24:32], "little"), int.from_bytes(e[32:40], "little")) for e in entries]
        self.assertEqual(entries[-1][:4], b"OUTL")
        gap = next(begin + size for (begin, size), (after, _) in zip(positions, positions[1:]) if begin + size < after)
        for at, code in ((positions[-1][0] + 5, "PACKED_CRC"), (gap, "PACKED_TABLE")):
            damaged = bytearray(whole)
            damaged[at] ^= 0x10
            report = self.json_of("validate", write_bytes(self.path("damaged.sbfz"), bytes(damaged)), status=1)
            self.assertEqual([message["code"] for message in report["messages"] if message["severity"] == "error"], [code])

    def test_packing_leaves_no_other_files(self):
        self.good("pack", self.xml, "-o", self.path("only.sbfz"))
        self.assert_empty_folder(but=["only.sbfz"])


if __name__ == "__main__":
    main()
