"""Files of every version of the format load as they always did: spec/samples/kept."""

import glob
import os
import re

from sbfmt_program import ProgramTest, ROOT, main, read_bytes, read_text

KEPT = os.path.join(ROOT, "spec", "samples", "kept")


class KeptFiles(ProgramTest):
    def test_each_gives_the_same_text(self):
        packed = sorted(glob.glob(os.path.join(KEPT, "*", "*.sbfz")))
        texts = sorted(glob.glob(os.path.join(KEPT, "*", "*.sbf")))
        self.assertGreaterEqual(len(packed), 4)
        for path in texts + packed:
            with self.subTest(os.path.relpath(path, KEPT)):
                text = read_bytes(re.sub(r"(_stored)?\.sbfz?$", ".sbf", path))
                out = self.path("again.sbf")
                self.good("unpack", path, "-o", out)
                # What has its default is not written, so that new fields change nothing; the version may be a later one.
                again = re.sub(rb'<sbf version="[0-9.]+"', b'<sbf version="' + self.version_of(text) + b'"', read_bytes(out))
                self.assertEqual(again, text)

    @staticmethod
    def version_of(text):
        return re.search(rb'<sbf version="([0-9.]+)"', text).group(1)

    def test_the_current_version_is_among_them(self):
        schema = read_text(os.path.join(ROOT, "spec", "sbf.schema"))
        version = re.search(r"^version (\d+\.\d+)", schema, re.MULTILINE).group(1)
        self.assertTrue(os.path.isfile(os.path.join(KEPT, version, "everything.sbfz")), f"no {version}")


if __name__ == "__main__":
    main()
