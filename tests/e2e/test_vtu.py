"""VTK XML files: all encodings of VTK give the same grid. A truncated or changed file gives an error or a valid grid."""

import re

from bundle_file import Bundle, rows
from sbfmt_program import ProgramTest, call, main, write_bytes
from vtu_files import CELLS, POINTS, every_way, vtu


class Vtu(ProgramTest):
    def grid(self, content):
        path = write_bytes(self.path("a.vtu"), content)
        printed = self.good("convert", "--no-build", path, "-o", self.path("out.sbf")).err
        level, = Bundle(self.path("out.sbf")).root.iter("level")
        points = rows([float(n) for n in level.find("positions").text.split()], 3)
        return points, rows([int(n) for e in level.iter("tetrahedra") for n in e.text.split()], 4), printed

    def test_every_encoding_gives_the_same_grid(self):
        for name, content in every_way():
            with self.subTest(name):
                points, tetrahedra, printed = self.grid(content)
                self.assertEqual(points, POINTS)
                self.assertEqual([sorted(t) for t in tetrahedra], [[0, 1, 2, 3], [1, 2, 3, 4]])
                self.assertIn("1 elements that are not tetrahedra", printed)

    def test_pieces_are_joined(self):
        moved = [(x + 5, y, z) for x, y, z in POINTS]
        points, tetrahedra, _ = self.grid(vtu("appended raw", True, pieces=((POINTS, CELLS), (moved, CELLS))))
        self.assertEqual(sorted(points), sorted(POINTS + moved))
        self.assertEqual(len(tetrahedra), 4)

    def test_a_large_grid_of_many_blocks(self):
        points, cells = [], []
        for i in range(3000):
            cells.append((10, tuple(range(4 * i, 4 * i + 4))))
            points += [(x + 2 * i, y, z) for x, y, z in POINTS[:4]]
        for encoding in ("binary", "appended raw", "appended base64"):
            found, tetrahedra, _ = self.grid(vtu(encoding, True, block=4096, pieces=((points, cells),)))
            self.assertEqual(len(tetrahedra), 3000)
            self.assertEqual(found, points)

    def test_the_build_accepts_it(self):
        path = write_bytes(self.path("a.vtu"), vtu())
        self.good("convert", path, "-o", self.path("out.sbfz"))
        self.good("validate", self.path("out.sbfz"))

    def test_cut_files(self):
        for _, content in every_way():
            for fraction in (0.3, 0.6, 0.9):
                path = write_bytes(self.path("cut.vtu"), content[:int(len(content) * fraction)])
                result = call("convert", "--no-build", path, "-o", self.path("cut.sbf"))
                self.assertIn(result.status, (0, 1), result.err)
                if result.status:
                    self.assertRegex(result.err, r"error: .*cut\.vtu.*\[[A-Z_]+\]")
                    self.assert_empty_folder(but=["cut.vtu"])

    def test_other_kinds_are_refused_with_advice(self):
        for old, new, word in ((b"UnstructuredGrid", b"PolyData", "type UnstructuredGrid"),
                               (b"vtkZLibDataCompressor", b"vtkLZ4DataCompressor", "zlib")):
            path = write_bytes(self.path("a.vtu"), vtu("binary", True).replace(old, new))
            message = self.fails(1, "convert", path, "-o", self.path("out.sbf"))
            self.assertTrue(re.search(rf"{word}.*\[IMPORT_REFUSED\]", message), message)


if __name__ == "__main__":
    main()
