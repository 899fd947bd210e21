"""Every file of ../shared/data: it converts with the counts that its folder's README states, or ends in the error named
here. Where assimp invents or loses something (the list in data/README.md) the code that says so is expected.

Expected numbers come from the README tables, which independent parsers wrote; what differs from them is listed here with
its reason. How many soft sections come of a skin is not this test's matter."""

import collections
import os
import re
import unittest

from bundle_file import Bundle, numbers
from glb_file import Glb
from sbfmt_program import SHARED, SOURCE_PARTS, ProgramTest, call, main, read_text, shared

PASSED_OVER = (".md", ".mtl")

ERRORS = {
    "bad/empty.obj": ("IMPORT_EMPTY", "no vertices"),
    "bad/malformed.obj": ("IMPORT_INDEX", "counted from 1"),
    "bad/malformed2.obj": ("IMPORT_POLYGON", "three corners"),
    "bad/empty_init_from.dae": ("IMPORT_CRASHED", "export it again"),
    "bad/md5_overflow_vertex.md5mesh": ("IMPORT_(CRASHED|EMPTY)", "."),  # it writes beyond its memory
    "bad/position_bad_count.dae": ("IMPORT_EMPTY", "neither a surface nor bones"),  # not the mesh assimp invents
    "sausage/sausage_6100_unsupported.fbx": ("IMPORT_REFUSED", "export it as a current FBX"),
}

# Points, if they differ from the README's vertices; points of a GLB are counted from the file.
POINTS = {
    "lizard/liz.fbx": 524,  # assimp loses the stray vertex of Arm1.R, which is in no polygon
    "lizard/lizart.fbx": 592,  # and here
    "walk-dae/walk.dae": 7786,  # 59 of its 7845 vertices have the position and weights of another
}
OBJECTS = {
    "mocap/cmu_01_01.bvh": 0,  # the mesh that assimp invents is not there
}
BONES = {
    "lizard/lizart.glb": 20,
    "sausage/sausage_7500_ascii.fbx": 4,
    "sausage/sausage_blender_7400.fbx": 4,
}
CLIPS = {
    "fox/fox.glb": 3, "greenman/greenman.glb": 4, "snake/snake.glb": 4, "spider/spider.glb": 5,
    "kenney-fbx/kenney_character.fbx": 1, "sausage/sausage_blender_7400.fbx": 3, "walk-dae/walk.dae": 1,
    "letter-f/letter_f.dae": 1, "letter-f/letter_f_chain3.dae": 1, "mocap/cmu_01_01.bvh": 1,
}
JOINED, POSE = "IMPORT_POINTS_JOINED", "IMPORT_POSE"
COLORS = "IMPORT_IGNORED"  # those of vertices, in an FBX
NOTES = {
    "armadillo/armadillo_1k.obj": {"IMPORT_MATERIALS_MISSING"},
    "cloth/cloth_25.obj": {"IMPORT_MATERIALS_MISSING"},
    "fox/fox.glb": {JOINED}, "greenman/greenman.glb": {JOINED},
    "kenney-fbx/kenney_character.fbx": {JOINED, POSE, COLORS},
    "letter-f/letter_f.dae": {JOINED}, "letter-f/letter_f_chain3.dae": {JOINED},
    "lizard/liz.fbx": {JOINED, COLORS}, "lizard/lizart.fbx": {JOINED, COLORS},
    "lizard/lizart.glb": {JOINED, "IMPORT_INSIDE_OUT"},
    "mocap/cmu_01_01.bvh": {"IMPORT_NO_MESH", "IMPORT_GROUND"},
    "sausage/sausage_7500_ascii.fbx": {JOINED}, "sausage/sausage_blender_7400.fbx": {JOINED, POSE},
    "snake/snake.glb": {JOINED, POSE, "IMPORT_GROUND"}, "spider/spider.glb": {JOINED, POSE},
    "walk-dae/walk.dae": {JOINED, "IMPORT_FACING", "IMPORT_GROUND"},  # along +X
}

Row = collections.namedtuple("Row", "objects points polygons sides triangles bones")


def number(text):
    return int(text) if text.strip() else 0


def readme_rows():
    """{path: Row} of all the tables."""
    found = {}
    for folder in sorted(os.listdir(SHARED)):
        readme = shared(folder, "README.md")
        if not os.path.isfile(readme):
            continue
        for line in read_text(readme).splitlines():
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            if line.startswith("| ") and len(cells) > 8 and os.path.isfile(shared(folder, cells[0])):
                sides = tuple(map(number, cells[5].split("/"))) if cells[5] != "//" else ()
                found[f"{folder}/{cells[0]}"] = Row(number(cells[2]), number(cells[3]), number(cells[4]), sides,
                                                    number(cells[6]), number(cells[7]))
    return found


