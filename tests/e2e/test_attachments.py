"""Tests `--attach`: points of a soft body inside a rigid hull are attached to it, on lattices and springs, and move with its
bone. The attaching object is neither soft nor drawn."""

import os

from bundle_file import Bundle
from sbfmt_program import EXAMPLE, ProgramTest, main, write_bytes

SIDES = ((1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (3, 7, 8, 4), (1, 5, 7, 3), (2, 4, 8, 6))


def cube(name, low, high, first):
    """An OBJ object: an axis-parallel cube."""
    corners = "".join("v " + " ".join(str((low, high)[i >> k & 1]) for k in range(3)) + "\n" for i in range(8))
    return f"o {name}\n{corners}" + "".join("f " + " ".join(str(first + i) for i in side) + "\n" for side in SIDES)


class Attachments(ProgramTest):
    def setUp(self):
        super().setUp()
        # `inside` reaches beyond a grid point or two of the lattice on each side.
        self.cubes = write_bytes(self.path("two.obj"), (cube("flesh", 0, 1, 0) + cube("inside", 0.3, 0.7, 8)).encode())

    def converted(self, *options):
        self.good("convert", self.cubes, "-o", self.path("out.sbf"), *options)
        self.good("validate", "--strict", self.path("out.sbf"))
        return self.json_of("info", self.path("out.sbf"))

    def test_vertices_inside_a_hull_are_pinned(self):
        for options in (("--elements", 500), ("--springs", "lattice", "--cell", 0.15)):
            info = self.converted("--attach", "flesh=inside", *options)
            self.assertEqual([s["name"] for s in info["sections"]], ["flesh"])
            self.assertEqual([m["name"] for m in info["render_meshes"]], ["flesh"])
            self.assertEqual((info["attachments"], info["rigid_bodies"]), (1, 1))
            self.assertGreater(info["pins"], 4)
            body = Bundle(self.path("out.sbf")).root.find("soft_body")
            level = body.find("level")
            numbers = [float(n) for n in level.find("positions").text.split()]
            held = {int(n) for pins in level.iter("pin_set") for n in pins.find("points").text.split()}
            for i in range(len(numbers) // 3):
                inside = all(0.3 <= x <= 0.7 for x in numbers[3 * i:3 * i + 3])
                self.assertEqual(i in held, inside, numbers[3 * i:3 * i + 3])

    def test_a_pinned_body_does_not_fall(self):
        self.converted("--attach", "flesh=inside", "--elements", 500)
        held = self.json_of("run", self.path("out.sbf"), "--seconds", 1)
        self.assertTrue(held["valid"])
        self.assertGreater(held["volume_ratio_least"], 0.95)
        self.assertLess(held["max_strain"], 0.2)

    def test_a_section_is_attached_to_a_second_bone(self):
        self.good("convert", os.path.join(EXAMPLE, "lizard.obj"), "--rig", os.path.join(EXAMPLE, "lizard.glb"), "-o",
                  self.path("out.sbf"), "--attach", "Tail2=Tail1", "--no-build")
        self.assertEqual(self.json_of("info", self.path("out.sbf"))["attachments"], 1)

    def test_missing_files_are_reported(self):
        for wish, words in (("flesh=heart", "'heart': no object"), ("heart=inside", "'heart'"),
                            ("flesh=flesh", "to itself")):
            self.assertIn(words, self.fails(1, "convert", self.cubes, "-o", self.path("out.sbf"), "--attach", wish))
        self.assertIn("belly=ribs", self.fails(2, "convert", self.cubes, "-o", self.path("out.sbf"), "--attach", "flesh"))


if __name__ == "__main__":
    main()
