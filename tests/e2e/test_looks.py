"""Tests materials in pictures and in exported files: vertex colours, alpha modes, sides, texture transforms and image formats.
Draws small panels and checks the hue of pixels at known positions. Skipped without EGL."""

import math
import os
import unittest
import xml.etree.ElementTree as ElementTree

import textured_box
from glb_file import Glb
from looks import Panel, material, png_of_quarters
from sbfmt_program import PROGRAM, ROOT, ProgramTest, example, main, read_bytes
from test_render_files import draws, read_png

IMAGES = os.path.join(ROOT, "tests", "render", "images")
WIDTH, HEIGHT, STEP = 160, 120, 18
RED, GREEN, BLUE, YELLOW = "red", "green", "blue", "yellow"
PLACES = {"upper left": (-STEP, -STEP), "upper right": (STEP, -STEP), "lower left": (-STEP, STEP), "lower right": (STEP, STEP)}


def hue(pixel):
    """The primary or yellow that a pixel is of; "grey" for none."""
    r, g, b = pixel[:3]
    if min(r, g) > b + 50 and abs(r - g) < 40:
        return YELLOW
    return next((name for name, k in ((RED, 0), (GREEN, 1), (BLUE, 2))
                 if pixel[k] > max(pixel[j] for j in range(3) if j != k) + 40), "grey")


