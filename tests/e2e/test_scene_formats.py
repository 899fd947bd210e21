"""Formats that assimp reads, without real files: a small box in each, written by scene_files.py."""

import re
import unittest

from bundle_file import Bundle, numbers
import scene_files
from sbfmt_program import SOURCE_PARTS, ProgramTest, call, main, write_bytes

TURNED = {"box.3ds", "box.ase", "box.dxf"}  # +Z up in the form itself: assimp turns them
MIRRORED = {"box.x"}  # left-handed in the form itself: assimp mirrors them, we turn the polygons
QUADS = {"box.dae", "box.ply", "binary.ply", "box.off", "box.x", "box.ac", "box.nff", "box.dxf"}
NAMES = {"box.3ds": "3DSMesh_0", "box.3mf": "Object_1", "box.amf": "0", "box.dae": "n", "binary.ply": "binary",
         "binary.stl": "binary"}
JOINED = {"IMPORT_POINTS_JOINED"}
COLORS = "IMPORT_IGNORED"  # those of vertices, but in glTF
NOTES = {"box.gltf": set(), "box.ply": set(), "binary.ply": set(), "box.off": set(), "box.3mf": {"IMPORT_UNIT"},
         "box.amf": {"IMPORT_UNIT", COLORS}, "box.dxf": JOINED | {COLORS}, "box.nff": JOINED | {"IMPORT_INSIDE_OUT"}}


def codes(text):
    return {code for code in re.findall(r"\[([A-Z_]+)\]", text) if code.startswith("IMPORT_")}


def volume(points, sizes, corners):
    total, at = 0, 0
    for size in sizes:
        first, *others = (points[i] for i in corners[at:at + size])
        for a, b in zip(others, others[1:]):
            total += (first[0] * (a[1] * b[2] - a[2] * b[1]) + first[1] * (a[2] * b[0] - a[0] * b[2]) +
                      first[2] * (a[0] * b[1] - a[1] * b[0])) / 6
        at += size
    return total


class Boxes(ProgramTest):
    def converted(self, name, content, *options):
        path = write_bytes(self.path(name), content)
        printed = self.good("convert", *SOURCE_PARTS, path, "-o", self.path("out.sbf"), *options).err
        return Bundle(self.path("out.sbf")), printed

    def check_box(self, bundle, low, high):
        mesh, = bundle.meshes
        points, sizes = bundle.positions(mesh), bundle.polygon_sizes(mesh)
        self.assertEqual(len(points), 8)
        for k in range(3):
            self.assertAlmostEqual(min(p[k] for p in points), low[k], places=5)
            self.assertAlmostEqual(max(p[k] for p in points), high[k], places=5)
        corners = [int(n) for n in numbers(mesh.find("polygon_mesh"), "polygon_points")]
        whole = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2])
        self.assertAlmostEqual(volume(points, sizes, corners) / whole, 1, places=4)  # and faces outwards
        return mesh, sizes

    def test_every_form(self):
        for name, make in scene_files.FILES.items():
            with self.subTest(name):
                bundle, printed = self.converted(name, make())
                low, high = (0, 0, 0), (1, 2, 3)
                if name in TURNED:
                    low, high = (0, 0, -2), (1, 3, 0)
                elif name in MIRRORED:
                    low, high = (0, 0, -3), (1, 2, 0)
                mesh, sizes = self.check_box(bundle, low, high)
                self.assertEqual(sizes, [4] * 6 if name in QUADS else [3] * 12)
                self.assertEqual(mesh.get("name"), NAMES.get(name, "box"))
                has_rig = name == "box.smd"
                self.assertEqual(len(bundle.bones), 2 if has_rig else 0)
                self.assertEqual(codes(printed), NOTES.get(name, JOINED) | (set() if has_rig else {"IMPORT_NO_RIG"}))

    def test_unit_and_axes_from_the_file_and_overrides_from_the_call(self):
        bundle, _ = self.converted("a.dae", scene_files.dae("Z_UP", 0.01))
        self.check_box(bundle, (0, 0, -0.02), (0.01, 0.03, 0))
        bundle, _ = self.converted("a.ply", scene_files.ply(), "--unit", "0.1", "--up", "z")
        self.check_box(bundle, (0, 0, -0.2), (0.1, 0.3, 0))

    def test_invalid_numbers_are_refused(self):
        for name, content in (("nan.ply", scene_files.ply().replace(b"0 0 3", b"0 nan 3")),
                              ("nan.stl", scene_files.stl_binary().replace(b"\0\0\x40\x40", b"\0\0\xc0\x7f")),
                              ("inf.off", scene_files.off().replace(b"0 0 3", b"0 1e999 3"))):
            with self.subTest(name):
                path = write_bytes(self.path(name), content)
                self.assertIn("[IMPORT_", self.fails(1, "convert", path, "-o", self.path("out.sbf")))
                self.assert_empty_folder(but=["nan.ply", "nan.stl", "inf.off"])

    def test_cut_files_are_refused_or_read_whole(self):
        for name, make in scene_files.FILES.items():
            content = make()
            for fraction in (0.1, 0.5, 0.9):
                with self.subTest(name, fraction=fraction):
                    path = write_bytes(self.path(name), content[:int(len(content) * fraction)])
                    result = self.call_convert(path)
                    self.assertIn(result.status, (0, 1), result.err)
                    if result.status == 1:
                        self.assertRegex(result.err, r"error: .*\[IMPORT_[A-Z]+\]")

    def test_a_ply_that_ends_in_its_header_is_refused_at_once(self):
        content = scene_files.ply_binary()
        for size in (1, 4, 20, content.index(b"end_header") + 6):
            path = write_bytes(self.path("cut.ply"), content[:size])
            self.assertRegex(self.fails(1, "convert", path, "-o", self.path("out.sbf")),
                             r"cut\.ply: the header of the PLY file does not end.* \[IMPORT_SYNTAX\]")

    def call_convert(self, path):
        return call("convert", *SOURCE_PARTS, path, "-o", self.path("out.sbf"))


if __name__ == "__main__":
    main()
