"""The second reader gives the same content as the C library, for every sample, every built example and what is
converted from the shared data, in XML, packed and stored; and it refuses what the C library refuses."""

import glob
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, os.pardir, "e2e"))
from sbfmt_program import ProgramTest, ROOT, call, example, main, read_bytes, shared, write_bytes  # noqa: E402

READER = os.path.join(ROOT, "spec", "reader", "sbf.py")
sys.path.insert(0, os.path.dirname(READER))
import sbf  # noqa: E402
DUMP = os.environ.get("SBFMT_DUMP_JSON", os.path.join(ROOT, "build", "release", "tests", "reader", "dump_json"))
SAMPLES = os.path.join(ROOT, "spec", "samples")
# Of the shared data one of each kind: sections with a rig, skinned, tetrahedra, an open surface, n-gons, clips.
CONVERTED = [("lizard/liz.obj", "--rig", "lizard/liz.fbx"), ("lizard/lizart.glb",), ("fox/fox.glb",),
             ("tets/ball.vtk",), ("cloth/cloth_25.obj",), ("bunny/bunny_902.obj",), ("ngon/concave_polygon.obj",),
             ("greenman/greenman.glb",), ("spot/spot.obj",)]


def read(command, path):
    done = subprocess.run([*command, path], stdin=subprocess.DEVNULL, capture_output=True, timeout=600, check=False)
    return done.returncode, done.stdout, done.stderr.decode("utf-8", "replace")


def second(path):
    """In this process: a program of its own for each of hundreds of files takes most of a minute."""
    with open(path, "rb") as stream:
        content = stream.read()
    try:
        return 0, sbf.object_text(sbf.load(content)).encode("utf-8") + b"\n", ""
    except sbf.Fault as fault:
        return 1, b"", f"sbf.py: {path}: {fault}\n"


def second_as_a_program(path):
    return read([sys.executable, "-B", READER], path)


def first(path):
    return read([DUMP], path)


def difference(a, b):
    """The neighbourhood of the first byte that differs, for a message."""
    at = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
    return f"\nlibrary: …{a[max(at - 80, 0):at + 40]}\nreader:  …{b[max(at - 80, 0):at + 40]}"


class Comparison(ProgramTest):
    def assert_same(self, path):
        ours, theirs = first(path), second(path)
        self.assertEqual((ours[0], theirs[0]), (0, 0), ours[2] + theirs[2])
        self.assertTrue(ours[1] == theirs[1], path + difference(ours[1], theirs[1]))

    def assert_same_in_all_forms(self, path):
        self.assert_same(path)
        for options in ((), ("--store",)):
            packed = self.path("a.sbfz")
            self.good("pack", path, "-o", packed, *options)
            self.assert_same(packed)


