"""Tests `sbfmt chart` of solid bodies: schemes on bars and figures, and the error of calibrated coarse meshes. Slow."""

import csv
import os
import shutil
import tempfile

from sbfmt_program import ProgramTest, call, main, read_text


class Bodies(ProgramTest):
    def setUp(self):
        super().setUp()
        self.out = tempfile.mkdtemp(prefix="sbfmt-chart-")
        self.addCleanup(shutil.rmtree, self.out, ignore_errors=True)

    def rows(self, case):
        result = call("chart", "-o", self.out, "--case", case, "--no-svg", "--runs", "1", "--most-substeps", "32",
                      timeout=900)
        self.assertEqual(result.status, 0, result.err)
        return list(csv.DictReader(read_text(os.path.join(self.out, case + ".csv")).splitlines()))

    def test_a_coarse_calibrated_mesh_beats_a_finer_one_as_it_is(self):
        for case, axis in (("cantilever-meshes", "shape"), ("beam-meshes", "period")):
            rows = [row for row in self.rows(case) if row["scheme"] != "reference"]
            self.assertEqual({row["outcome"] for row in rows}, {"sound"})
            calibrated = next(row for row in rows if row["scheme"] == "calibrated" and int(row["elements"]) > 100)
            finer = [row for row in rows
                     if row["scheme"] == "uncalibrated" and int(row["elements"]) < 2000 and row[axis]]
            self.assertGreaterEqual(len(finer), 4)  # one that is too stiff does not swing often enough for a period
            for row in finer:
                self.assertLess(float(calibrated[axis]), float(row[axis]), (case, row["elements"]))

    def test_schemes_on_a_bar_are_off_as_they_should(self):
        rows = self.rows("beam")
        for model in ("tetrahedra", "springs"):
            own = {row["scheme"]: row for row in rows if row["model"] == model and row["substeps"] == "32"}
            self.assertLess(float(own["symplectic"]["period"]), 1e-3)
            self.assertLess(float(own["symplectic"]["amplitude"]), float(own["position_based"]["amplitude"]))
            self.assertLess(float(own["position_based"]["amplitude"]), 0.5)
            automatic = next(row for row in rows if row["model"] == model and row["scheme"] == "automatic")
            self.assertEqual(automatic["outcome"], "sound")
            self.assertLess(float(automatic["period"]), 1e-3)
        self.assertIn("refused", {row["outcome"] for row in rows if row["model"] == "regions"})

    def test_a_hanging_body_rests_where_all_stable_schemes_agree(self):
        for row in self.rows("hung"):
            if row["scheme"] in ("symplectic", "automatic") and row["outcome"] == "sound":
                self.assertLess(float(row["shape"]), 1e-3, (row["model"], row["substeps"]))


if __name__ == "__main__":
    main()
