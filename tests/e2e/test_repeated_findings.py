"""Findings of one kind are printed once with a count; `--verbose` prints each, and JSON lists each."""

import os

from sbfmt_program import ROOT, ProgramTest, main, write_bytes

CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
FACES = ((4, 3, 2, 1), (5, 6, 7, 8), (1, 2, 6, 5), (2, 3, 7, 6), (3, 4, 8, 7))  # open without the last one
LAST_FACE = (1, 5, 8, 4)
BODIES = 6
MORE = "more findings of this kind, which --verbose prints"


def boxes(count, faces, height=1):
    lines = []
    for i in range(count):
        lines.append(f"o box{i}")
        lines += [f"v {x + 3 * i} {y * height} {z}" for x, y, z in CORNERS]
        lines += ["f " + " ".join(str(8 * i + corner) for corner in face) for face in faces]
    return "\n".join(lines + [""]).encode()


def lines_with(text, code):
    return [line for line in text.splitlines() if f"[{code}]" in line]


class RepeatedFindings(ProgramTest):
    def bundle(self, count):
        path = write_bytes(self.path(f"boxes{count}.obj"), boxes(count, FACES))
        self.good("convert", path, "--no-build", "-o", self.path(f"boxes{count}.sbf"))
        return self.path(f"boxes{count}.sbf")

    def test_one_line_and_a_count_for_each_file(self):
        files = self.bundle(BODIES), self.bundle(BODIES - 2)
        lines = lines_with(self.good("validate", *files).err, "SURFACE_OPEN")
        self.assertEqual([MORE in line for line in lines], [False, True, False, True])
        for path, (first, count), bodies in zip(files, (lines[:2], lines[2:]), (BODIES, BODIES - 2)):
            self.assertIn(path, first)
            self.assertIn(f"warning: {bodies - 1} {MORE}", count)

    def test_all_by_verbose(self):
        err = self.good("validate", "--verbose", self.bundle(BODIES)).err
        self.assertEqual(len(lines_with(err, "SURFACE_OPEN")), BODIES)
        self.assertNotIn(MORE, err)

    def test_all_in_json(self):
        messages = self.json_of("validate", self.bundle(BODIES))["messages"]
        self.assertEqual(sum(m["code"] == "SURFACE_OPEN" for m in messages), BODIES)

    def test_two_are_both_printed(self):
        err = self.good("validate", self.bundle(2)).err
        self.assertEqual(len(lines_with(err, "SURFACE_OPEN")), 2)
        self.assertNotIn(MORE, err)

    def test_errors_are_never_merged(self):
        textures = "".join(f'<texture id="t{i}" path="/elsewhere{i}.png"/>' for i in range(BODIES))
        path = write_bytes(self.path("bad.sbf"), f'<sbf version="1.0"><textures>{textures}</textures></sbf>'.encode())
        err = self.fails(1, "validate", path)
        self.assertEqual(len(lines_with(err, "TEXTURE_PATH")), BODIES)

    def test_convert_too(self):
        """Thin plates: each is thinner than two of its elements."""
        path = write_bytes(self.path("plates.obj"), boxes(BODIES, FACES + (LAST_FACE,), 0.02))
        options = (path, "--elements", "60", "--no-calibration", "-o", self.path("out.sbf"))
        brief, full = self.good("convert", *options).err, self.good("convert", "--verbose", *options).err
        self.assertEqual(len(lines_with(full, "LATTICE_THIN")), BODIES)
        first, count = lines_with(brief, "LATTICE_THIN")
        self.assertEqual(first, lines_with(full, "LATTICE_THIN")[0])
        self.assertEqual(count, f"sbfmt convert: warning: {BODIES - 1} {MORE} [LATTICE_THIN]")

    def test_findings_that_differ_in_more_than_names_are_printed(self):
        err = self.good("export", os.path.join(ROOT, "spec", "samples", "valid", "everything.sbf"), "-o", self.path("out.usda")).err
        self.assertGreater(len(lines_with(err, "EXPORT_LEFT_OUT")), 2)
        self.assertNotIn(MORE, err)

    def test_every_verb_accepts_the_option(self):
        self.assertIn("--verbose", self.good("pack", "--help").out)
        self.good("pack", "--verbose", self.bundle(1), "-o", self.path("one.sbfz"))


if __name__ == "__main__":
    main()
