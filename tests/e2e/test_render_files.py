"""Tests `sbfmt render`: pictures and films have the requested type and size, and are not empty. Skipped if the
machine has no EGL or no ffmpeg."""

import json
import shutil
import struct
import unittest
import zlib

import textured_box
from sbfmt_program import PROGRAM, ROOT, ProgramTest, call, example, main, read_bytes, read_text, write_bytes

SMALL = ("--size", "160x120")
MARKS = {"footprints": 0x2f7fd0, "targets": 0xe8743b, "rays": 0xc8283c, "poles": 0xa34fb0}  # as docs/gait.md calls their colours


def draws(ending, folder, file):
    """Whether this machine can draw such a file at all."""
    result = call("render", file, "-o", f"{folder}/try.{ending}", "--seconds", "0.1", "--fps", "10", *SMALL)
    return result.status == 0, result.err


def read_png(data):
    """Width, height and rows of RGB or RGBA bytes; checks signature and checksums on the way."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    position, packed, head = 8, b"", None
    while position < len(data):
        size, kind = struct.unpack_from(">I4s", data, position)
        body = data[position + 8:position + 8 + size]
        assert struct.unpack_from(">I", data, position + 8 + size)[0] == zlib.crc32(kind + body)
        if kind == b"IHDR":
            head = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        position += 12 + size
    width, height, depth, colour, _, _, interlaced = head
    assert (depth, interlaced) == (8, 0) and colour in (2, 6)
    channels = 3 if colour == 2 else 4
    flat, step, rows, above = zlib.decompress(packed), width * channels, [], bytes(width * channels)
    for y in range(height):
        kind, row = flat[y * (step + 1)], bytearray(flat[y * (step + 1) + 1:(y + 1) * (step + 1)])
        for x in range(step):
            left = row[x - channels] if x >= channels else 0
            corner = above[x - channels] if x >= channels else 0
            row[x] = (row[x] + predictor(kind, left, above[x], corner)) & 255
        rows.append(bytes(row))
        above = row
    return width, height, channels, rows


def predictor(kind, left, up, corner):
    if kind == 4:
        guess = left + up - corner
        return min((left, up, corner), key=lambda n: abs(guess - n))
    return (0, left, up, (left + up) // 2)[kind]


def colours(data):
    _, _, channels, rows = read_png(data)
    return {row[x:x + 3] for row in rows for x in range(0, len(row), channels)}


def marked(data):
    """How many pixels have about the colour of each kind of the feet's marks, outside the corner of the legend."""
    width, height, channels, rows = read_png(data)
    seen = [row[x * channels:x * channels + 3] for y, row in enumerate(rows) for x in range(width)
            if 2 * x > width or 10 * y < 7 * height]
    return {kind: sum(all(abs(p[k] - (colour >> (16 - 8 * k) & 255)) <= 30 for k in range(3)) for p in seen)
            for kind, colour in MARKS.items()}


