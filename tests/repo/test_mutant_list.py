#!/usr/bin/env python3
"""The list of mutants: reading, applying and refusing it. `./run mutants --check` checks that its texts are still in the source."""
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "mutants"))
from mutant_list import ListError, check_mutants, read_mutants  # noqa: E402

GOOD = """# a comment

mistake  a sum is a difference
file     tools/a.c
before   x + y
after    x - y
tests    base/test_text

mistake  the second is dropped
file     tools/a.c
under    second
before   return 1;
after
tests    base/test_text repo/test_run
"""
SOURCE = """int first(void) { return 1; }
int second(void) { return 1; }
int sum(int x, int y) { return x + y; }
"""


class List(unittest.TestCase):
    def setUp(self):
        own = tempfile.TemporaryDirectory()
        self.addCleanup(own.cleanup)
        self.folder = own.name
        for name, text in (("tools/a.c", SOURCE), ("tests/base/test_text.c", ""), ("tests/repo/test_run.py", "")):
            os.makedirs(os.path.dirname(os.path.join(self.folder, name)), exist_ok=True)
            self.write(name, text)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as stream:
            stream.write(text)

    def read(self, text):
        self.write("list.txt", text)
        return read_mutants(os.path.join(self.folder, "list.txt"))

    def test_mutants_are_read_and_applied(self):
        one, other = self.read(GOOD)
        self.assertEqual((one.mistake, one.folder, one.tests), ("a sum is a difference", "tools", ("base/test_text",)))
        self.assertIn("return x - y;", one.apply(SOURCE))
        self.assertEqual(other.apply(SOURCE), SOURCE.replace("second(void) { return 1; }", "second(void) {  }"))
        self.assertEqual(check_mutants([one, other], self.folder), [])

    def test_outdated_mutants_are_named(self):
        for change, message in ((("x + y", "x * y"), "no longer has the text 'x * y'"), (("under    second\n", ""), "2 times"),
                                (("under    second", "under    third"), "no longer has the text 'third'"),
                                (("tools/a.c", "tools/b.c"), "no file tools/b.c"), (("base/test_text", "base/test_gone"), "no test base/test_gone")):
            faults = check_mutants(self.read(GOOD.replace(*change)), self.folder)
            self.assertTrue(faults and any(message in fault for fault in faults), (change, faults))

    def test_an_invalid_list_is_refused(self):
        for change, message in ((("before ", "bevor  "), "'bevor'"), (("file     tools/a.c\nbefore", "before"), "no 'file'"),
                                (("tools/a.c", "docs/a.c"), "none of the folders"), (("x - y", "x + y"), "are the same"),
                                (("tests    base/test_text\n\n", "tests    base/test_text\n"), "twice")):
            with self.assertRaises(ListError) as raised:
                self.read(GOOD.replace(*change, 1))
            self.assertIn(message, str(raised.exception))


if __name__ == "__main__":
    unittest.main(verbosity=2)
