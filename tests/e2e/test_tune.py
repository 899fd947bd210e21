"""Tests `sbfmt tune`: written settings match the measurements and reach the goal, the result is repeatable, and no partial file is
written."""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from sbfmt_program import PROGRAM, ROOT, ProgramTest, call, main, read_bytes, read_text

EXAMPLES = os.path.join(ROOT, "examples")
GRID = ("--reference", "400", "--elements", "24", "--elements", "100")
SMALL = (*GRID, "--runs", "2")
NEAREST_OF_ALL = ("--error", "0")


class Tuned(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.place = cls.class_folder.name
        cls.file = os.path.join(cls.place, "pudding.sbfz")
        result = call("convert", os.path.join(EXAMPLES, "pudding", "pudding.glb"), "-o", cls.file)
        assert result.status == 0, result.err
        cls.all = cls.tune(cls, "all.sbf", *NEAREST_OF_ALL)

    def tune(self, name, *options, status=0, sweep=SMALL):
        result = call("tune", self.file, "-o", os.path.join(self.place, name), "--format", "json", *sweep, *options)
        assert result.status == status, result.err
        return json.loads(result.out)

    def levels_of(self, name):
        result = call("info", os.path.join(self.place, name), "--format", "json")
        self.assertEqual(result.status, 0, result.err)
        return [section["levels"] for section in json.loads(result.out)["sections"]]

    def test_every_kind_of_candidate_is_tried_and_the_front_is_kept(self):
        trials = self.all["trials"]
        self.assertEqual({trial["model"] for trial in trials},
                         {"as built", "as built, fitted"} | {f"tetrahedra {size}{kind}" for size in (24, 100) for kind in ("", " calibrated")})
        self.assertIn("position_based", {trial["scheme"] for trial in trials})
        sound = [trial for trial in trials if trial["outcome"] == "sound"]
        front = [trial for trial in sound if trial["on_front"]]
        self.assertTrue(front)
        broken = [trial for trial in sound if trial["verified"] and not trial["verified"]["sound"]]
        for trial in broken:
            self.assertFalse(trial["on_front"], trial)
        for trial in (trial for trial in sound if trial not in broken):
            worst = max(trial["error"]["most_m"], (trial["verified"] or trial["error"])["most_m"])
            better = [other for other in front if other["visits"] <= trial["visits"]
                      and max(other["error"]["most_m"], other["verified"]["most_m"]) <= 1.1 * worst]
            self.assertTrue(better, trial)
            self.assertEqual(trial["us_per_tick"] is not None, trial["on_front"])
            self.assertLessEqual(trial["error"]["rms_m"], trial["error"]["most_m"])
        self.assertEqual(self.all["verdict"], "met")
        self.assertEqual([motion["name"] for motion in self.all["reference"]["motions"]], ["walk", "hop", "shake"])
        self.assertGreater(self.all["reference"]["most_m"], 0)

    def test_the_file_has_the_measured_values(self):
        result = call("validate", os.path.join(self.place, "all.sbf"))
        self.assertEqual(result.status, 0, result.out + result.err)
        printed = self.all["levels"]
        for levels in self.levels_of("all.sbf"):
            self.assertEqual(len(levels), len(printed))
            for level, of in zip(levels, printed):
                self.assertAlmostEqual(level["motion_error"], of["motion_error_m"], delta=1e-6 * of["motion_error_m"])
                self.assertAlmostEqual(level["motion_error_rms"], of["motion_error_rms_m"], delta=1e-6)
        for of in printed:
            worst = max(of["error"]["most_m"], of["verified"]["most_m"])
            self.assertGreaterEqual(of["motion_error_m"], 1.25 * worst)
        text = read_text(os.path.join(self.place, "all.sbf"))
        for words in ('id="tune"', "measure=most", "<measured ", 'motion_error="'):
            self.assertIn(words, text)
        costs = [sum(levels[i]["cost"] for levels in self.levels_of("all.sbf")) for i in range(len(printed))]
        for cost, of in zip(costs, printed):
            self.assertAlmostEqual(cost, of["element_visits"], delta=1e-5 * cost)

    def test_the_first_level_runs_as_it_was_chosen(self):
        chosen = self.all["levels"][0]
        result = call("run", os.path.join(self.place, "all.sbf"), "--seconds", "0.5", "--format", "json")
        self.assertEqual(result.status, 0, result.err)
        report = json.loads(result.out)
        self.assertTrue(report["valid"])
        if chosen["substeps"]:
            self.assertEqual(report["substeps"], chosen["substeps"])

    def test_no_level_is_one_that_run_calls_biased(self):
        for number in range(len(self.all["levels"])):
            printed = self.good("run", os.path.join(self.place, "all.sbf"), "--seconds", "0.1", "--level", number).err
            self.assertNotIn("SCHEME_BIASED", printed)
        refused = [trial for trial in self.all["trials"] if trial["outcome"] == "refused"]
        self.assertTrue(any("is stepped by" in trial["error"]["why"] for trial in refused), refused[:3])

    def test_a_goal_selects_the_cheapest_candidate_within_it(self):
        front = sorted((trial for trial in self.all["trials"] if trial["on_front"]), key=lambda trial: trial["visits"])
        self.assertGreater(len(front), 1)
        goal = self.all["levels"][-1]["motion_error_m"] * 1.0001
        report = self.tune("near.sbfz", "--error", repr(goal))
        self.assertEqual(len(report["levels"]), 1)
        for key in ("model", "scheme", "substeps", "visits", "element_visits", "error"):
            self.assertEqual(report["levels"][0][key], front[0][key])

    def test_visits_and_errors_are_the_same_each_time(self):
        again = self.tune("again.sbf", *NEAREST_OF_ALL)
        for one, other in zip(self.all["trials"], again["trials"]):
            for key in ("model", "scheme", "substeps", "visits", "element_visits", "error", "outcome", "on_front"):
                self.assertEqual(one[key], other[key])
        same = call("diff", os.path.join(self.place, "all.sbf"), os.path.join(self.place, "again.sbf"))
        self.assertEqual(same.status, 0, same.out)  # times are left out of it

    def test_tuned_files_can_be_tuned_and_built_again(self):
        first = os.path.join(self.place, "all.sbf")
        second, built = os.path.join(self.place, "second.sbf"), os.path.join(self.place, "built.sbf")
        result = call("tune", first, "-o", second, *SMALL[:4], "--quick", *NEAREST_OF_ALL)
        self.assertEqual(result.status, 0, result.err)
        self.assertEqual(read_text(second).count('id="tune"'), 1)
        for arguments in (("validate", second), ("build", second, "-o", built), ("validate", built)):
            result = call(*arguments)
            self.assertEqual(result.status, 0, result.out + result.err)
        self.assertNotIn('id="tune"', read_text(built))

    def test_impossible_goals_name_the_closest_and_write_nothing(self):
        for options, words in ((("--error", "1e-8"), "the most accurate has"), (("--budget", "0.01"), "the cheapest takes")):
            out = os.path.join(self.place, "nothing.sbfz")
            result = call("tune", self.file, "-o", out, *SMALL, "--quick", *options)
            self.assertEqual(result.status, 1, result.out)
            self.assertIn(words, result.err)
            self.assertFalse(os.path.exists(out))
        report = self.tune("nothing.sbfz", "--error", "1e-8", "--quick", status=1)
        self.assertFalse(report["written"])
        self.assertEqual(report["verdict"], "error too small")
        self.assertTrue(report["nearest"]["on_front"])
        self.assertFalse([name for name in os.listdir(self.place) if name.startswith("nothing")])

    def test_an_error_may_be_a_percentage_of_the_size(self):
        bounds = self.json_of("info", self.file)["bounds"]
        size = max(high - low for low, high in zip(bounds["min"], bounds["max"]))
        near = self.tune("share.sbfz", "--error", "8%", "--measure", "most")
        self.assertAlmostEqual(near["size_m"], size, delta=1e-6 * size)
        self.assertAlmostEqual(near["error_asked_m"], 0.08 * size, delta=1e-6 * size)
        self.assertLessEqual(near["levels"][0]["motion_error_m"], near["error_asked_m"])
        for text in ("8 %", "101%", "%", "-1%"):
            self.assertIn("metres or a percentage", self.fails(2, "tune", self.file, "-o", self.path("x.sbfz"), "--error", text))

    def test_the_default_goal_is_one_percent_of_the_visible_size(self):
        result = call("tune", self.file, "-o", self.path("usual.sbf"), *GRID, "--format", "json", "--nearest")
        self.assertEqual(result.status, 0, result.err)
        report = json.loads(result.out)
        self.assertEqual((report["error_asked_percent"], report["measure"]), (1, "p99"))
        self.assertEqual(self.all["measure"], "most")
        self.assertIn("measure=p99", read_text(self.path("usual.sbf")))
        for trial in report["trials"]:
            if trial["error"] and trial["error"].get("sound"):
                self.assertLessEqual(trial["error"]["rms_m"], trial["error"]["p99_m"])
                self.assertLessEqual(trial["error"]["p99_m"], trial["error"]["most_m"])
        kept = report["levels"][0]["motion_error_p99_m"] <= report["error_asked_m"]
        self.assertEqual(kept, report["verdict"] == "met")

    def test_candidates_costlier_than_a_sufficient_one_are_not_tried(self):
        report = self.tune("first.sbfz", "--error", repr(self.all["levels"][-1]["motion_error_m"] * 1.0001))
        dearer = [trial for trial in report["trials"] if trial["outcome"] == "dearer"]
        self.assertTrue(dearer)
        for trial in dearer:
            self.assertGreaterEqual(trial["visits"], report["levels"][0]["visits"])
            self.assertIsNone(trial["error"])

    def test_the_nearest_is_written_on_request(self):
        for options, verdict in ((("--error", "1e-8"), "error too small"), (("--budget", "0.01"), "budget too small"),
                                 (("--error", "1e-8", "--budget", "0.01"), "error too small")):
            out = self.path("nearest.sbfz")
            result = call("tune", self.file, "-o", out, *SMALL, "--quick", "--nearest", "--format", "json", *options)
            self.assertEqual(result.status, 0, result.err)
            self.assertIn("warning: nothing that was tried", result.err)
            report = json.loads(result.out)
            self.assertEqual((report["verdict"], report["written"]), (verdict, True))
            self.assertEqual(report["levels"][0]["error"], report["nearest"]["error"])
            self.good("validate", out)
            os.remove(out)

    def test_an_unreachable_goal_gives_the_nearest_candidate(self):
        soft = self.path("soft.sbfz")
        self.good("convert", os.path.join(EXAMPLES, "pudding", "pudding.glb"), "--firmness", "0.1", "-o", soft)
        report = self.json_of("tune", soft, "-o", self.path("far.sbfz"), *SMALL, "--quick", "--nearest")
        self.assertEqual(report["verdict"], "error too small")
        self.assertGreater(report["levels"][0]["motion_error_m"], 0.05 * report["size_m"])
        self.good("validate", self.path("far.sbfz"))

    def test_the_files_finest_level_is_the_reference_if_every_lattice_fails(self):
        soft = self.path("softer.sbfz")
        self.good("convert", os.path.join(EXAMPLES, "pudding", "pudding.glb"), "--firmness", "0.007", "-o", soft)
        report = self.json_of("tune", soft, "-o", self.path("own.sbfz"), *SMALL, "--quick", "--nearest")
        self.assertEqual(report["reference"]["model"], "as built")
        self.assertTrue(report["written"])

    def test_files_without_soft_bodies_are_written_unchanged(self):
        rigid, out = self.path("rigid.sbfz"), self.path("out.sbfz")
        self.good("convert", os.path.join(EXAMPLES, "spider", "spider.glb"), "--rigid", "*", "-o", rigid)
        self.assertIn("nothing is soft", self.good("tune", rigid, "-o", out).out)
        self.good("diff", rigid, out)
        self.assertEqual(self.json_of("tune", rigid, "-o", out)["verdict"], "met")

    def test_candidates_worse_than_the_best_are_stopped_early(self):
        visits = [trial["visits"] for trial in self.all["trials"]]  # without the refused ones, which come last
        tried = [trial["visits"] for trial in self.all["trials"] if trial["outcome"] != "refused"]
        self.assertEqual(visits, sorted(tried) + [None] * (len(visits) - len(tried)))
        beaten = [trial for trial in self.all["trials"] if trial["outcome"] == "beaten"]
        self.assertTrue(beaten)
        for trial in beaten:
            better = [other for other in self.all["trials"] if other["outcome"] == "sound" and other["visits"] <= trial["visits"]
                      and other["error"]["most_m"] <= trial["error"]["most_m"]]
            self.assertTrue(better, trial)
            self.assertFalse(trial["on_front"])

    def test_it_prints_the_time_it_takes(self):
        result = call("tune", self.file, "-o", os.path.join(self.place, "timed.sbfz"), *SMALL, "--quick", *NEAREST_OF_ALL)
        self.assertEqual(result.status, 0, result.err)
        self.assertRegex(result.err, r"info: 3 ways to step 3 meshes, against \d+ elements: (\d+ to )?\d+ (seconds?|minutes) on")

    def test_a_missing_folder_is_reported_before_the_work(self):
        out = os.path.join(self.place, "none", "out.sbfz")
        result = call("tune", self.file, "-o", out)
        self.assertEqual(result.status, 2)
        self.assertIn("there is no folder", result.err)
        self.assertNotIn("info:", result.err)

    @unittest.skipUnless(shutil.which("parallel"), "GNU parallel is not installed (Debian: parallel)")
    def test_the_documented_line_tunes_many_in_parallel(self):
        text = read_text(os.path.join(ROOT, "docs", "speed-and-accuracy.md"))
        line = re.search(r"^mkdir -p tuned && ls .*$", text, re.M).group(0).split(" # ")[0].replace("sbfmt tune {}", " ".join(
            [PROGRAM, "tune {}", *SMALL, "--quick"])).replace("--error 0.005", "--error 0.05")
        with tempfile.TemporaryDirectory(dir=self.place) as folder:
            for name in ("one.sbfz", "the second.sbfz"):
                shutil.copy(self.file, os.path.join(folder, name))
            ran = subprocess.run(["sh", "-c", line], cwd=folder, capture_output=True, text=True, check=False)
            self.assertEqual(ran.returncode, 0, ran.stderr)
            names = sorted(os.listdir(os.path.join(folder, "tuned")))
            self.assertEqual(names, ["one.sbfz", "the second.sbfz"])
            same = call("diff", *[os.path.join(folder, "tuned", name) for name in names])
            self.assertEqual(same.status, 0, same.out)
            self.assertEqual(sorted(os.listdir(folder)), ["one.sbfz", "the second.sbfz", "tuned"])

    def test_bad_calls_and_files_are_reported(self):
        out = os.path.join(self.place, "bad.sbfz")
        for arguments in ((self.file,), (self.file, "-o", out, "--error", "-1"), (self.file, "-o", out, "--elements", "x"),
                          (self.file, "-o", out, "--measure", "mean"), (os.path.join(self.place, "none.sbf"), "-o", out)):
            result = call("tune", *arguments)
            self.assertEqual(result.status, 2, result.err)
            self.assertIn("error:", result.err)
        broken = os.path.join(self.place, "broken.sbfz")
        with open(broken, "wb") as stream:
            stream.write(read_bytes(self.file)[:500])
        self.assertEqual(call("tune", broken, "-o", out).status, 1)
        authored = os.path.join(self.place, "authored.sbf")
        self.assertEqual(call("unpack", self.file, "-o", authored).status, 0)
        text = re.sub(r' (hull_)?derived="[^"]*"', "", read_text(authored))
        with open(authored, "w", encoding="utf-8") as stream:
            stream.write(text)
        result = call("tune", authored, "-o", out)
        self.assertEqual(result.status, 1)
        self.assertIn("authored", result.err)
        self.assertFalse(os.path.exists(out))


if __name__ == "__main__":
    main()
