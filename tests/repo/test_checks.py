#!/usr/bin/env python3
"""Tests that each check of this folder finds its faults and accepts correct input."""
import os
import tempfile
import unittest

import check_calls
import check_charts
import check_docs
import check_includes
import check_names
import check_symbols
import check_words
import repo_files

FILES = {"libsbfmt/base/memory.h", "libsbfmt/model/check.h", "libsbfmt/build/springs/springs.h", "libsbfmt/xml/reader.h",
         "libsbfmt/validate/rules.h", "libsbfmt/mechanics/spring.h", "runtime/state/world.h", "runtime/math/vec3.h", "tools/cli.h"}


class Includes(unittest.TestCase):
    def test_folders_of_the_runtime_stand_one_on_another(self):
        seen = []
        for folder, below in check_includes.RUNTIME.items():
            self.assertEqual(set(below) - set(seen), set(), folder)
            seen.append(folder)

    def test_groups_of_folders_form_no_circle(self):
        group = lambda folder: folder.split("/")[0]
        above = {}
        for folder, below in check_includes.RUNTIME.items():
            above.setdefault(group(folder), set()).update(group(one) for one in below if group(one) != group(folder))
        placed = set()
        while ready := {one for one in above if one not in placed and above[one] <= placed}:
            placed |= ready
        self.assertEqual(set(above) - placed, set())

    def faults(self, path, *lines):
        return check_includes.faults_of(path, "".join(f"#include {line}\n" for line in lines), FILES)

    def test_right_arrows(self):
        for path, line in [("libsbfmt/model/a.c", '"base/memory.h"'), ("libsbfmt/build/a.c", '"mechanics/spring.h"'),
                           ("libsbfmt/xml/a.c", "<libxml/parser.h>"), ("libsbfmt/packed/a.c", "<zlib.h>"),
                           ("libsbfmt/import/assimp/a.c", "<assimp/scene.h>"), ("runtime/world/a.c", '"base/memory.h"'),
                           ("runtime/world/a.c", '"mechanics/spring.h"'), ("runtime/world/a.c", '"math/vec3.h"'),
                           ("libsbfmt/base/file_posix.c", "<sys/mman.h>"), ("tools/a.c", '"sbfmt/convert.h"'),
                           ("tools/a.c", "<string.h>"), ("tests/base/a.c", '"runtime/state/world.h"')]:
            self.assertEqual(self.faults(path, line), [], (path, line))

    def test_wrong_arrows(self):
        for path, line in [("libsbfmt/base/a.c", '"model/check.h"'), ("libsbfmt/mechanics/a.c", '"build/springs/springs.h"'),
                           ("libsbfmt/xml/a.c", '"build/springs/springs.h"'), ("libsbfmt/build/a.c", '"validate/rules.h"'),
                           ("libsbfmt/model/a.c", "<libxml/tree.h>"), ("libsbfmt/xml/a.c", "<zlib.h>"),
                           ("libsbfmt/import/a.c", "<assimp/scene.h>"), ("runtime/world/a.c", '"build/springs/springs.h"'),
                           ("runtime/world/a.c", "<libxml/parser.h>"), ("runtime/world/a.c", '"sbfmt/build.h"'),
                           ("runtime/world/a.c", "<sbfmt/convert.h>"), ("runtime/math/a.h", '"state/world.h"'),
                           ("runtime/soft/solvers/a.c", '"state/world.h"'),
                           ("runtime/hosts/web/a.c", '"state/world.h"'), ("tools/a.c", '"base/memory.h"'),
                           ("libsbfmt/include/sbfmt/packed.h", '"sbfmt/io.h"'), ("runtime/hosts/web/a.c", '"sbfmt/io.h"'),
                           ("libsbfmt/include/sbfmt/packed.h", '"sbfmt/validate.h"'),
                           ("libsbfmt/include/sbfmt/packed.h", '"base/memory.h"'),
                           ("libsbfmt/include/sbfmt/novel.h", '"sbfmt/base.h"'),
                           ("libsbfmt/base/text.c", "<locale.h>"), ("libsbfmt/base/text.c", "<unistd.h>"),
                           ("runtime/world/a.c", "<pthread.h>"), ("libsbfmt/base/a.c", '"base/nowhere.h"'),
                           ("libsbfmt/base/a.c", '"sbrun/sbrun.h"')]:
            self.assertEqual(len(self.faults(path, line)), 1, (path, line))

    def test_line_is_named(self):
        self.assertIn("libsbfmt/model/a.c:2:", self.faults("libsbfmt/model/a.c", "<string.h>", "<zlib.h>")[0])


