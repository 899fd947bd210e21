"""Tests that in `sbfmt run` bodies without pins always start above the ground, for any origin of the file."""

import os

from motion_files import PointCache
from sbfmt_program import ProgramTest, main, shared, write_bytes

CUBE = "".join(f"v {x} {y} {z}\n" for x in (-.5, .5) for y in (-.7, .3) for z in (-.5, .5)) + """\
f 1 2 4 3
f 5 7 8 6
f 1 5 6 2
f 3 4 8 7
f 1 3 7 5
f 2 6 8 4
"""


class Standing(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.source = write_bytes(cls.made("cube.obj"), CUBE.encode())

    def setUp(self):
        super().setUp()
        self.file = self.path("cube.sbf")
        self.good("convert", self.source, "--elements", "200", "-o", self.file)

    def first_places(self, *arguments, seconds="0"):
        out = self.path("places.pc2")
        report = self.json_of("run", self.file, "--seconds", seconds, "--cache", out, *arguments)
        cache = PointCache(out)
        return [cache.place(0, i) for i in range(cache.point_count)], report

    def test_its_lowest_point_begins_on_the_floor(self):
        positions, report = self.first_places(seconds="2")
        self.assertAlmostEqual(min(y for _, y, _ in positions), 0, delta=1e-5)
        self.assertTrue(report["valid"])
        self.assertGreater(report["volume_ratio"], 0.95)

    def test_raise_lifts_it_above_the_floor(self):
        positions, _ = self.first_places("--raise", "0.25")
        self.assertAlmostEqual(min(y for _, y, _ in positions), 0.25, delta=1e-5)

    def test_no_point_begins_below_a_slope(self):
        positions, report = self.first_places("--ground", "slope:20", seconds="1")
        slope = 0.3639702  # tan 20 degrees
        self.assertGreater(min(y - max(z, 0) * slope for _, y, z in positions), -1e-5)
        self.assertTrue(report["valid"])

    def test_characters_above_the_ground_are_not_moved(self):
        out = self.path("high.obj")
        write_bytes(out, "".join(
            f"v {' '.join(str(float(n) + 2) for n in line.split()[1:])}\n" if line.startswith("v") else line + "\n"
            for line in CUBE.splitlines()).encode())
        self.good("convert", out, "--elements", "200", "-o", self.file)
        positions, _ = self.first_places()
        self.assertAlmostEqual(min(y for _, y, _ in positions), 1.3, delta=1e-5)

    def test_real_bodies_stand(self):
        for name in ("spot/spot.obj", "bunny/bunny_902.obj"):
            if not os.path.exists(shared(name)):
                self.skipTest(f"../shared/data/{name} is not there")
            self.good("convert", shared(name), "--elements", "1500", "-o", self.file)
            report = self.json_of("run", self.file, "--seconds", "3")
            self.assertTrue(report["valid"], name)

    def test_wedges_thinner_than_their_elements_support_themselves(self):
        wedges = shared("multi/boxes156.obj")
        if not os.path.exists(wedges):
            self.skipTest("../shared/data/multi/boxes156.obj is not there")
        self.good("convert", wedges, "-o", self.file)
        report = self.json_of("run", self.file, "--seconds", "2")
        self.assertTrue(report["valid"])
        # The finest of them, refined until no vertex lies far outside of its element, are pressed flattest.
        self.assertGreater(report["volume_ratio_least"], 0.2)


if __name__ == "__main__":
    main()
