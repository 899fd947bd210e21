"""`./run zoo`: the table and the pictures of characters that are converted and driven."""

import csv
import os
import shutil
import subprocess
import sys

from sbfmt_program import ROOT, ProgramTest, main

KOI, CALF = (os.path.join(ROOT, "examples", name, name + ".glb") for name in ("koi", "calf"))


class Zoo(ProgramTest):
    def zoo(self, *arguments):
        return subprocess.run([sys.executable, "-B", os.path.join(ROOT, "bench", "zoo.py"), "-o", self.path("out"), "--seconds", "2",
                               *arguments], capture_output=True, text=True, check=False)

    def rows(self):
        with open(self.path("out/zoo.csv"), encoding="utf-8", newline="") as file:
            return {row["file"]: row for row in csv.DictReader(file)}

    def folder_with(self, text):
        """A folder with the koi and a file of expected results."""
        os.makedirs(self.path("fish"), exist_ok=True)
        shutil.copy(KOI, self.path("fish"))
        with open(self.path("fish/truth.tsv"), "w", encoding="utf-8") as file:
            file.write("file\tkind\tlegs\n" + text)
        return self.path("fish")

    def test_a_table_of_all(self):
        made = self.zoo(CALF, self.folder_with("koi.glb\tswim\t0\n"))
        self.assertEqual(made.returncode, 0, made.stderr)
        rows = self.rows()
        self.assertEqual((rows["calf.glb"]["kind"], rows["calf.glb"]["legs"]), ("walk", "4"))
        self.assertEqual((rows["koi.glb"]["kind"], rows["koi.glb"]["true_kind"]), ("swim", "swim"))
        self.assertEqual(rows["koi.glb"]["uneven_max_strain"], "", "what swims meets no ground")
        for row in rows.values():
            self.assertEqual(row["valid"], "yes")
            self.assertGreater(float(row["volume_least"]), 0.9)
            self.assertGreater(float(row["distance_share"]), 0.7)
        self.assertIn("kind as stated               1 of 1", made.stdout)
        pictures = [name for _, _, names in os.walk(self.path("out")) for name in names if name.endswith(".png")]
        self.assertEqual("sheet.png" in pictures, shutil.which("ffmpeg") is not None)
        self.assertLessEqual({"calf.png", "koi.png"}, set(pictures))

    def test_a_wrong_kind_and_a_broken_file_fail(self):
        made = self.zoo(self.folder_with("koi.glb\twalk\t4\n"))
        self.assertEqual(made.returncode, 1)
        self.assertIn("not koi.glb", made.stdout)
        with open(self.path("fish/broken.glb"), "wb") as file:
            file.write(b"glTF")
        self.assertEqual(self.zoo(self.path("fish/broken.glb")).returncode, 1)
        self.assertEqual((self.rows()["broken.glb"]["valid"], self.rows()["broken.glb"]["note"]), ("no", "not converted"))

    def test_nothing_to_convert(self):
        os.makedirs(self.path("empty"))
        self.assertIn("no .glb file there", self.zoo(self.path("empty")).stderr)


if __name__ == "__main__":
    main()