class Samples(Comparison):
    def test_valid_samples(self):
        samples = sorted(glob.glob(os.path.join(SAMPLES, "**", "*.sbf*"), recursive=True))
        samples = [path for path in samples if os.sep + "invalid" + os.sep not in path]
        self.assertGreaterEqual(len(samples), 3)
        for path in samples:
            with self.subTest(os.path.relpath(path, SAMPLES)):
                if first(path)[0] == 0:
                    self.assert_same_in_all_forms(path)
                else:
                    self.assertEqual(second(path)[0], 1)

    def test_the_program_prints_the_content_read_by_the_module(self):
        for name in ("valid/everything.sbf", "valid/jelly.sbf", "invalid/bone_before_parent.sbf"):
            path = os.path.join(SAMPLES, *name.split("/"))
            self.assertEqual(second_as_a_program(path), second(path), name)

    def test_the_built_example(self):
        self.assert_same_in_all_forms(example(self.class_folder.name))

    def test_invalid_samples_are_refused(self):
        """Refused by both; or, if only `validate` finds the error, read by both with equal content."""
        samples = sorted(glob.glob(os.path.join(SAMPLES, "invalid", "*.sbf*")))
        refused = 0
        for path in samples:
            with self.subTest(os.path.basename(path)):
                ours = first(path)
                if ours[0] == 0:
                    self.assert_same(path)
                    continue
                theirs = second(path)
                self.assertEqual((ours[0], theirs[0]), (1, 1), ours[2] + theirs[2])
                refused += 1
        self.assertGreaterEqual(refused, 40)

    def test_required_input_is_accepted(self):
        texts = {
            "space and signs": '<sbf  version="1.0"\n><environment\r\n wind=" +1 \t-.5\n2.e0 " control_tick="00.5"/></sbf>',
            "comments and CDATA": '<sbf version="1.0"><soft_body id="b"><interior>1<!-- c --> 2 <![CDATA[3]]> 4 5 6<?p?>7'
                                  '</interior></soft_body></sbf>',
            "any order": '<sbf version="1.0"><soft_body id="s"/><render_mesh id="m"/><soft_body id="t"/>'
                         '<asset title="&#9;&quot;\u00e9"/></sbf>',
            "other namespaces that say nothing": '<sbf version="1.0" xml:lang="en" '
                                                 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:x="y"/>',
            "numbers between two floats": '<sbf version="1.0"><environment wind="1.00000005960464477539062500000000001 '
                                          '1.000000059604644775390625 7.006492321624085354618e-46"/></sbf>',
            "a newer minor version": '<sbf version="1.7" new="x"><newer><deep a="b">text</deep></newer>'
                                     '<asset title="t" colour="red"/></sbf>',
            "a byte order mark": '\ufeff<sbf version="1.0"/>',
        }
        for name, text in texts.items():
            with self.subTest(name):
                self.assert_same(write_bytes(self.path("taken.sbf"), text.encode("utf-8")))

    def test_packed_files_with_a_changed_byte_are_refused(self):
        packed = self.path("a.sbfz")
        self.good("pack", os.path.join(SAMPLES, "valid", "jelly.sbf"), "-o", packed)
        content = read_bytes(packed)
        for offset in (0, 9, 17, 47, 60, 70, 64 + 24, 64 + 56):
            with self.subTest(offset):
                changed = bytearray(content)
                changed[offset] ^= 1
                path = write_bytes(self.path("b.sbfz"), bytes(changed))
                self.assertEqual((first(path)[0], second(path)[0]), (1, 1))
        for size in (0, 40, 64, len(content) - 1):
            path = write_bytes(self.path("b.sbfz"), content[:size])
            self.assertEqual((first(path)[0], second(path)[0]), (1, 1), size)

    def test_it_has_every_field_of_the_reference(self):
        """A new field is added to sbf_elements.py by hand, from its row in reference.md."""
        from sbf_elements import ELEMENTS  # pylint: disable=import-outside-toplevel
        stated, element = [], None
        for line in read_bytes(os.path.join(ROOT, "spec", "reference.md")).decode().splitlines():
            if line.startswith(("## ", "### ")):
                element = line.lstrip("# ")
            elif line.startswith("| ") and line[2].isdigit():
                number, name, _written, kind, _unit, default = (cell.strip() for cell in line.split(" | ")[:6])
                stated.append((element, int(number.strip("| ")), name, kind, default))
        known = {(e.name, f.number, f.name): f for e in ELEMENTS.values() for f in e.fields}
        self.assertEqual(sorted(key[:3] for key in stated), sorted(known))
        for element, number, name, kind, default in stated:
            field = known[element, number, name]
            self.assertEqual((field.kind, field.argument), tuple(kind.rstrip(")").partition("(")[::2]), name)
            if not default.startswith("always") and default != "required":
                self.assertEqual(field.default_text or "", default, f"{element}.{name}")

    def test_it_imports_nothing_of_ours(self):
        allowed = {"array", "base64", "binascii", "decimal", "fractions", "functools", "math", "os", "re", "struct",
                   "sys", "xml", "zlib"}
        for path in glob.glob(os.path.join(ROOT, "spec", "reader", "*.py")):
            for line in read_bytes(path).decode().splitlines():
                words = line.split()
                if words and words[0] in ("import", "from"):
                    name = words[1].split(".")[0]
                    self.assertTrue(name in allowed or os.path.exists(os.path.join(ROOT, "spec", "reader", name + ".py")),
                                    f"{path}: {line}")


class Converted(Comparison):
    def test_shared_data(self):
        if not os.path.isdir(shared()):
            self.skipTest("../shared/data is not there")
        for number, arguments in enumerate(CONVERTED):
            given = [a if a.startswith("--") else shared(*a.split("/")) for a in arguments]
            if not all(a.startswith("--") or os.path.exists(a) for a in given):
                continue
            with self.subTest(arguments[0]):
                path = self.path(f"{number}.sbfz")
                result = call("convert", *given, "-o", path)
                self.assertEqual(result.status, 0, result.err)
                self.assert_same(path)


if __name__ == "__main__":
    main()
