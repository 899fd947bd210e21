"""Tests the examples in the documents: programs compile, link and run, commands and drive scripts work, and quoted parts
of a file are in the file."""

import os
import re
import shlex
import subprocess
import sys
import unittest

from motion_files import read_poses
from sbfmt_program import (PROGRAM, ROOT, ProgramTest, call, example, main, read_bytes, read_text,
                           write_bytes)

DOCUMENTS = [os.path.join(ROOT, "docs", name) for name in ("hello.md", "format-tour.md", "scripts.md", "partial-loading.md",
                                                             "converting.md", "validate.md", "materials.md", "levels.md")]
README = os.path.join(ROOT, "README.md")
TOURED = os.path.join(ROOT, "spec", "samples", "valid", "jelly.sbf")
BUILD = os.environ.get("SBFMT_BUILD_DIR", "")
LIBRARIES = [os.path.join(BUILD, *path) for path in (("runtime", "libsbrun.a"), ("libsbfmt", "libsbfmt-mechanics.a"),
                                                     ("libsbfmt", "libsbfmt-core.a"))]
INCLUDES = ["-I" + os.path.join(ROOT, *path) for path in (("libsbfmt", "include"), ("runtime", "include"))]


def blocks(path, language):
    """The fenced blocks of a document in a language, with the line where each begins."""
    return [(read_text(path)[:found.start()].count("\n") + 1, found[1])
            for found in re.finditer(rf"^```{re.escape(language)}\n(.*?)^```$", read_text(path), re.M | re.S)]


class Documents(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.lizard = example(cls.class_folder.name)

    def setUp(self):
        super().setUp()
        for name in ("examples", "spec"):
            os.symlink(os.path.join(ROOT, name), self.path(name))
        write_bytes(self.path("lizard.sbf"), read_bytes(self.lizard))

    def run_commands(self, document):
        count = 0
        for line, text in blocks(document, "sh"):
            for command in text.splitlines():
                words = shlex.split(command, comments=True)
                # Drawing needs a driver (test_render_files.py) or a window that waits (test_view.py), ./run is tested by
                # tests/repo/test_run.py.
                if words[0] != "sbfmt" or words[1] in ("render", "view"):
                    self.assertIn(words[0], ("sbfmt", "./run"), f"{document}:{line}")
                    continue
                done = subprocess.run([PROGRAM, *words[1:]], cwd=self.folder, capture_output=True, text=True,
                                      check=False)
                self.assertEqual(done.returncode, 0, f"{document}:{line}: {command}\n{done.stderr}")
                count += 1
        self.assertTrue(count, document)

    def test_commands_work(self):
        for document in DOCUMENTS:
            scripts = blocks(document, "script")
            if scripts:
                write_bytes(self.path("out-and-back.txt"), scripts[0][1].encode())
            self.run_commands(document)

    def test_commands_of_the_readme_work(self):
        self.run_commands(README)

    def test_pieces_of_the_tour_stand_in_the_file(self):
        toured = read_text(TOURED)
        pieces = blocks(DOCUMENTS[1], "xml")
        self.assertGreaterEqual(len(pieces), 10)
        positions = []
        for line, text in pieces:
            self.assertIn(text, toured, f"{DOCUMENTS[1]}:{line}")
            positions.append(toured.index(text))
        self.assertEqual(positions, sorted(positions), "the tour goes through the file from front to back")

    def test_python_in_the_tour_runs(self):
        call("pack", self.path("lizard.sbf"), "-o", self.path("lizard.sbfz"))
        programs = blocks(DOCUMENTS[1], "python")
        self.assertEqual(len(programs), 2)
        outputs = []
        for (_, text), file in zip(programs, ("lizard.sbf", "lizard.sbfz")):
            done = subprocess.run([sys.executable, "-c", text, self.path(file)], capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            outputs.append(done.stdout.splitlines())
        sections = self.json_of("info", self.lizard)["sections"]
        self.assertEqual(outputs[0], [f"{s['name']} on {s['bone']} {s['vertices']} points {s['polygons']} polygons"
                                      for s in sections])
        self.assertTrue(outputs[1][0].startswith("ROOT 0 "))
        self.assertEqual(sum(line.startswith("BODY") and " 0 0 " in line for line in outputs[1]), len(sections))

    def test_the_script_drives(self):
        (_, text), = blocks(DOCUMENTS[2], "script")
        script = write_bytes(self.path("s.txt"), text.encode())
        report = self.json_of("run", self.lizard, "--seconds", "12", "--script", script, "--pose", self.path("p.csv"))
        self.assertTrue(report["valid"])
        poses, _, _ = read_poses(self.path("p.csv"))
        root = self.json_of("info", self.lizard)["bones"][0]["name"]
        self.assertGreater(poses[180][root][2] - poses[0][root][2], 0.7)  # out
        self.assertAlmostEqual(poses[720][root][2], 2, delta=0.5)  # put down two metres ahead

    def output_of(self, text):
        """Of a C program, compiled against the libraries and run beside a stored lizard.sbfz."""
        source = write_bytes(self.path("program.c"), text.encode())
        compiler = [os.environ.get("SBFMT_CC", "cc"), "-std=c11", "-Wall", "-Wextra", "-Werror",
                    *os.environ.get("SBFMT_CFLAGS", "").split()]
        build = subprocess.run([*compiler, *INCLUDES, source, "-o", self.path("program"), *LIBRARIES, "-lz", "-lm"],
                               capture_output=True, text=True, check=False)
        self.assertEqual(build.returncode, 0, build.stderr)
        self.good("pack", self.lizard, "--store", "-o", self.path("lizard.sbfz"))
        run = subprocess.run([self.path("program")], cwd=self.folder, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    @unittest.skipUnless(all(map(os.path.exists, LIBRARIES)), "no static libraries in the build folder")
    def test_the_partial_load_reads_a_part(self):
        (_, text), = blocks(DOCUMENTS[3], "c")
        output = self.output_of(text)
        sections = {s["name"]: s for s in self.json_of("info", self.lizard)["sections"]}
        head = sections["Head"]["vertices"] + sections["Head"]["interior_points"]
        read_bytes = int(re.fullmatch(rf"Head: {head} points\nread (\d+) bytes\n", output).group(1))
        self.assertLess(read_bytes, os.path.getsize(self.path("lizard.sbfz")) / 4)

    @unittest.skipUnless(all(map(os.path.exists, LIBRARIES)), "no static libraries in the build folder")
    def test_the_first_program_compiles_and_walks(self):
        (_, text), = blocks(DOCUMENTS[0], "c")
        self.assertRegex(self.output_of(text), r"^walked 2\.[34]\d m\n$")
        part, = blocks(DOCUMENTS[0], "c part")
        whole = text.replace("  sbr_world_destroy(world);", part[1] + "\n  sbr_world_destroy(world);").replace(
            "int main(void)", "void draw(uint32_t, const sbf_vec3 *, const sbf_vec3 *, uint32_t, sbr_double3);\n"
                              "int main(void)")
        self.assertNotEqual(whole, text)
        self.compile(whole)

    def compile(self, text):
        check = subprocess.run([os.environ.get("SBFMT_CC", "cc"), "-std=c11", "-Wall", "-Wextra", "-Werror", *INCLUDES,
                                "-fsyntax-only", write_bytes(self.path("piece.c"), text.encode())],
                               capture_output=True, text=True, check=False)
        self.assertEqual(check.returncode, 0, check.stderr)

    def test_the_program_of_the_readme_compiles(self):
        programs = blocks(README, "c")
        self.assertTrue(programs)
        for _, text in programs:
            self.compile(text)


if __name__ == "__main__":
    main()
