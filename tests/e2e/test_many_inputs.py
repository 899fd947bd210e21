"""Calls on several files: the exit status is the worst of all, in any order, and each good file is processed."""

import itertools
import os

from sbfmt_program import ROOT, ProgramTest, call, main, write_bytes

CUBE = """o cube
v 0 0 0
v 0.2 0 0
v 0.2 0.2 0
v 0 0.2 0
v 0 0 0.2
v 0.2 0 0.2
v 0.2 0.2 0.2
v 0 0.2 0.2
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


class ManyInputs(ProgramTest):
    def expect_worst(self, files, verb, *options):
        """`files` by name: the call on all returns the greatest status of the calls on each."""
        alone = {name: call(verb, path, *options).status for name, path in files.items()}
        self.assertEqual(alone, {"good": 0, "faulty": 1, "absent": 2})
        for count in (2, 3):
            for names in itertools.permutations(files, count):
                with self.subTest(names=names):
                    done = call(verb, *(files[name] for name in names), *options)
                    self.assertEqual(done.status, max(alone[name] for name in names), done.err)
                    yield names, done

    def test_validate(self):
        good = os.path.join(ROOT, "spec", "samples", "valid", "minimal.sbf")
        faulty = write_bytes(self.path("faulty.sbf"), b"<sbf version='1.0'><bone/></sbf>")
        files = {"good": good, "faulty": faulty, "absent": self.path("absent.sbf")}
        for names, done in self.expect_worst(files, "validate"):
            self.assertEqual("minimal.sbf: valid" in done.out, "good" in names)
            self.assertIn(f"{len(names)} files, {sum(name != 'good' for name in names)} not valid", done.out)
        for threads in ("1", "2"):
            self.assertEqual(call("validate", self.path("absent.sbf"), *[good] * 5, faulty, "--threads", threads).status, 2)
            report = self.json_of("validate", faulty, good, "--threads", threads, status=1)
            self.assertEqual((report["valid"], [one["valid"] for one in report["files"]]), (False, [False, True]))

    def test_one_output_needs_one_input(self):
        good = write_bytes(self.path("cube.obj"), CUBE.encode())
        other = write_bytes(self.path("other.obj"), CUBE.encode())
        printed = self.fails(2, "convert", good, other, "--no-build", "-o", self.path("out.sbf"))
        self.assertIn("--out-dir", printed)
        self.assert_empty_folder(but=["cube.obj", "other.obj"])

    def test_convert(self):
        good = write_bytes(self.path("cube.obj"), CUBE.encode())
        faulty = write_bytes(self.path("broken.obj"), b"v 0 0 0\nf 1 2 99\n")
        files = {"good": good, "faulty": faulty, "absent": self.path("absent.obj")}
        out = self.path("out")
        for names, _ in self.expect_worst(files, "convert", "--no-build", "--out-dir", out):
            made = [name for name in os.listdir(out) if name.endswith(".sbf")]
            self.assertEqual(made, ["cube.sbf"] if "good" in names else [])
            for name in made:
                os.remove(os.path.join(out, name))

    def test_options_apply_to_each_input(self):
        """Values and switches: each file is what a call for it alone writes, and so are the messages."""
        options = ("--unit", "0.5", "--material", "rubber", "--no-build", "--verbose")
        names = ("-a b", "ü")
        inputs = [write_bytes(self.path(name + ".obj"), CUBE.encode()) for name in names]
        batch = call("convert", *options, "--out-dir", self.path("out"), *inputs)
        for name, source in zip(names, inputs):
            alone = call("convert", source, "-o", self.path(name + ".sbf"), *options)
            self.assertEqual((alone.status, batch.status), (0, 0), batch.err)
            self.assertIn(alone.err, batch.err)
            self.assertIn(alone.out, batch.out)
            with open(self.path(name + ".sbf"), "rb") as one, open(self.path(f"out/{name}.sbf"), "rb") as other:
                self.assertEqual(one.read(), other.read())

    def test_unchanged_inputs_are_skipped(self):
        out = self.path("out")
        inputs = [write_bytes(self.path(name + ".obj"), CUBE.encode()) for name in ("a", "b", "c")]

        def unchanged(*options):
            done = call("convert", *inputs, "--no-build", "--out-dir", out, *options)
            self.assertEqual(done.status, 0, done.err)
            return int(done.out.split("3 files, ")[1].split(" unchanged")[0])

        self.assertEqual(unchanged(), 0)
        rows = open(os.path.join(out, "summary.tsv")).read().splitlines()
        self.assertEqual([row.split("\t")[:3] for row in rows[1:]],
                         [[name + ".obj", "converted", "none"] for name in ("a", "b", "c")])
        self.assertEqual(unchanged("--jobs", "3"), 3)
        self.assertEqual(unchanged("--unit", "2"), 0)  # other options
        self.assertEqual(unchanged("--unit", "2"), 3)
        write_bytes(inputs[1], CUBE.replace("0.2", "0.3").encode())
        self.assertEqual(unchanged("--unit", "2"), 2)
        write_bytes(self.path("c.mtl"), b"newmtl m\n")  # files beside it count
        self.assertEqual(unchanged("--unit", "2"), 2)
        os.remove(os.path.join(out, "a.sbf"))
        self.assertEqual(unchanged("--unit", "2"), 2)


if __name__ == "__main__":
    main()
