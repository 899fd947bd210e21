"""Tests render levels in the program: build makes them, info prints them, render draws them and export writes them."""

import os
import unittest

from sbfmt_program import ProgramTest, example, main, read_bytes, read_text, shared


ARMADILLO = shared("armadillo", "armadillo_25k.obj")


def faces_of(path):
    lines = read_text(path).splitlines()
    return sum(line.startswith("v ") for line in lines), sum(line.startswith("f ") for line in lines)


class RenderLevels(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.plain = example(cls.class_folder.name)

    def meshes(self, path):
        return self.json_of("info", path)["render_meshes"]

    def built(self, *options, source=None):
        out = self.path("built.sbf")
        self.good("build", source or self.plain, "-o", out, *options)
        return out

    def test_no_levels_without_the_option(self):
        self.assertTrue(all(mesh["levels"] == [] for mesh in self.meshes(self.plain)))

    def test_reported_halves(self):
        meshes = self.meshes(self.built("--render-levels", "2"))
        self.assertTrue(any(len(mesh["levels"]) == 2 for mesh in meshes))
        for mesh in meshes:
            before = mesh["triangles"]
            for level in mesh["levels"]:
                self.assertLessEqual(level["triangles"], 0.8 * before)
                self.assertGreater(level["error"], 0)
                before = level["triangles"]
        self.good("validate", self.path("built.sbf"))

    def test_rebuilt_levels_of_the_same_source_are_equal(self):
        once = self.built("--render-levels", "2")
        self.good("build", once, "-o", self.path("again.sbf"), "--render-levels", "2")
        self.assertEqual(read_bytes(once), read_bytes(self.path("again.sbf")))
        self.good("build", once, "-o", self.path("without.sbf"))
        self.assertNotIn("render_level", read_text(self.path("without.sbf")).replace("render_levels", ""))

    def test_an_error_bounds_them(self):
        meshes = self.meshes(self.built("--render-error", "0.01"))
        errors = [level["error"] for mesh in meshes for level in mesh["levels"]]
        self.assertTrue(errors)
        self.assertLessEqual(max(errors), 0.01)

    def test_export_writes_one(self):
        built = self.built("--render-levels", "3")
        for number in (0, 1, 7):
            self.good("export", built, "--render-level", number, "-o", self.path("level.obj"))
            expected = 0
            for mesh in self.meshes(built):
                last = min(number, len(mesh["levels"]))
                expected += mesh["levels"][last - 1]["triangles"] if last else mesh["polygons"]
            points, faces = faces_of(self.path("level.obj"))
            self.assertEqual(faces, expected)
            self.assertLess(points, 2 * faces)

    def test_render_draws_one(self):
        built = self.built("--render-levels", "2")
        for number in (0, 2):
            self.good("render", built, "--render-level", number, "--size", "64x48", "-o", self.path(f"{number}.png"))
        self.assertNotEqual(read_bytes(self.path("0.png")), read_bytes(self.path("2.png")))

    @unittest.skipUnless(os.path.exists(ARMADILLO), "no shared data")
    def test_a_large_mesh(self):
        source = self.path("armadillo.sbf")
        self.good("convert", ARMADILLO, "--no-build", "-o", source)
        built = self.built("--render-levels", "2", "--springs", "surface", source=source)
        levels = self.meshes(built)[0]["levels"]
        self.assertEqual([round(level["triangles"] / 6300) for level in levels], [2, 1])
        size = 22.9
        self.assertLess(levels[0]["error"], 0.004 * size)
        self.assertLess(levels[1]["error"], 0.008 * size)
        self.assertNotIn("RENDER_LEVEL", self.good("validate", built).err)


if __name__ == "__main__":
    main()