def quarters_of(data):
    """The hues at four places about the middle of a picture."""
    _, _, channels, rows = read_png(data)
    return {name: hue(rows[HEIGHT // 2 + y][(WIDTH // 2 + x) * channels:][:3]) for name, (x, y) in PLACES.items()}


def in_order(upper_left, upper_right, lower_left, lower_right):
    return dict(zip(PLACES, (upper_left, upper_right, lower_left, lower_right)))


class Looks(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if PROGRAM:
            able, why = draws("png", cls.class_folder.name, example(cls.class_folder.name))
            if not able:
                raise unittest.SkipTest(f"nothing can be drawn here: {why.strip()}")

    def converted(self, panel):
        source, file = panel.write(self.path("panel.glb")), self.path("panel.sbf")
        self.good("convert", source, "-o", file, "--no-build")
        return file

    def drawn(self, file, view="0,0"):
        out = self.path("panel.png")
        result = self.good("render", file, "-o", out, "--size", f"{WIDTH}x{HEIGHT}", "--view", view)
        return quarters_of(read_bytes(out)), result

    def exported(self, file):
        out = self.path("again.glb")
        self.good("export", file, "-o", out)
        return Glb(out)

    def test_vertex_colours(self):
        red, blue = (1, 0, 0), (0, 0, 1)
        for width in (3, 4):
            with self.subTest(width):
                panel = Panel()
                left, right = ((*c, 1)[:width] for c in (red, blue))
                panel.add("panel", material(), colours=(left, right, right, left))
                file = self.converted(panel)
                self.assertEqual(self.drawn(file)[0], in_order(RED, BLUE, RED, BLUE))
                again = self.exported(file)
                (_, primitive), = again.primitives()
                colours = again.accessor(primitive["attributes"]["COLOR_0"])
                at = again.accessor(primitive["attributes"]["POSITION"])
                self.assertEqual({(round(p[0], 3), c) for p, c in zip(at, colours)},
                                 {(-0.5, (1, 0, 0, 1)), (0.5, (0, 0, 1, 1))})

    def test_vertex_colours_multiply_the_base_colour(self):
        panel = Panel()
        panel.add("panel", material(colour=(1, 0, 1, 1)), colours=((1, 1, 0, 1),) * 2 + ((0, 1, 1, 1),) * 2)
        self.assertEqual(self.drawn(self.converted(panel))[0], in_order(BLUE, BLUE, RED, RED))

    def test_alpha_modes(self):
        """A quarter of the image is nearly clear; behind it stands a green panel."""
        expected = {"OPAQUE": RED, "MASK": GREEN, "BLEND": GREEN}
        for mode, seen in expected.items():
            with self.subTest(mode):
                panel = Panel()
                image = panel.image(png_of_quarters((20, 255, 255, 255)))
                more = {"alphaCutoff": 0.25} if mode == "MASK" else {}
                panel.add("panel", material(texture=image, alphaMode=mode, **more), depth=0.1)
                panel.add("behind", material(colour=(0, 1, 0, 1)))
                file = self.converted(panel)
                self.assertEqual(self.drawn(file)[0], in_order(seen, GREEN, BLUE, YELLOW))
                self.assertEqual(self.exported(file).json["materials"][0]["alphaMode"], mode)

    def test_the_cutoff_masks_pixels(self):
        for cutoff, seen in ((0.1, RED), (0.9, BLUE)):
            panel = Panel()
            image = panel.image(png_of_quarters((128, 255, 255, 255)))
            panel.add("panel", material(texture=image, alphaMode="MASK", alphaCutoff=cutoff), depth=0.1)
            panel.add("behind", material(colour=(0, 0, 1, 1)))
            self.assertEqual(self.drawn(self.converted(panel))[0]["upper left"], seen)

    def test_opacity_of_base_colour_and_vertices_blends(self):
        panel = Panel()
        panel.add("panel", material(colour=(1, 0, 0, 0.9), alphaMode="BLEND"), depth=0.1,
                  colours=((1, 1, 1, 1), (1, 1, 1, 0), (1, 1, 1, 0), (1, 1, 1, 1)))
        panel.add("behind", material(colour=(0, 0, 1, 1)))
        seen = self.drawn(self.converted(panel))[0]
        self.assertEqual((seen["upper left"], seen["lower right"]), (RED, BLUE))

    def test_sides(self):
        for double, seen in ((False, "grey"), (True, RED)):
            with self.subTest(double):
                panel = Panel()
                panel.add("panel", material(colour=(1, 0, 0, 1), doubleSided=double))
                file = self.converted(panel)
                self.assertEqual(set(self.drawn(file)[0].values()), {RED})
                self.assertEqual(set(self.drawn(file, "180,0")[0].values()), {seen})

    def test_texture_transforms(self):
        """Scaled, moved and turned as KHR_texture_transform says; the numbers reach an exported file."""
        cases = {
            "moved": ({"offset": [0.5, 0]}, in_order(GREEN, RED, YELLOW, BLUE)),
            "lower right quarter": ({"offset": [0.5, 0.5], "scale": [0.5, 0.5]}, in_order(*[YELLOW] * 4)),
            # Coordinates turned counter-clockwise about the upper left corner: the image turns clockwise.
            "turned": ({"rotation": math.pi / 2, "offset": [0, 1]}, in_order(BLUE, RED, YELLOW, GREEN)),
            "all": ({"rotation": math.pi / 2, "offset": [0.5, 0.5], "scale": [0.5, 1]}, in_order(GREEN, GREEN, RED, RED)),
        }
        for name, (transform, seen) in cases.items():
            with self.subTest(name):
                self.assertEqual(seen, self.by_formula(transform))
                panel = Panel()
                panel.add("panel", material(texture=panel.image(png_of_quarters()), transform=transform))
                panel.file.json["extensionsUsed"] = ["KHR_texture_transform"]
                file = self.converted(panel)
                self.assertEqual(self.drawn(file)[0], seen)
                self.assertEqual(ElementTree.parse(file).getroot().get("version"), "1.1")
                texture = self.exported(file).json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
                again = texture["extensions"]["KHR_texture_transform"]
                for key, default in (("offset", [0, 0]), ("rotation", 0), ("scale", [1, 1])):
                    for a, b in zip(*(value if isinstance(value, list) else [value]
                                      for value in (again[key], transform.get(key, default)))):
                        self.assertAlmostEqual(a, b, places=5)

    @staticmethod
    def by_formula(transform):
        """The hue at each place: offset + rotation * scale * (u, v), v downwards."""
        hues, found = ((RED, GREEN), (BLUE, YELLOW)), {}
        (ox, oy), (sx, sy) = transform.get("offset", (0, 0)), transform.get("scale", (1, 1))
        c, s = math.cos(transform.get("rotation", 0)), math.sin(transform.get("rotation", 0))
        for name, (x, y) in PLACES.items():
            u, v = sx * (0.25 if x < 0 else 0.75), sy * (0.25 if y < 0 else 0.75)
            at = (ox + u * c + v * s) % 1, (oy - u * s + v * c) % 1
            found[name] = hues[at[1] >= 0.5][at[0] >= 0.5]
        return found

    def test_images_use_their_uv_set(self):
        panel = Panel()
        panel.add("panel", material(texture=panel.image(png_of_quarters())), coordinates=((0, 0),) * 4)
        made = panel.file
        primitive = made.json["meshes"][0]["primitives"][0]
        primitive["attributes"]["TEXCOORD_1"] = made.accessor(((0, 1), (1, 1), (1, 0), (0, 0)), "f", "VEC2")
        made.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1
        self.assertEqual(self.drawn(self.converted(panel))[0], in_order(RED, GREEN, BLUE, YELLOW))

    def test_jpeg_and_webp(self):
        """Through an OBJ whose material names the file, and embedded in glTF; drawn, or the note says why not."""
        for name in ("quarters.jpg", "quarters_progressive.jpg", "quarters_inks.jpg", "quarters.webp"):
            with self.subTest(name):
                source = textured_box.write(self.folder, read_bytes(os.path.join(IMAGES, name)))
                file = self.path("box.sbf")
                self.good("convert", source, "-o", file, "--no-build")
                seen, result = self.drawn(file)
                if "built without" in result.err:
                    continue
                self.assertNotIn("IMAGE_NOT_DRAWN", result.err)
                self.assertEqual(seen, in_order(RED, GREEN, BLUE, YELLOW))
                image = self.exported(file).json["images"][0]
                self.assertEqual(image["mimeType"], "image/webp" if "webp" in name else "image/jpeg")

    def test_obj_maps_its_image(self):
        """-s and -o of a map: the lower right quarter, counted upwards."""
        folder = self.folder
        source = textured_box.write(folder, png_of_quarters())
        with open(os.path.join(folder, "box.mtl"), "w", encoding="utf-8") as stream:
            stream.write("newmtl skin\nKd 1 1 1\nmap_Kd -s 0.5 0.5 1 -o 0.5 0 0 red.png\n")
        file = self.path("box.sbf")
        self.good("convert", source, "-o", file, "--no-build")
        self.assertEqual(self.drawn(file)[0], in_order(*[YELLOW] * 4))


if __name__ == "__main__":
    main()
