"""Tests kinds of gait in the program: a drive of three numbers, output of `run` and `info`, equal bits for any number of threads."""

from sbfmt_program import ProgramTest, main, write_bytes

BONES = 8


def character(kind, inside="", attributes=""):
    """A straight chain of 1 m along -Z, 0.1 m above the ground."""
    bones = "".join(f'<bone id="b{i}"' + (f' parent="b{i - 1}"' if i else "") +
                    f' head="0 0.1 {0.5 - i / BONES:g}" rotation="-0.70710677 0 0 0.70710677" length="{1 / BONES:g}"/>'
                    for i in range(BONES))
    return (f'<sbf version="1.2"><skeleton>{bones}</skeleton>'
            f'<gait id="g" body="b0" kind="{kind}" walk_speed="1" {attributes}>{inside}</gait></sbf>')


WAVE = f'<undulation wavelength="0.7"><bones>{" ".join(map(str, range(BONES)))}</bones></undulation>'
KINDS = {"swim": WAVE + '<medium altitude="0.5"/>', "fly": '<fin frequency="4"><bones>3</bones></fin><medium altitude="1" bob="0.05"/>',
         "slither": WAVE, "crawl": "", "roll": '<wheel bone="b2" radius="0.1"/>', "none": ""}


class KindsOfGait(ProgramTest):
    def file(self, kind):
        return write_bytes(self.path(kind + ".sbf"), character(kind, KINDS[kind]).encode())

    def run_of(self, kind, drive, *more):
        return self.json_of("run", self.file(kind), "--seconds", "6", "--drive", drive, *more)

    def test_each_kind_travels_the_driven_distance(self):
        for kind in KINDS:
            with self.subTest(kind):
                report = self.run_of(kind, "1,0.2")
                self.assertTrue(report["valid"])
                if kind == "none":
                    self.assertEqual(report["distance"], 0)
                else:
                    self.assertGreater(report["distance"], 0.8 * 6)
                    self.assertLess(report["distance"], 1.05 * 6)

    def test_swimmers_and_flyers_rise(self):
        def end_of(kind, drive):
            self.run_of(kind, drive, "--pose", self.path("pose.csv"))
            with open(self.path("pose.csv"), encoding="utf-8") as poses:
                return float(poses.read().split("\n")[-2].split(",")[4])
        for kind, rises in (("swim", 2.4), ("fly", 2.4), ("crawl", 0), ("roll", 0)):
            with self.subTest(kind):
                self.assertAlmostEqual(end_of(kind, "0.5,0,0.4") - end_of(kind, "0.5,0"), rises, delta=0.5)

    def test_info_prints_the_kind(self):
        for kind in KINDS:
            self.assertEqual(self.json_of("info", self.file(kind))["gait"], {"kind": kind, "legs": 0})

    def test_threads_and_packing_change_no_bit(self):
        for kind in KINDS:
            with self.subTest(kind):
                self.good("pack", self.file(kind), "-o", self.path("packed.sbfz"))
                hashes = {self.run_of(kind, "0.8,0.3,0.1", "--threads", str(n))["state_hash"] for n in (1, 3)}
                packed = self.json_of("run", self.path("packed.sbfz"), "--seconds", "6", "--drive", "0.8,0.3,0.1")
                self.assertEqual(hashes, {packed["state_hash"]})

    def test_a_script_drives_upwards_too(self):
        script = write_bytes(self.path("up.txt"), b"0 drive 0.8 0.3 0 0.1\n")
        self.assertEqual(self.json_of("run", self.file("swim"), "--seconds", "6", "--script", script)["state_hash"],
                         self.run_of("swim", "0.8,0.3,0.1")["state_hash"])

    def test_a_recording_keeps_the_vertical_speed(self):
        self.json_of("run", self.file("fly"), "--seconds", "2", "--drive", "0.8,0.3,0.4", "--record", self.path("fly.sbrec"))
        self.assertTrue(self.json_of("run", self.file("fly"), "--replay", self.path("fly.sbrec"))["replay_same"])

    def test_wrong_drives_are_refused(self):
        for drive in ("1,0,nan", "1,0,inf", "1,0,2,3", "1", "1,0,"):
            self.assertIn("UP", self.fails(2, "run", self.file("swim"), "--drive", drive))


if __name__ == "__main__":
    main()
