"""Tests `examples/drop`, the drop of the thesis: loose sections fall from a metre, keep their volume in every frame, stay above
the floor, and come to rest within five seconds. The same holds for a surface four times as fine."""

import array
import importlib.util
import math
import os
import sys

from motion_files import PC2_HEADER, PointCache
from sbfmt_program import EXAMPLE, ROOT, ProgramTest, built_of_modulus, convert_once, main, needs_lizard, shared

DROP = ("--free", "--raise", "1", "--seconds", "5")
KEPT, SAME, RESTING = 0.95, 0.05, 0.03  # volume, its share between surfaces, and m/s


def subdivide():
    """examples/drop/subdivide.py as a module."""
    spec = importlib.util.spec_from_file_location("subdivide", os.path.join(ROOT, "examples", "drop", "subdivide.py"))
    module = importlib.util.module_from_spec(spec)
    sys.dont_write_bytecode = True
    spec.loader.exec_module(module)
    return module


def subdivided(folder, name, path, times):
    module = subdivide()
    points, parts = module.read_obj(path)
    for _ in range(times):
        points, parts = module.divide(points, parts)
    out = os.path.join(folder, name)
    module.write_obj(out, points, parts)
    return out


class Drop(ProgramTest):
    def drop(self, path, *options):
        """The report, the minimum height of a surface at any frame, and the maximum speed of one in the last frame."""
        out = self.path("drop.pc2")
        report = self.json_of("run", path, *DROP, "--cache", out, "--of", "surface", *options)
        cache = PointCache(out)
        positions = array.array("f", cache.bytes[PC2_HEADER.size:])
        size = 3 * cache.point_count
        before, last = positions[-2 * size:-size], positions[-size:]
        speeds = (60 * math.dist(before[i:i + 3], last[i:i + 3]) for i in range(0, size, 3))
        return report, min(positions[1::3]), max(speeds)

    def fares_well(self, path, *options):
        report, lowest, speed = self.drop(path, *options)
        self.assertTrue(report["valid"])
        self.assertGreater(report["volume_ratio_least"], KEPT)
        self.assertGreater(lowest, -1e-4)
        self.assertLess(speed, RESTING)
        return report

    def test_the_example_lizard(self):
        self.fares_well(convert_once(self.class_folder.name, "as-it-is.sbfz", os.path.join(EXAMPLE, "lizard.obj"),
                                     "--rig", os.path.join(EXAMPLE, "lizard.glb")))

    def test_threads_change_nothing(self):
        path = convert_once(self.class_folder.name, "as-it-is.sbfz", os.path.join(EXAMPLE, "lizard.obj"), "--rig",
                            os.path.join(EXAMPLE, "lizard.glb"))
        hashes = {self.json_of("run", path, "--free", "--raise", "1", "--seconds", "1", "--threads",
                               threads)["state_hash"] for threads in (1, 3)}
        self.assertEqual(len(hashes), 1)

    @needs_lizard
    def test_the_thesis_lizard_at_three_resolutions(self):
        minimum = []
        for times in range(3):
            obj = shared("lizard", "liz.obj")
            if times:
                obj = subdivided(self.class_folder.name, f"liz{times}.obj", obj, times)
            path = convert_once(self.class_folder.name, f"liz{times}.sbfz", obj, "--rig", shared("lizard", "liz.fbx"))
            minimum.append(self.fares_well(path)["volume_ratio_least"])
        self.assertLess(max(minimum) - min(minimum), SAME)

    @needs_lizard
    def test_lattices_do_not_dip_in(self):
        # Subdivided once: the file's own surface has a stray point, in no polygon, far from all matter.
        obj = subdivided(self.class_folder.name, "once.obj", shared("lizard", "liz.obj"), 1)
        source = convert_once(self.class_folder.name, "once.sbf", obj, "--rig", shared("lizard", "liz.fbx"), "--no-build")

        def lattice(name, modulus, elements):
            return built_of_modulus(self.class_folder.name, name, source, modulus, "--springs", "tetrahedra", "--elements",
                                    elements)
        for modulus, kept in ((8e4, KEPT), (2e4, 0.9)):  # of muscle and of flesh, the softest that is guessed
            report, lowest, _ = self.drop(lattice(f"{modulus:.0f}.sbfz", modulus, 240))
            self.assertTrue(report["valid"], modulus)
            self.assertGreater(report["volume_ratio_least"], kept, modulus)
            self.assertGreater(lowest, -2e-3, modulus)
            fine = lattice(f"{modulus:.0f}_fine.sbfz", modulus, 1000)
            fall = self.json_of("run", fine, "--free", "--raise", 1, "--seconds", 1.5)
            self.assertTrue(fall["valid"], modulus)  # corners that strike stay sound


class Subdivision(ProgramTest):
    def test_a_cube_is_four_times_as_fine(self):
        cube = self.path("cube.obj")
        with open(cube, "w", encoding="utf-8") as stream:
            stream.write("o Cube\n" + "".join(f"v {i & 1} {i >> 1 & 1} {i >> 2}\n" for i in range(8)))
            stream.write("f 1 3 4 2\nf 5 6 8 7\nf 1/1 2/2 6/3 5/4\nf -6 -5 -1 -2\nf 1 5 7\nf 1 7 3\nf 2 4 8 6\n")
        out = subdivided(self.folder, "fine.obj", cube, 1)
        points, parts = subdivide().read_obj(out)
        self.assertEqual(parts[0][0], "o Cube")
        # Points of 8 corners, 13 edges and 5 quads; each quad and each triangle becomes 4 polygons.
        self.assertEqual((len(points), len(parts[0][1])), (8 + 13 + 5, 28))
        self.assertEqual(min(points), (0, 0, 0))
        self.assertEqual(max(points), (1, 1, 1))
        sizes = sorted(len(polygon) for polygon in parts[0][1])
        self.assertEqual(sizes, [3] * 8 + [4] * 20)


if __name__ == "__main__":
    main()
