"""Tests the source hash of derived parts: it is the one of the specification, a changed source makes the parts stale, and
a build replaces them and keeps authored parts."""

import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree

from canonical_source import source_hash, source_text
from sbfmt_program import (PROGRAM, ROOT, ProgramTest, call, example, liz, lizart, main, needs_lizard, read_bytes, read_text,
                           shared, write_bytes)


def stated_hash(path):
    return ElementTree.parse(path).getroot().find("derivations/derivation").get("source_hash")


class Derived(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = example(cls.class_folder.name)

    def codes_of(self, path):
        return {m["code"] for m in self.json_of("validate", path)["messages"]}

    def changed(self, pattern, replacement):
        text, count = re.subn(pattern, replacement, read_text(self.file), count=1)
        self.assertEqual(count, 1)
        return write_bytes(self.path("changed.sbf"), text.encode())

    def test_the_hash_follows_the_specification(self):
        self.assertEqual(stated_hash(self.file), source_hash(self.file))

    def test_a_build_needs_only_the_parts_it_reads(self):
        # Material slots are no part of it, so references to them are removed to make the rest valid.
        text = re.sub(r" *<polygon_materials>[^<]*</polygon_materials>\n", "", source_text(self.file))
        source, built = write_bytes(self.path("source.sbf"), text.encode()), self.path("built.sbf")
        self.good("unpack", source, "-o", self.path("again.sbf"))
        self.assertEqual(read_bytes(self.path("again.sbf")), read_bytes(source), "canonical as the C library writes it")
        self.good("build", source, "-o", built)
        here, there = (self.json_of("info", path) for path in (built, self.file))
        for key in ("springs", "pins", "embedded_vertices", "rigid_bodies", "mass", "sections"):
            self.assertEqual(here[key], there[key], key)

    def test_a_fresh_file_is_not_stale(self):
        self.assertNotIn("DERIVED_STALE", self.codes_of(self.file))

    def test_a_changed_source_makes_derived_parts_stale(self):
        for pattern, replacement in ((r'(<bone id="[^"]*" name="[^"]*"[^>]* length=")', r"\g<1>1"),
                                     (r'(<soft_body id="[^"]*" name=")', r"\g<1>another "),
                                     (r"(<polygon_mesh target=\"surface\">\s*<positions>\s*)", r"\g<1>-")):
            self.assertIn("DERIVED_STALE", self.codes_of(self.changed(pattern, replacement)), pattern)

    def test_parts_that_a_build_does_not_read_may_change(self):
        for pattern, replacement in ((r'<asset title="', '<asset title="another '),
                                     (r'step_height="[^"]*"', 'step_height="0.0625"'),
                                     (r'roughness="[^"]*"', 'roughness="0.0625"')):
            self.assertNotIn("DERIVED_STALE", self.codes_of(self.changed(pattern, replacement)), pattern)

    def test_a_changed_derived_part_does_not(self):
        text = read_text(self.file)
        position = text.index("<stiffness>")
        end = text.index("</stiffness>", position)
        body = re.sub(r"\d+\.\d+", "1.5", text[position:end], count=1)
        self.assertNotEqual(body, text[position:end])
        other = write_bytes(self.path("other.sbf"), (text[:position] + body + text[end:]).encode())
        self.assertNotIn("DERIVED_STALE", self.codes_of(other))
        self.good("build", other, "-o", self.path("built.sbf"))
        self.assertEqual(read_bytes(self.path("built.sbf")), read_bytes(self.file))

    def test_an_authored_level_is_kept(self):
        text = read_text(self.file)
        begin = text.index("<level ")
        end = text.index("</level>", begin)
        authored = text[:begin] + re.sub(r' derived="[^"]*"', "", text[begin:end]) + text[end:]
        self.assertNotEqual(authored, text)
        source, out = write_bytes(self.path("a.sbf"), authored.encode()), self.path("b.sbf")
        self.good("build", source, "-o", out)
        root = ElementTree.parse(out).getroot()
        self.assertIsNone(root.find("soft_body/level").get("derived"))
        self.assertEqual([b.find("level").get("derived") is None for b in root.findall("soft_body")].count(True), 1)

    def test_settings_are_recorded(self):
        out = self.path("none.sbf")
        self.good("build", self.file, "-o", out, "--springs", "none")
        settings = ElementTree.parse(out).getroot().find("derivations/derivation").get("settings").split(" ")
        self.assertIn("interior=none", settings)
        self.assertEqual(settings, sorted(settings))
        self.assertEqual(self.json_of("info", out)["springs"]["internal"], 0)

    def test_parts_kept_as_authored_are_reported(self):
        nodes = write_bytes(self.path("one.node"), b"4 3 0 0\n0 0 0 0\n1 1 0 0\n2 0 1 0\n3 0 0 1\n")
        write_bytes(self.path("one.ele"), b"1 4 0\n0 0 1 2 3\n")
        reported = self.good("convert", nodes, "-o", self.path("one.sbf"), "--material", "rubber").out
        self.assertIn("kept 1 body as authored: 1 tetrahedron\n", reported)
        self.assertNotIn("built", reported)
        self.assertNotIn("springs", reported)

    def test_bodies_have_the_given_material(self):
        call("build", self.file, "--material", "flesh", "--material", "Head=muscle", "-o", self.path("firm.sbf"))
        text = read_text(self.path("firm.sbf"))
        self.assertEqual(text.count('young_modulus="30000"'), 1)
        self.assertGreater(text.count('young_modulus="20000"'), 10)
        for wrong in ("unobtainium", "Head=unobtainium", "Nobody=fat"):
            done = subprocess.run([PROGRAM, "build", self.file, "--material", wrong, "-o", self.path("wrong.sbf")],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, wrong)
            self.assertIn("material" if "unobtainium" in wrong else "Nobody", done.stderr)
            self.assertFalse(os.path.exists(self.path("wrong.sbf")))
        listed = subprocess.run([PROGRAM, "convert", "--help"], capture_output=True, text=True, check=True).stdout
        for name in re.findall(r"^\| (\w+) \| [0-9]", read_text(os.path.join(ROOT, "docs", "materials.md")), re.M):
            self.assertIn(name, listed)

    def test_rebuilt_sections_keep_their_levels(self):
        fox = shared("fox/fox.glb")
        if not os.path.exists(fox):
            self.skipTest("no shared data")
        options = ("--material", "flesh", "--levels", "2")
        call("convert", fox, "--unit", "0.01", "--limits", "quadruped", "--soft", "*", *options, "-o", self.path("fox.sbf"))
        call("build", self.path("fox.sbf"), *options, "-o", self.path("again.sbf"))
        self.assertEqual(read_bytes(self.path("fox.sbf")), read_bytes(self.path("again.sbf")))
        self.assertEqual(read_text(self.path("fox.sbf")).count('model="jiggle"'), 21)
        call("validate", self.path("fox.sbf"))

    def test_lattices_have_the_requested_size(self):
        out, again = self.path("lattice.sbf"), self.path("again.sbf")
        options = ("--springs", "tetrahedra", "--elements", "300", "--no-calibration")  # which takes a second a body
        self.good("build", self.file, "-o", out, *options)
        self.good("build", self.file, "-o", again, *options)
        self.assertEqual(read_bytes(out), read_bytes(again))
        for section in self.json_of("info", out)["sections"]:
            self.assertGreater(section["tetrahedra"], 200, section["name"])
            self.assertLess(section["tetrahedra"], 400, section["name"])
        self.good("validate", out)


@needs_lizard
class Lizards(ProgramTest):
    def test_the_hash_of_every_lizard(self):
        for path in (liz(self.folder), lizart(self.folder)):
            self.assertEqual(stated_hash(path), source_hash(path))


if __name__ == "__main__":
    main()
