"""Tests `sbfmt chart`: tables and drawings of known cases agree with closed forms; no partial files are written."""

import csv
import io
import json
import math
import os
import shutil
import tempfile
import unittest

from sbfmt_program import ProgramTest, call, main, read_text

QUICK = ("--runs", "2", "--most-substeps", "4")
CASES = ("spring", "chain", "pendulum", "cantilever", "beam", "drop", "pressure", "hung", "cantilever-meshes", "beam-meshes")
MAPS = ("damping", "hitch", "jitter", "stretch")  # of a mass on a spring
BODY_MAPS = ("mass-regions", "mass-springs", "mass-tetrahedra", "poisson")
SMALL = ("spring", "chain", "pendulum", "pressure", "drop")  # test_chart_bodies.py has the others


def rows_of(folder, case):
    return list(csv.DictReader(io.StringIO(read_text(os.path.join(folder, case + ".csv")))))


def pick(rows, scheme, substeps):
    return next(row for row in rows if row["scheme"] == scheme and row["substeps"] == str(substeps))


class Charts(ProgramTest):
    def setUp(self):
        super().setUp()
        self.place = tempfile.mkdtemp(prefix="sbfmt-chart-")
        self.addCleanup(shutil.rmtree, self.place, ignore_errors=True)
        self.out = os.path.join(self.place, "charts")

    def chart(self, *arguments):
        result = call("chart", "-o", self.out, *QUICK, *arguments)
        self.assertEqual(result.status, 0, result.err)
        return result

    def test_every_case_fills_its_tables(self):
        self.chart("--no-svg", *(word for case in SMALL for word in ("--case", case)))
        for case in SMALL:
            with self.subTest(case=case):
                rows = rows_of(self.out, case)
                reference = [row for row in rows if row["scheme"] == "reference"]
                measured = [row for row in rows if row["scheme"] != "reference"]
                self.assertTrue(reference)
                self.assertLessEqual({"symplectic", "position_based", "heun", "explicit_euler", "block_descent",
                                      "relaxation", "automatic"}, {row["scheme"] for row in measured})
                for row in measured:
                    self.assertTrue(row["compiler"] and row["lanes"] and row["processor"] and row["date"])
                    self.assertIn(row["outcome"], ("sound", "failed", "refused"))
                    if row["outcome"] != "refused":
                        self.assertGreater(float(row["us_per_frame"]), 0)
                        self.assertLessEqual(float(row["us_least"]), float(row["us_most"]))
                    if row["outcome"] == "failed":
                        self.assertTrue(row["why"])
                self.assertTrue(any(row["front_of"] for row in measured))
                runs = rows_of(self.out, case + "-runs")
                self.assertEqual(len(runs), 2 * sum(row["outcome"] != "refused" for row in measured))
        self.assertFalse([name for name in os.listdir(self.out) if name.endswith(".svg")])
        self.assertEqual(os.listdir(self.place), ["charts"])

    def test_errors_are_those_of_closed_forms(self):
        self.chart("--no-svg", "--case", "spring")
        rows = rows_of(self.out, "spring")
        for substeps in (1, 2, 4):
            turn = 5 / 60 / substeps  # w h
            for scheme, fraction in (("symplectic", turn ** 2 / 24), ("position_based", turn ** 2 / 3),
                                  ("explicit_euler", turn ** 2 / 3), ("heun", turn ** 2 / 6)):
                off = float(pick(rows, scheme, substeps)["period"])
                self.assertAlmostEqual(off, fraction, delta=0.03 * fraction + 3e-6, msg=f"{scheme}, {substeps}")
            # What position-based steps lose of their height in three periods: the ratio is w h / 2.
            kept = math.exp(-turn / 2 * 2 * math.pi * 3.4)
            off = float(pick(rows, "position_based", substeps)["amplitude"])
            self.assertAlmostEqual(1 - off, kept, delta=0.1, msg=f"position_based, {substeps}")
        self.assertGreater(float(pick(rows, "explicit_euler", 1)["energy"]), 1)
        self.assertLess(float(pick(rows, "symplectic", 1)["energy"]), 0.05)

    def test_the_report_agrees_with_the_table(self):
        report = json.loads(self.chart("--no-svg", "--case", "pendulum", "--case", "pendulum", "--format", "json").out)
        self.assertEqual([case["name"] for case in report["cases"]], ["pendulum"])
        rows = [row for row in rows_of(self.out, "pendulum") if row["scheme"] != "reference"]
        self.assertEqual(len(report["cases"][0]["rows"]), len(rows))
        for reported_row, row in zip(report["cases"][0]["rows"], rows):
            self.assertEqual(reported_row["scheme"], row["scheme"])
            self.assertAlmostEqual(reported_row["errors"]["path_m"], float(row["path_m"]), delta=1e-5 * float(row["path_m"]))
        self.assertLess(report["cases"][0]["references"][0]["errors"]["path_m"], 1e-7)

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_drawings_contain_every_line(self):
        self.chart("--case", "pendulum")
        for axis in ("path_m", "farthest_m", "period", "amplitude", "energy"):
            drawing = read_text(os.path.join(self.out, f"pendulum-{axis}.svg"))
            self.assertTrue(drawing.rstrip().endswith("</svg>"))
            for words in ("symplectic", "position_based", "heun by tolerance", "Pareto front", "0.1 ms", "4 ms", "failed", "one run"):
                self.assertIn(words, drawing, axis)

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_the_key_has_every_scheme_once(self):
        self.chart("--case", "pressure")  # where most fail, and some have no point at all
        schemes = {row["scheme"] for row in rows_of(self.out, "pressure") if row["scheme"] != "reference"}
        for axis in ("path_m", "volume"):
            drawing = read_text(os.path.join(self.out, f"pressure-{axis}.svg"))
            for scheme in schemes | {"heun by tolerance"}:
                self.assertEqual(drawing.count(f"<text>{scheme}</text>"), 1, (axis, scheme))

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_a_table_is_drawn_again_as_it_was(self):
        self.chart("--case", "pendulum", "--case", "pressure")
        again = os.path.join(self.place, "again")
        result = call("chart", "-o", again, *(word for case in ("pendulum", "pressure")
                                              for word in ("--redraw", os.path.join(self.out, case + ".csv"))))
        self.assertEqual(result.status, 0, result.err)
        drawings = sorted(name for name in os.listdir(self.out) if name.endswith(".svg"))
        self.assertEqual(sorted(os.listdir(again)), drawings)
        for name in drawings:
            self.assertEqual(read_text(os.path.join(again, name)), read_text(os.path.join(self.out, name)), name)

    def test_invalid_tables_are_not_drawn(self):
        self.chart("--no-svg", "--case", "spring")
        table, runs = (read_text(os.path.join(self.out, name)) for name in ("spring.csv", "spring-runs.csv"))
        again = os.path.join(self.place, "again")
        for whole, times, words in (("", runs, "it is empty"), (table.replace("outcome", "income", 1), runs, "column outcome is missing"),
                                    (table, runs.rsplit("\n", 3)[0] + "\n", "runs are missing"),
                                    (table, runs.replace("spring,", "beam,"), "not of the row"),
                                    (table.replace(",sound,", ",fine,", 1), runs, "none of sound"),
                                    (table.replace("spring,", "sprung,"), runs.replace("spring,", "sprung,"), "case sprung"),
                                    (table.replace(",sound,", ",", 1), runs, "not as many fields"), (table, None, "is it there")):
            with self.subTest(words=words):
                for name, text in (("bad.csv", whole), ("bad-runs.csv", times)):
                    path = os.path.join(self.place, name)
                    if text is None:
                        os.remove(path)
                        continue
                    with open(path, "w", encoding="utf-8") as stream:
                        stream.write(text)
                result = call("chart", "--redraw", os.path.join(self.place, "bad.csv"), "-o", again)
                self.assertEqual(result.status, 2 if times is None else 1, result.err)
                self.assertIn(words, result.err)
                self.assertFalse(os.path.exists(again))

    def test_visits_are_counted_where_a_scheme_chooses_its_steps(self):
        self.chart("--no-svg", "--case", "chain")
        rows = [row for row in rows_of(self.out, "chain") if row["scheme"] != "reference"]
        springs = int(rows[0]["elements"])
        for substeps in (1, 2, 4):
            for scheme, visits in (("symplectic", substeps), ("position_based", substeps), ("explicit_euler", substeps),
                                   ("heun", 1 + 2 * substeps)):
                self.assertEqual(float(pick(rows, scheme, substeps)["visits_per_frame"]), visits * springs, (scheme, substeps))
        chosen = sorted((row for row in rows if row["step_error_m"]), key=lambda row: -float(row["step_error_m"]))
        self.assertEqual(float(pick(rows, "relaxation", 1)["visits_per_frame"]), 2 * springs)  # all of them structural
        visits = [float(row["visits_per_frame"]) for row in chosen]
        self.assertEqual(len(visits), 5)
        self.assertEqual(visits, sorted(visits))
        self.assertGreater(visits[-1], 3 * visits[0])

    def test_without_gnuplot_tables_are_kept(self):
        result = call("chart", "-o", self.out, "--case", "spring", *QUICK, environment={"PATH": self.place})
        self.assertEqual(result.status, 2)
        self.assertIn("gnuplot-nox", result.err)
        self.assertEqual(sorted(os.listdir(self.out)), ["spring-runs.csv", "spring.csv"])

    def test_older_files_are_kept_beside_new_ones(self):
        os.mkdir(self.out)
        with open(os.path.join(self.out, "mine.txt"), "w", encoding="utf-8") as stream:
            stream.write("mine")
        self.chart("--no-svg", "--case", "spring")
        self.chart("--no-svg", "--case", "chain")
        self.assertEqual(sorted(os.listdir(self.out)),
                         ["chain-runs.csv", "chain.csv", "mine.txt", "spring-runs.csv", "spring.csv"])

    def test_jobs_are_one_a_line(self):
        result = call("chart", "--jobs", "-o", self.out, "--no-svg", *QUICK)
        self.assertEqual(result.status, 0, result.err)
        lines = result.out.splitlines()
        self.assertEqual(len(lines), len(CASES))
        for case, line in zip(CASES, lines):
            self.assertTrue(line.startswith(f"sbfmt chart --case {case} "), line)
            self.assertIn(self.out, line)
        self.assertFalse(os.path.exists(self.out))

    def test_a_character_of_a_file_is_charted_by_its_skin(self):
        source, authored, built = (os.path.join(self.place, name) for name in ("box.obj", "authored.sbf", "box.sbf"))
        with open(source, "w", encoding="utf-8") as stream:
            for corner in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)):
                stream.write("v {} {} {}\n".format(*(0.2 * x for x in corner)))
            stream.write("f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
        for arguments in (("convert", source, "-o", authored, "--no-build"),
                          ("build", authored, "--elements", "60", "-o", built)):
            result = call(*arguments)
            self.assertEqual(result.status, 0, result.err)
        self.assertEqual(call("chart", authored, "-o", self.out).status, 1)
        self.chart(built, "--case", "hop", "--no-svg", "--distance", "2")
        rows = rows_of(self.out, "hop")
        self.assertEqual({row["case"] for row in rows}, {"hop"})
        sound = [row for row in rows if row["outcome"] == "sound" and row["scheme"] != "reference"]
        self.assertTrue(sound)
        pixels = 1080 / (2 * 2 * math.tan(math.radians(30)))
        for row in sound:
            path = float(row["path_m"])
            self.assertAlmostEqual(float(row["path_px"]), pixels * path, delta=1e-4 * pixels * path + 1e-12)
            self.assertLessEqual(path, float(row["farthest_m"]))
        lines = call("chart", built, "--jobs", "-o", self.out).out.splitlines()
        self.assertEqual(len(lines), 3)
        result = call("chart", built, "--case", "spring", "-o", self.out)
        self.assertEqual(result.status, 2)
        self.assertIn("walk, hop, shake", result.err)
        self.assertEqual(call("chart", os.path.join(self.place, "none.sbf"), "-o", self.out).status, 2)

    def test_stability_maps_agree_with_closed_forms(self):
        result = call("chart", "--map", "--cells", "12", "--no-svg", "--format", "json", "-o", self.out)
        self.assertEqual(result.status, 0, result.err)
        self.assertEqual(sorted(os.listdir(self.out)), sorted(f"map-{name}.csv" for name in MAPS + BODY_MAPS))
        reported_row = {(one["map"], one["scheme"]): one for one in json.loads(result.out)["maps"]}
        for name in MAPS + BODY_MAPS:
            rows = rows_of(self.out, f"map-{name}")
            self.assertEqual(len(rows), 6 * 12 * 6 if name in MAPS else 6 * 6 * 3)
            self.assertEqual(len({row["scheme"] for row in rows}), 6)
            for scheme in {row["scheme"] for row in rows}:
                for outcome in ("sound", "biased", "dead", "refused"):
                    count = sum(row["scheme"] == scheme and row["outcome"] == outcome for row in rows)
                    self.assertEqual(reported_row[name, scheme][outcome], count)
            for row in rows:
                self.assertEqual(bool(row["why"]), row["outcome"] != "sound")
                self.assertEqual(bool(row["mass_ratio"]), name in BODY_MAPS)
                if name == "stretch" or not row["stable_below"] or row["outcome"] == "refused":
                    continue
                fraction = float(row["omega_h"]) / float(row["stable_below"])
                if fraction < 0.8:
                    self.assertIn(row["outcome"], ("sound", "biased"), row)
                if fraction > 1.3 and (name in MAPS or row["scheme"] != "explicit_euler"):
                    self.assertEqual(row["outcome"], "dead", row)
        reported_row = {row["scheme"]: row["outcome"] for row in rows_of(self.out, "map-mass-regions")}
        self.assertEqual({scheme for scheme, outcome in reported_row.items() if outcome == "refused"},
                         {"position_based", "block_descent", "relaxation"})

    def test_maps_are_jobs_as_well(self):
        lines = call("chart", "--map", "--jobs", "--cells", "12", "-o", self.out).out.splitlines()
        self.assertEqual(len(lines), len(MAPS + BODY_MAPS))
        self.assertEqual(lines[0], f"sbfmt chart --map --case damping --cells 12 -o '{self.out}'")
        self.assertFalse(os.path.exists(self.out))

    @unittest.skipUnless(shutil.which("gnuplot"), "gnuplot is not installed")
    def test_stability_maps_are_drawn(self):
        names = ("damping", "mass-regions")
        result = call("chart", "--map", "--cells", "4", "-o", self.out, *(word for name in names for word in ("--case", name)))
        self.assertEqual(result.status, 0, result.err)
        self.assertEqual(sum(name.endswith(".svg") for name in os.listdir(self.out)), 2)
        for name in names:
            drawing = read_text(os.path.join(self.out, f"map-{name}.svg"))
            self.assertTrue(drawing.rstrip().endswith("</svg>"))
            for words in ("symplectic", "relaxation", "sound", "closed form"):
                self.assertIn(words, drawing, name)
            self.assertEqual("cannot step these" in drawing, name == "mass-regions")

    def test_wrong_calls_are_refused(self):
        file = os.path.join(self.place, "file")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write("x")
        for arguments, words in ((("--case", "spring"), "-o DIR"),
                                 (("--case", "swing", "-o", self.out), "spring, chain, pendulum"),
                                 (("--map",), "-o DIR"),
                                 (("--map", "--cells", "1", "-o", self.out), "--cells"),
                                 (("--map", "--case", "spring", "-o", self.out), "mass-springs"),
                                 (("--cells", "8", "-o", self.out), "--map"),
                                 (("--redraw", file), "-o DIR"),
                                 (("--redraw", file, "--case", "spring", "-o", self.out), "measures nothing"),
                                 (("--map", "--redraw", file, "-o", self.out), "--redraw"),
                                 (("--runs", "0", "-o", self.out), "--runs"),
                                 (("--most-substeps", "x", "-o", self.out), "--most-substeps"),
                                 (("--core", "1000", "-o", self.out, "--case", "spring"), "core"),
                                 (("--case", "spring", "-o", file), "name a folder"),
                                 (("--case", "spring", "-o", os.path.join(self.out, "deeper")), "no folder")):
            result = call("chart", *arguments, *([] if "--runs" in arguments else ["--runs", "1"]))
            self.assertEqual(result.status, 2, arguments)
            self.assertIn(words, result.err)
        self.assertEqual(os.listdir(self.place), ["file"])


if __name__ == "__main__":
    main()