class Render(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if not PROGRAM:
            return
        cls.file = example(cls.class_folder.name)
        able, why = draws("png", cls.class_folder.name, cls.file)
        if not able:
            raise unittest.SkipTest(f"nothing can be drawn here: {why.strip()}")

    def draw(self, name, *arguments):
        out = self.path(name)
        self.good("render", self.file, "-o", out, *arguments)
        return read_bytes(out)

    def test_a_skeleton_alone_shows_its_bones(self):
        rig = self.path("arm.bvh")
        write_bytes(rig, b"HIERARCHY\nROOT Hips\n{\nOFFSET 0 1 0\nCHANNELS 3 Xposition Yposition Zposition\n"
                    b"JOINT Arm\n{\nOFFSET 0 0.5 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\n"
                    b"OFFSET 0.5 0 0\n}\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 1 0 0 0 0\n")
        file, out = self.path("arm.sbf"), self.path("arm.png")
        self.good("convert", rig, "-o", file)
        pictures = []
        for show in ((), ("--show", "bones"), ("--show", "surface")):
            self.good("render", file, "-o", out, *SMALL, *show)
            pictures.append(read_bytes(out))
        self.assertEqual(pictures[0], pictures[1])
        self.assertNotEqual(pictures[0], pictures[2])

    def test_a_picture_has_the_requested_size(self):
        for size in ("160x120", "97x41"):
            width, height, _, _ = read_png(self.draw("a.png", "--size", size))
            self.assertEqual(f"{width}x{height}", size)

    def test_a_picture_shows_something(self):
        self.assertGreater(len(colours(self.draw("a.png", *SMALL))), 500)

    def test_display_options_change_the_picture(self):
        pictures = {show: self.draw("a.png", *SMALL, "--show", show)
                    for show in ("surface", "springs", "surface,springs", "bones", "hulls", "strain", "surface,joints", "surface,bounds")}
        self.assertEqual(len(set(pictures.values())), len(pictures))

    def test_hulls_without_bones_follow_their_character(self):
        """A figure is as large in a picture with the hulls of its bodies two metres up as on the ground: they lie in it."""
        figure, shares = self.path("figure.sbfz"), []
        self.good("build", ROOT + "/examples/bones/figure.sbf", "-o", figure, "--elements", "300")
        for raised in ("0", "2"):
            self.good("render", figure, "-o", self.path("a.png"), *SMALL, "--raise", raised, "--show", "surface,hulls")
            _, _, channels, rows = read_png(read_bytes(self.path("a.png")))
            pixels = [row[x:x + 3] for row in rows for x in range(0, len(row), channels)]
            shares.append(sum(g > r + 8 for r, g, _ in pixels) / len(pixels))
        self.assertGreater(shares[0], 0.05)
        self.assertAlmostEqual(shares[1], shares[0], delta=0.3 * shares[0])

    def test_feet_have_their_marks(self):
        walk = ("--size", "480x360", "--seconds", "1.5", "--drive", "0.3,0.35")
        with_marks, without = (marked(self.draw("a.png", *walk, "--show", show)) for show in ("surface,feet", "surface"))
        for kind in MARKS:
            with self.subTest(kind):
                self.assertGreater(with_marks[kind], 9)
                self.assertLess(without[kind], 3)

    def test_hard_edges_of_the_source_stay_hard(self):
        """On either side of an edge seen in the middle a cube's colours differ by a step where its source states
        normals of faces, and hardly where it states none, as then its surface is smooth."""
        corners = "".join(f"v {i >> 2 & 1} {i >> 1 & 1} {i & 1}\n" for i in range(8))
        faces = ((1, 0, 0), (4, 6, 7, 5)), ((-1, 0, 0), (0, 1, 3, 2)), ((0, 1, 0), (2, 3, 7, 6)), \
            ((0, -1, 0), (0, 4, 5, 1)), ((0, 0, 1), (1, 5, 7, 3)), ((0, 0, -1), (0, 2, 6, 4))
        normals = "".join("vn {} {} {}\n".format(*normal) for normal, _ in faces)
        steps = {}
        for kind, corner in (("hard", "{0}//{1}"), ("smooth", "{0}")):
            lines = [" ".join(["f"] + [corner.format(c + 1, n + 1) for c in face]) for n, (_, face) in enumerate(faces)]
            source, file, out = (self.path(f"{kind}.{ending}") for ending in ("obj", "sbf", "png"))
            write_bytes(source, (corners + normals + "\n".join(lines) + "\n").encode())
            self.good("convert", source, "-o", file, "--elements", "100")
            self.good("render", file, "-o", out, *SMALL, "--view", "45,15")
            _, _, channels, rows = read_png(read_bytes(out))
            left, right = (rows[60][x * channels:x * channels + 3] for x in (78, 82))
            steps[kind] = max(abs(a - b) for a, b in zip(left, right))
        self.assertGreater(steps["hard"], 25)
        self.assertLess(steps["smooth"], 12)

    def test_a_picture_of_a_later_moment_differs(self):
        self.assertNotEqual(self.draw("a.png", *SMALL), self.draw("b.png", *SMALL, "--seconds", "1", "--drive", "0.3,0"))

    def test_the_same_call_draws_the_same(self):
        self.assertEqual(self.draw("a.png", *SMALL), self.draw("b.png", *SMALL))

    @unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
    def test_a_gif_of_a_walk(self):
        data = self.draw("a.gif", *SMALL, "--seconds", "0.5", "--fps", "10", "--drive", "0.3,0")
        self.assertIn(data[:6], (b"GIF87a", b"GIF89a"))
        self.assertEqual(struct.unpack_from("<HH", data, 6), (160, 120))
        self.assertGreaterEqual(data.count(b"\x21\xf9\x04"), 5)  # a control block for each frame

    @unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
    def test_few_colours_make_a_small_gif(self):
        walk = (*SMALL, "--seconds", "0.5", "--fps", "10", "--drive", "0.3,0")
        small, large = self.draw("a.gif", *walk, "--colors", "16"), self.draw("b.gif", *walk)
        self.assertLess(len(small), 0.6 * len(large))

    @unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
    def test_a_webp_of_a_walk(self):
        walk = (*SMALL, "--seconds", "0.5", "--fps", "20", "--drive", "0.3,0")
        data, small = self.draw("a.webp", *walk), self.draw("b.webp", *walk, "--quality", "10")
        self.assertEqual((data[:4], data[8:16]), (b"RIFF", b"WEBPVP8X"))
        self.assertEqual([1 + int.from_bytes(data[at:at + 3], "little") for at in (24, 27)], [160, 120])
        frames, at = [], 12  # how long each is shown, ms
        while at < len(data):
            if data[at:at + 4] == b"ANMF":
                frames.append(int.from_bytes(data[at + 20:at + 23], "little"))
            at += 8 + (int.from_bytes(data[at + 4:at + 8], "little") + 1 & ~1)
        self.assertGreaterEqual(len(frames), 8)
        self.assertAlmostEqual(sum(frames), 550, delta=60)
        self.assertLess(len(small), 0.8 * len(data))

    def red_of_box(self, image, *arguments):
        """How many of the picture's colours are red, what `render` says, and how the report captions the skin, for a
        box that wears this image; None: no file."""
        self.good("convert", textured_box.write(self.path(""), image), "-o", self.path("box.sbf"), "--springs", "surface", "--report",
                  self.path("box.json"))
        caption = json.loads(read_text(self.path("box.json")))["pictures"][0]["caption"]
        printed = self.good("render", self.path("box.sbf"), "-o", self.path("box.png"), *SMALL, *arguments).err
        red = sum(r > 100 and r > 2 * max(g, b) for r, g, b in colours(read_bytes(self.path("box.png"))))
        return red, printed, caption

    def test_base_colour_images_are_drawn(self):
        red, printed, caption = self.red_of_box(textured_box.png_of(4, 4, (230, 20, 20)))
        self.assertGreater(red, 20)
        self.assertNotIn("not drawn", printed + caption)

    def test_a_skin_seen_through_has_no_image(self):
        red, printed, _ = self.red_of_box(None, "--show", "surface,bones")
        self.assertEqual((red, "not drawn" in printed), (0, False))

    def test_unsupported_images_are_reported(self):
        whole = textured_box.png_of(4, 4, (230, 20, 20))
        for name, image, reason in (("missing", None, "cannot be read"), ("cut short", whole[:-30], "damaged"),
                                    ("empty", b"", "empty"), ("JPEG", b"\xff\xd8\xff\xe0" + bytes(40), "JPEG")):
            with self.subTest(name):
                red, printed, caption = self.red_of_box(image)
                self.assertEqual(red, 0)
                self.assertRegex(printed, f"warning: the image 'red.png' is not drawn.*{reason}.*IMAGE_NOT_DRAWN")
                self.assertRegex(caption, f"The image 'red.png' is not drawn.*{reason}")

    def test_camera_options_change_the_view(self):
        usual, same, above = (self.draw("a.png", *SMALL, "--view", view) for view in ("41.25,14.9", "41.25,14.9", "200,70"))
        self.assertEqual(usual, same)
        self.assertNotEqual(usual, above)

    @unittest.skipUnless(shutil.which("ffmpeg"), "no ffmpeg")
    def test_a_film_of_a_walk(self):
        data = self.draw("a.mp4", *SMALL, "--seconds", "0.5", "--fps", "10")
        self.assertEqual(data[4:8], b"ftyp")
        self.assertIn(b"moov", data)

    def test_wrong_calls_give_no_output(self):
        for arguments in (("-o", self.path("a.bmp")), (), ("-o", self.path("a.png"), "--show", "hair"),
                          ("-o", self.path("a.png"), "--size", "0x0"), ("-o", self.path("a.png"), "--size", "wide"),
                          ("-o", self.path("a.png"), "--view", "30"), ("-o", self.path("a.png"), "--view", "0,90"),
                          ("-o", self.path("a.png"), "--colors", "16"), ("-o", self.path("a.gif"), "--colors", "2"),
                          ("-o", self.path("a.gif"), "--quality", "50"), ("-o", self.path("a.webp"), "--quality", "0"),
                          ("-o", self.path("a.webp"), "--colors", "16"),
                          ("-o", self.path("no folder/a.png"), *SMALL)):
            with self.subTest(arguments):
                self.fails(2, "render", self.file, *arguments)
        self.fails(2, "render", self.path("absent.sbf"), "-o", self.path("a.png"))
        self.assert_empty_folder()


if __name__ == "__main__":
    main()
