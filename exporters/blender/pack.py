#!/usr/bin/env python3
"""Makes the add-on's zip: the add-on, the Python module inside it, and, where one is named, the library beside the module.

    pack.py OUT.zip [LIBRARY...]
"""

import os
import sys
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ADDON = "soft_body_format"
STAMP = (2026, 1, 1, 0, 0, 0)  # the same bytes whenever it is made


def python_files(folder):
    for base, folders, names in sorted(os.walk(folder)):
        folders.sort()
        yield from (os.path.join(base, name) for name in sorted(names) if name.endswith((".py", ".toml")))


def add(archive, path, name):
    with open(path, "rb") as file:
        entry = zipfile.ZipInfo(name, STAMP)
        entry.external_attr = 0o644 << 16
        entry.compress_type = zipfile.ZIP_DEFLATED
        archive.writestr(entry, file.read())


def main(out, libraries):
    module = os.path.join(HERE, os.pardir, "python", "sbfmt")
    temporary = f"{out}.{os.getpid()}"
    with zipfile.ZipFile(temporary, "w") as archive:
        for folder, inside in ((os.path.join(HERE, ADDON), ADDON), (module, f"{ADDON}/sbfmt")):
            for path in python_files(folder):
                add(archive, path, f"{inside}/{os.path.relpath(path, folder).replace(os.sep, '/')}")
        for path in libraries:
            add(archive, path, f"{ADDON}/sbfmt/lib/{os.path.basename(path)}")
    os.replace(temporary, out)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2:])