class Charts(unittest.TestCase):
    TABLE = "case,scheme,commit\nbeam,heun,12ab\nbeam,reference,\n"

    def test_a_chart_is_of_its_table(self):
        drawing = "<text>{}</text><text>commit {}, 2026-01-01</text>"
        self.assertEqual(check_charts.faults_of_chart("beam", drawing.format("beam", "12ab"), self.TABLE), [])
        for case, commit, table in (("drop", "12ab", self.TABLE), ("beam", "34cd", self.TABLE), ("beam", "12ab", None)):
            faults = check_charts.faults_of_chart("beam", drawing.format(case, commit), table)
            self.assertEqual(len(faults), 1, (case, commit))


class Calls(unittest.TestCase):
    PLACES = {"a.c": "runtime/world/a.c", "b.c": "runtime/state/b.c", "c.c": "runtime/state/c.c"}

    def faults(self, **calls):
        """`calls`: of each file (without its .c) the functions that it calls; each defines one of its own name."""
        table = "".join(f"\n{name}.c.o:\n0000000000000000 T sbri_{name}\n0000000000000000 t own\n                 U memcpy\n" +
                        "".join(f"                 U sbri_{other}\n" for other in others) for name, others in calls.items())
        return check_calls.faults_of(*check_calls.read(table, self.PLACES))

    def test_right_calls(self):
        self.assertEqual(self.faults(a="bc", b="c", c=""), [])
        self.assertEqual(self.faults(a="a", b="x", c=""), [])  # its own; what another library has

    def test_a_circle(self):
        faults = self.faults(a="b", b="c", c="b")
        self.assertEqual(len(faults), 1)
        for name in ("runtime/state/b.c", "runtime/state/c.c", "sbri_b", "sbri_c"):
            self.assertIn(name, faults[0])
        self.assertNotIn("runtime/world/a.c", faults[0])

    def test_a_call_up(self):
        faults = self.faults(a="", b="a", c="")
        self.assertEqual(len(faults), 1)
        self.assertIn("sbri_a", faults[0])

    def test_members_of_another_format(self):
        calls, _ = check_calls.read("\na.c.obj:\n0000 T sbri_a\nU sbri_b\n\nb.c.obj:\n0000 R sbri_b\n", self.PLACES)
        self.assertEqual(calls, {"runtime/world/a.c": {"runtime/state/b.c": ["sbri_b"]}, "runtime/state/b.c": {}})


class Files(unittest.TestCase):
    def test_without_git(self):
        """A tree that git does not know is walked: builds are left out, a source folder called build is not."""
        with tempfile.TemporaryDirectory() as root:
            for path in ("run", "lib/build/a.c", "build/release/b.c", "out/c.png", "lib/__pycache__/d.pyc"):
                os.makedirs(os.path.join(root, os.path.dirname(path)), exist_ok=True)
                with open(os.path.join(root, path), "w", encoding="utf-8"):
                    pass
            self.assertEqual(repo_files.project_files(root), ["lib/build/a.c", "run"])


class Names(unittest.TestCase):
    def test_names(self):
        self.assertEqual(check_names.faults_of({"a/x.c": 10, "b/x.h": 10, "README.md": 9, "b/README.md": 900}), [])
        self.assertEqual(len(check_names.faults_of({"a/x.c": 10, "b/x.c": 10})), 1)
        self.assertEqual(len(check_names.faults_of({"a/x.c": 5000, "libsbfmt/generated/y.c": 5000})), 1)

    def test_private_words(self):
        good = '#include "collide/guest.h"\n/* The guest_list */ int almost, max_speed; char *t = "least_value"; // touch_it\nbool used_in_place = a->fraction + substeps_least;\n'
        self.assertEqual(check_names.name_faults_of("a/contacts.c", good), [])
        for text in ("int most_speed;", "enum { LEAST_SIZE };", "f(a->guest);", "int first_place;", "g(HELD);", "h.way = 1;",
                     "a->share = 1;", "float share;"):
            self.assertEqual(len(check_names.name_faults_of("a/b.c", text)), 1, text)
        self.assertEqual(len(check_names.name_faults_of("a/guest_list.c", "int a;")), 1)
        self.assertEqual(len(check_names.name_faults_of("a/include/b.h", "struct { float share; };")), 1)

    def test_private_words_in_scripts(self):
        good = '"""The guest_list."""\nfraction = 1  # least_value\nname = "told"\n'
        self.assertEqual(check_names.name_faults_of("bench/a.py", good), [])
        for text in ("least_size = 1\n", "def f(guest):\n    pass\n", "a.told = 2\n"):
            self.assertEqual(len(check_names.name_faults_of("bench/a.py", text)), 1, text)

    def test_names_of_tests(self):
        good = "START_TEST(pins_carry_load)\n    def test_lists_are_used_in_place(self):\n"
        self.assertEqual(check_names.faults_of_test_names("tests/a.c", good), [])
        for text in ("START_TEST(what" "_is_pinned_stays)\n", "    def test_pins_be" "ar_load(self):\n"):
            self.assertEqual(len(check_names.faults_of_test_names("tests/a.c", text)), 1, text)


