"""Tests that sections of springs keep their shape to the tip of the tail, at rest under gravity and while shaken,
because their springs have the stiffness of the material."""

import os
import unittest
import xml.etree.ElementTree as ElementTree

from motion_files import PointCache, read_sections
from section_shape import shape_error, volume_of
from sbfmt_program import ProgramTest, built_of_modulus, ROOT, main, shared

OURS = [os.path.join(ROOT, "examples", "lizard", "lizard." + form) for form in ("obj", "glb")]
THESIS = [shared("lizard", "liz." + form) for form in ("obj", "fbx")]
SHAKING = "".join(f"{0.1 + 0.25 * i:g} drive 0.2 {2.5 if i % 2 else -2.5}\n" for i in range(8))


def polygons_of(path):
    """Of every body, in file order: its polygons' points."""
    for body in ElementTree.parse(path).getroot().findall("soft_body"):
        numbers = iter([int(n) for n in body.find("polygon_mesh/polygon_points").text.split()])
        sizes = [int(n) for n in body.find("polygon_mesh/polygon_sizes").text.split()]
        yield [[next(numbers) for _ in range(size)] for size in sizes]


class TailShape(ProgramTest):
    def converted(self, files):
        self.good("convert", files[0], "--rig", files[1], "-o", self.path("out.sbf"))
        return self.path("out.sbf")

    def worst(self, bundle, *how):
        """Of the tail's sections: {name: (greatest shape error, least share of the volume)} over the run."""
        self.good("run", bundle, *how, "--seconds", "2", "--fps", "30", "--cache", self.path("all.pc2"), "--of", "surface")
        cache, found = PointCache(self.path("all.pc2")), {}
        for section, polygons in zip(read_sections(bundle), polygons_of(bundle)):
            if "tail" not in section.name.lower():
                continue
            full, errors, volumes = volume_of(polygons, section.rest), [], []
            for sample in range(0, cache.sample_count, 3):
                positions = [cache.place(sample, section.first + i) for i in range(len(section.rest))]
                errors.append(shape_error(section, [positions[i] for i in section.used]))
                volumes.append(volume_of(polygons, positions) / full)
            found[section.name] = (max(errors), min(volumes), max(volumes))
        return found

    def shaken(self, bundle):
        with open(self.path("shake.txt"), "w", encoding="utf-8") as stream:
            stream.write(SHAKING)
        return self.worst(bundle, "--script", self.path("shake.txt"))

    def check(self, files, error, of_flesh):
        """Held and shaken each section keeps its shape and volume, as flesh and of 80 kPa; without calibration the worst of
        80 kPa does so less."""
        flesh, worst = self.converted(files), 0
        stiffer = built_of_modulus(self.folder, "stiffer.sbf", flesh, 8e4)
        for bundle, most_error in ((flesh, of_flesh), (stiffer, error)):
            for found in (self.worst(bundle, "--hold", "--raise", "0.5"), self.shaken(bundle)):
                self.assertGreaterEqual(len(found), 3)
                for name, (shape, minimum, maximum) in found.items():
                    self.assertLess(shape, most_error, name)
                    self.assertGreater(minimum, 0.99, name)
                    self.assertLess(maximum, 1.01, name)
                    if bundle == stiffer:
                        worst = max(worst, shape)
        loose = self.shaken(built_of_modulus(self.folder, "loose.sbf", flesh, 8e4, "--no-calibration"))
        self.assertGreater(max(shape for shape, _, _ in loose.values()), 2 * worst)

    def test_our_lizard(self):
        self.check(OURS, 0.0015, 0.004)

    @unittest.skipUnless(all(os.path.exists(path) for path in THESIS), "the thesis's lizard is not there")
    def test_the_thesis_lizard(self):
        self.check(THESIS, 0.006, 0.01)


if __name__ == "__main__":
    main()