def files():
    for folder, _, names in sorted(os.walk(SHARED)):
        for name in sorted(names):
            path = os.path.relpath(os.path.join(folder, name), SHARED)
            if "/" in path and not name.endswith(PASSED_OVER):
                yield path.replace(os.sep, "/")


def is_of_tetrahedra(path):
    return path.endswith((".node", ".ele", ".msh", ".vtk", ".tet"))


def points_of_glb(path):
    """Points that a reader of the file finds: vertices of a node with equal positions and weights are one."""
    glb, found = Glb(path), set()
    for node, primitive in glb.primitives():
        attributes = primitive["attributes"]
        places = glb.accessor(attributes["POSITION"])
        influences = [()] * len(places)
        if "JOINTS_0" in attributes:
            pairs = zip(glb.accessor(attributes["JOINTS_0"]), glb.accessor(attributes["WEIGHTS_0"]))
            influences = [tuple(sorted((j, w) for j, w in zip(*pair) if w > 0)) for pair in pairs]
        found |= {(node, position, moved) for position, moved in zip(places, influences)}
    return len(found)


def codes(text):
    return set(re.findall(r"\[([A-Z_]+)\]", text))


@unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
class EveryFile(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.readme = readme_rows()

    def row(self, path):
        return self.readme[path[:-4] + ".node" if path.endswith(".ele") else path]

    def test_the_tables_name_files_that_are_there(self):
        there = set(files())
        for table in (ERRORS, POINTS, OBJECTS, BONES, CLIPS, NOTES):
            self.assertEqual(set(table) - there, set())
        self.assertGreater(len(there), 50)
        self.assertEqual({p for p in there if not p.endswith(".ele")} - set(self.readme), set())

    def test_broken_files_give_their_error(self):
        for path, (code, word) in ERRORS.items():
            for options in ((), (*SOURCE_PARTS,)):
                with self.subTest(path, options=options):
                    message = self.fails(1, "convert", shared(path), "-o", self.path("out.sbf"), *options)
                    self.assertRegex(message, rf"error: .*{os.path.basename(path)}.*{word}.*\[{code}\]")
                    self.assert_empty_folder()

    def test_source_parts_have_the_counts_of_the_readme(self):
        for path in files():
            if path not in ERRORS:
                with self.subTest(path):
                    self.check_counts(path, self.row(path))

    def check_counts(self, path, row):
        out = self.path("out.sbf")
        printed = self.good("convert", *SOURCE_PARTS, shared(path), "-o", out).err
        bundle = Bundle(out)
        if is_of_tetrahedra(path):
            self.check_tetrahedra(bundle, row)
        else:
            self.check_meshes(path, bundle, row)
        self.assertEqual(len(bundle.bones), BONES.get(path, row.bones))
        self.assertEqual(len(bundle.clips), CLIPS.get(path, 0))
        expected = NOTES.get(path, set()) | (set() if bundle.bones or is_of_tetrahedra(path) else {"IMPORT_NO_RIG"})
        self.assertEqual({code for code in codes(printed) if code.startswith("IMPORT_")}, expected)

    def check_tetrahedra(self, bundle, row):
        level, = bundle.root.iter("level")
        self.assertEqual(len(numbers(level, "positions")), 3 * row.points)
        self.assertEqual(len([n for e in level.iter("tetrahedra") for n in e.text.split()]), 4 * row.polygons)
        surface, = bundle.meshes
        self.assertEqual(bundle.polygon_sizes(surface), [3] * row.triangles)

    def check_meshes(self, path, bundle, row):
        points = points_of_glb(shared(path)) if path.endswith(".glb") else POINTS.get(path, row.points)
        sizes = [n for mesh in bundle.meshes for n in bundle.polygon_sizes(mesh)]
        self.assertEqual(len(bundle.meshes), OBJECTS.get(path, row.objects))
        self.assertEqual(sum(len(bundle.positions(mesh)) for mesh in bundle.meshes), points)
        self.assertEqual(len(sizes), row.polygons)
        self.assertEqual((sizes.count(3), sizes.count(4), sum(n > 4 for n in sizes)), row.sides or (0, 0, 0))
        self.assertEqual(sum(n - 2 for n in sizes), row.triangles)

    def test_every_other_file_is_built_and_valid(self):
        for path in files():
            if path in ERRORS:
                continue
            with self.subTest(path):
                out = self.path("out.sbfz")
                # with springs, which are fast to build: lattices have tests of their own
                self.good("convert", shared(path), "--springs", "centroid", "--no-calibration", "-o", out)
                report = self.json_of("validate", out, status=call("validate", out).status)
                self.assertEqual({m["code"] for m in report["messages"] if m["severity"] == "error"}, set())


if __name__ == "__main__":
    main()