class Words(unittest.TestCase):
    def test_words(self):
        self.assertEqual(check_words.faults_of("a.c", "/* Good. */\nint a; /* usr/bin, /etc/x, a/work/b */\n", "/c/o"), [])
        for text in ["/* TO" "DO */\n", "x; /* not imple" "mented */\n", "int a; \n", "int a;\r\n", "\tint a;\n", "int a;",
                     'open("/ho' 'me/someone/x");\n', 'open("/c/o/build/x");\n']:
            self.assertEqual(len(check_words.faults_of("a.c", text, "/c/o")), 1, text)


class Docs(unittest.TestCase):
    def test_commands(self):
        run_help = "Usage\n\n  test   build\n"
        self.assertEqual(check_docs.command_faults("./run test\nls -l  # ./run away\n", run_help, None), [])
        self.assertEqual(len(check_docs.command_faults("cd x && ./run away\n", run_help, None)), 1)

    def test_programs(self):
        compiler = [("cc", ["-x", "c", "-std=c11"])]
        self.assertEqual(check_docs.compile_faults('#include "sbfmt/io.h"\nint main(void) { return 0; }\n', compiler), [])
        self.assertEqual(len(check_docs.compile_faults("int main(void) { return sbr_none(); }\n", compiler)), 1)

    def test_sizes(self):
        good = {"CHANGELOG.md": 6144, "docs/media/a.webp": 12_000_000, "a.c": 10**9}
        self.assertEqual(check_docs.size_faults(good, {"docs/a.md": 20000, "docs/b.md": 15000, "spec/sbf.md": 12000, "bench/README.md": 10**6}), [])
        bad = {"CHANGELOG.md": 6145, "docs/media/a.webp": 12_000_000, "runtime/b.PNG": 1}
        self.assertEqual(len(check_docs.size_faults(bad, {"docs/a.md": 20000, "docs/b.md": 15001, "spec/a.md": 12001})), 4)

    def test_private_words(self):
        self.assertEqual(check_docs.word_faults("It reports `told`, see [x](tell.md) and *Mend files*.\n```c\nbool told;\n```\n"), [])
        self.assertEqual(len(check_docs.word_faults("The host is told what was\nmended.")), 2)

    def test_links(self):
        other = "# One\n\n## A `b`, c: d\n\n## A `b`, c: d\n"
        self.assertEqual(check_docs.anchors(other), {"one", "a-b-c-d", "a-b-c-d-1"})

        def faults(text):
            return check_docs.link_faults("docs/ik.md", text, read=lambda path: other)
        good = "# Here\n[a](../README.md) [b](../README.md#a-b-c-d-1) [c](#here) [d](https://e.org/#f)"
        self.assertEqual(faults(good), [])
        self.assertEqual(len(faults("[a](no.md) [b](../README.md#none) [c](#there)")), 3)


class Symbols(unittest.TestCase):
    def faults(self, *lines, library="libsbrun.a"):
        return check_symbols.symbol_faults(library, "\n".join(["\nworld.c.o:", *lines]))

    def test_repeated_symbols(self):
        self.assertEqual(check_symbols.repeated({"sbfi_one": {"a"}, "sbfi_two": {"b", "a"}}),
                         ["sbfi_two: defined in a and b"])

    def test_symbols(self):
        good = ["0000000000000000 T sbr_world_step", "0000000000000000 T sbri_step", "0000000000000000 t step",
                "                 U sqrtf", "                 U memcpy", "0000000000000000 r table"]
        self.assertEqual(self.faults(*good), [])
        for bad in ["0000000000000000 T step", "0000000000000000 b counter", "0000000000000000 D sbr_state",
                    "                 U sinf", "                 U pow"]:
            self.assertEqual(len(self.faults(bad)), 1, bad)
        self.assertEqual(self.faults("                 U sinf", library="libsbfmt-format.a"), [])


if __name__ == "__main__":
    unittest.main()
