"""`info` describes a large packed file from its outline, with the figures that its geometry would give."""

import math
import os
import random
import re

from sbfmt_program import ROOT, ProgramTest, main, read_bytes, write_bytes

MOST_READ = 64 * 1024


def tube(rings, segments):
    """An OBJ of a closed tube, rough enough that it packs badly: `rings` rings of `segments` points, two caps."""
    noise = random.Random(1)
    lines = []
    for i in range(rings * segments):
        around, radius = 2 * math.pi * (i % segments) / segments, 1 + 0.1 * noise.random()
        along = 0.05 * (i // segments) + 0.01 * noise.random()
        lines.append(f"v {radius * math.cos(around):.7f} {along:.7f} {radius * math.sin(around):.7f}")
    for i in range(rings - 1):
        for k in range(segments):
            a, b = i * segments + k + 1, i * segments + (k + 1) % segments + 1
            lines.append(f"f {a} {a + segments} {b + segments} {b}")
    lines.append("f " + " ".join(str(k + 1) for k in range(segments)))
    lines.append("f " + " ".join(str((rings - 1) * segments + k + 1) for k in reversed(range(segments))))
    return "\n".join(lines) + "\n"


class InfoFigures(ProgramTest):
    def read_of(self, path):
        """Bytes of the file that `info` says it has read."""
        return int(re.search(r"(\d+) of them read", self.good("info", path).out).group(1))

    def test_large_files_are_read_in_part(self):
        source, packed, text = self.path("tube.obj"), self.path("tube.sbfz"), self.path("tube.sbf")
        with open(source, "w", encoding="ascii") as stream:
            stream.write(tube(300, 180))
        self.good("convert", source, "-o", packed)
        self.assertGreater(os.path.getsize(packed), 1 << 20, "large enough for an outline")
        self.good("unpack", packed, "-o", text)
        here, there = self.json_of("info", packed), self.json_of("info", text)
        self.assertLess(self.read_of(packed), MOST_READ)
        self.assertEqual(self.read_of(text), os.path.getsize(text))
        for key in there:
            if key != "bytes":
                self.assertEqual(here[key], there[key], key)

    def test_large_unbuilt_files_are_read_in_part(self):
        source, packed, text = self.path("tube.obj"), self.path("source.sbfz"), self.path("source.sbf")
        with open(source, "w", encoding="ascii") as stream:
            stream.write(tube(400, 240))
        self.good("convert", source, "--no-build", "-o", packed)
        self.assertGreater(os.path.getsize(packed), 1 << 20)
        self.good("unpack", packed, "-o", text)
        here, there = self.json_of("info", packed), self.json_of("info", text)
        self.assertLess(self.read_of(packed), MOST_READ)
        for key in there:
            if key != "bytes":
                self.assertEqual(here[key], there[key], key)

    def test_of_sections_cut_from_a_skin(self):
        """Their springs stand on a lattice: which points of the surface are theirs is in no outline."""
        source = os.path.join(ROOT, "examples", "calf", "calf.glb")
        packed, text = self.path("calf.sbfz"), self.path("calf.sbf")
        self.good("convert", source, "-o", packed)
        self.assertGreater(os.path.getsize(packed), MOST_READ, "large enough for an outline")
        self.good("unpack", packed, "-o", text)
        here, there = self.json_of("info", packed), self.json_of("info", text)
        self.assertGreater(min(section["interior_points"] for section in here["sections"]), 0)
        for key in there:
            if key != "bytes":
                self.assertEqual(here[key], there[key], key)

    def test_files_without_figures_are_read_whole(self):
        source, text, packed = self.path("tube.obj"), self.path("source.sbf"), self.path("unstated.sbfz")
        with open(source, "w", encoding="ascii") as stream:
            stream.write(tube(400, 240))
        self.good("convert", source, "--no-build", "-o", text)
        content, count = re.subn(rb'(<asset [^>]*?) mass="[^"]*" low="[^"]*" high="[^"]*"', rb"\1", read_bytes(text), count=1)
        self.assertEqual(count, 1)
        write_bytes(text, content)
        self.good("pack", text, "-o", packed)
        self.assertEqual(self.read_of(packed), os.path.getsize(packed))
        self.assertGreater(self.json_of("info", packed)["mass"], 0)


if __name__ == "__main__":
    main()
