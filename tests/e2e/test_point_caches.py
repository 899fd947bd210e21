"""Point caches: both forms have the same positions, and Blender's Mesh Cache plays both."""

import math
import os
import struct

import play_files
from bundle_file import rows
from sbfmt_program import ROOT, ProgramTest, call, example, main, read_bytes

FRAMES = 30
HOW = ("--seconds", "1", "--fps", "30", "--drive", "0.3,0.2")


class Caches(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.bundle = example(cls.class_folder.name)

    def samples(self, of):
        """Those of the PC2 and of the MDD, both checked against their headers."""
        for ending in ("pc2", "mdd"):
            self.good("run", self.bundle, *HOW, "--cache", self.path("a." + ending), "--of", of)
        pc2, mdd = read_bytes(self.path("a.pc2")), read_bytes(self.path("a.mdd"))
        self.assertEqual(pc2[:12], b"POINTCACHE2\0")
        version, count, start, rate, samples = struct.unpack_from("<iiffi", pc2, 12)
        self.assertEqual((version, start, rate, samples), (1, 0, 1, FRAMES + 1))
        self.assertEqual(struct.unpack_from(">ii", mdd), (samples, count))
        times = struct.unpack_from(f">{samples}f", mdd, 8)
        for i, time in enumerate(times):
            self.assertAlmostEqual(time, i / 30, delta=1e-6)
        self.assertEqual(len(pc2), 32 + 12 * count * samples)
        self.assertEqual(len(mdd), 8 + 4 * samples + 12 * count * samples)
        numbers = 3 * count * samples
        return (struct.unpack_from(f"<{numbers}f", pc2, 32), struct.unpack_from(f">{numbers}f", mdd, 8 + 4 * samples), count)

    def test_both_formats_have_the_same_samples(self):
        for of in ("skin", "surface"):
            pc2, mdd, count = self.samples(of)
            self.assertGreater(count, 100)
            self.assertEqual(pc2, mdd)
            self.assertNotEqual(pc2[:3 * count], pc2[-3 * count:])

    def test_export_writes_the_same_and_reports_omissions(self):
        for ending in ("pc2", "mdd"):
            self.good("run", self.bundle, *HOW, "--cache", self.path("run." + ending))
            printed = self.good("export", self.bundle, *HOW, "-o", self.path("export." + ending)).err
            self.assertEqual(read_bytes(self.path("run." + ending)), read_bytes(self.path("export." + ending)))
            self.assertRegex(printed, r"bones: [1-9].*soft bodies: [1-9].*EXPORT_LEFT_OUT")
        skinless = os.path.join(ROOT, "spec", "samples", "valid", "minimal.sbf")
        self.assertEqual(self.json_of("info", skinless)["render_meshes"], [])
        refused = call("export", skinless, "-o", self.path("none.pc2"))
        self.assertEqual(refused.status, 1)
        self.assertIn("--of surface", refused.err)
        self.assertFalse(os.path.exists(self.path("none.pc2")))

    @play_files.needs_blender
    def test_blender_plays_both(self):
        numbers, _, count = self.samples("skin")
        frame = 20
        wanted = rows(numbers[3 * count * frame:3 * count * (frame + 1)], 3)
        for ending, mode in (("pc2", "FRAME"), ("mdd", "FRAME"), ("mdd", "TIME")):
            shown = play_files.blender("blender_cache.py", self.path("a." + ending), count, frame, mode)
            self.assertEqual(len(shown), count)
            self.assertLess(max(map(math.dist, shown, wanted)), 1e-5, (ending, mode))


if __name__ == "__main__":
    main()
