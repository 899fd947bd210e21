"""Tests that conversions and builds always give the same bytes, from the source and from a built bundle, and keep authored
parts. Uses a character cut into sections, one with modelled sections, a lattice and a cloth."""

import os
import xml.etree.ElementTree as ElementTree

from canonical_source import WRAPPERS
from sbfmt_program import ROOT, ProgramTest, main, read_bytes, write_bytes

EXAMPLES = os.path.join(ROOT, "examples")


def grid(size, height):
    """An OBJ of size x size squares; with a height the upper and lower side of a bag, open all round."""
    lines, layers = [], (0, height) if height else (0,)
    for layer in layers:
        lines += [f"v {x / size} {layer} {z / size}" for z in range(size + 1) for x in range(size + 1)]
    for number in range(len(layers)):
        for z in range(size):
            for x in range(size):
                at = number * (size + 1) ** 2 + z * (size + 1) + x + 1
                corners = [at, at + size + 1, at + size + 2, at + 1]
                lines.append("f " + " ".join(map(str, corners if number == len(layers) - 1 else corners[::-1])))
    return ("\n".join(lines) + "\n").encode()


def authored(path):
    """All that no build made, as canonical XML."""
    def strip(element):
        for child in list(element):
            hull = child.tag == "polygon_mesh" and "hull_derived" in element.attrib
            if child.tag == "derivations" or "derived" in child.attrib or hull:
                element.remove(child)
                continue
            strip(child)
            if child.tag in WRAPPERS and not len(child):
                element.remove(child)
        element.attrib.pop("hull_derived", None)

    root = ElementTree.parse(path).getroot()
    strip(root)
    for figure in ("mass", "low", "high"):  # of the whole, where no derivation states them
        root.find("asset").attrib.pop(figure, None)
    return ElementTree.canonicalize(ElementTree.tostring(root, "unicode"), strip_text=True)


class SameBytes(ProgramTest):
    def check(self, source, *options, source_options=()):
        first, again, plain, built = (self.path(f"{name}.sbf") for name in ("first", "again", "plain", "built"))
        self.good("convert", source, *source_options, "-o", first, *options)
        self.good("convert", source, *source_options, "-o", again, *options, environment={"LC_ALL": "C", "TZ": "Asia/Kabul"})
        self.assertEqual(read_bytes(first), read_bytes(again), "converted twice")
        self.good("convert", source, *source_options, "-o", plain, "--no-build")
        self.good("build", plain, "-o", built, *options)
        self.assertEqual(read_bytes(first), read_bytes(built), "built apart from the conversion")
        self.good("build", built, "-o", again, *options)
        self.assertEqual(read_bytes(first), read_bytes(again), "built again")
        self.assertEqual(authored(plain), authored(built), "what somebody made")
        self.assertIn("derived=", read_bytes(built).decode())

    def test_a_skin_cut_into_sections(self):
        self.check(os.path.join(EXAMPLES, "calf", "calf.glb"), source_options=("--limits", "quadruped"))

    def test_sections_that_were_drawn(self):
        self.check(os.path.join(EXAMPLES, "lizard", "lizard.obj"),
                   source_options=("--rig", os.path.join(EXAMPLES, "lizard", "lizard.glb")))

    def test_a_lattice(self):
        bag = write_bytes(self.path("bag.obj"), grid(6, 0.2))
        self.check(bag, "--springs", "tetrahedra", "--elements", "200", "--no-calibration")
        self.check(bag, "--springs", "lattice", "--cell", "0.1", "--no-calibration")

    def test_a_calibrated_lattice(self):
        """Built again from its file it starts from the modulus that is stated, not from the calibrated ones."""
        self.check(write_bytes(self.path("bag.obj"), grid(6, 0.2)), "--springs", "tetrahedra", "--elements", "120")

    def test_a_cloth(self):
        self.check(write_bytes(self.path("cloth.obj"), grid(8, 0)))


if __name__ == "__main__":
    main()
