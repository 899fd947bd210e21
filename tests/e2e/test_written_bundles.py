"""Tests that every command checks a bundle before it writes it: an invalid bundle replaces no file."""

import os

from sbfmt_program import ROOT, ProgramTest, convert_once, main, read_bytes, read_text, write_bytes

PUDDING = os.path.join(ROOT, "examples", "pudding", "pudding.glb")
SAMPLES = os.path.join(ROOT, "spec", "samples", "invalid")
# A valid texture would end the path with a name.
BROKEN_PART = '  <textures>\n    <texture id="t" path="/elsewhere.png"/>\n  </textures>\n'


class WrittenBundles(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        good = read_text(convert_once(cls.class_folder.name, "good.sbf", PUDDING))
        assert "<textures>" not in good
        cls.broken = write_bytes(cls.made("broken.sbf"), good.replace("  <skeleton>\n", BROKEN_PART + "  <skeleton>\n").encode())

    def refuses(self, code, command, source, ending, *options):
        """Nothing is written, neither at a new place nor over a file that is there."""
        self.assertTrue(os.path.exists(source))
        out, old = self.path("new" + ending), write_bytes(self.path("old" + ending), b"as it was")
        for position in (out, old):
            message = self.fails(1, command, source, "-o", position, *options)
            self.assertIn(f"[{code}]", message)
            self.assertIn(f"{position} was not written: the result for {source} has 1 error", message)
        self.assertFalse(os.path.exists(out))
        self.assertEqual(read_bytes(old), b"as it was")

    def test_build(self):
        self.refuses("TEXTURE_PATH", "build", self.broken, ".sbf")
        self.refuses("TEXTURE_PATH", "build", self.broken, ".sbfz")

    def test_pack(self):
        self.refuses("TEXTURE_PATH", "pack", self.broken, ".sbfz")
        self.refuses("TEXTURE_PATH", "pack", self.broken, ".sbfz", "--store")

    def test_unpack(self):
        self.refuses("TEXTURE_PATH", "unpack", self.broken, ".sbf")

    def test_tune(self):
        self.refuses("TEXTURE_PATH", "tune", self.broken, ".sbf", "--quick", "--reference", "100", "--elements", "50", "--runs", "1", "--error", "0")

    def test_authored_elements_twice_or_in_each_other(self):
        """`build` does not change authored levels: it reports their errors and writes nothing."""
        for name in ("tetrahedron_duplicate", "lattice_overlap"):
            path = os.path.join(SAMPLES, name + ".sbf")
            with self.subTest(name):
                self.refuses(name.upper(), "pack", path, ".sbfz")
                self.refuses(name.upper(), "build", path, ".sbfz")


if __name__ == "__main__":
    main()
