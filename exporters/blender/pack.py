#!/usr/bin/env python3
"""Makes the add-on's zip: the add-on, the Python module inside it, and the named libraries beside the module. With a library the
manifest names the platform that it runs on, which Blender requires of an extension. A folder holds the licences of the code that is
linked into the library.

    pack.py OUT.zip [--licences FOLDER] [LIBRARY...]
"""

import argparse
import os
import sys
import zipfile

FOLDER = os.path.dirname(os.path.abspath(__file__))
ADDON = "soft_body_format"
STAMP = (2026, 1, 1, 0, 0, 0)  # a fixed date: the same input gives the same bytes


def python_files(folder):
    for base, folders, names in sorted(os.walk(folder)):
        folders.sort()
        yield from (os.path.join(base, name) for name in sorted(names) if name.endswith((".py", ".toml")))


def platform_of(library):
    """Blender's name for the platform of a library, from its header: ELF, PE or Mach-O."""
    with open(library, "rb") as file:
        head = file.read(4096)
    if head[:4] == b"\x7fELF":
        return {62: "linux-x64", 183: "linux-arm64"}.get(int.from_bytes(head[18:20], "little"))
    if head[:2] == b"MZ":
        at = int.from_bytes(head[60:64], "little")
        return {0x8664: "windows-x64", 0xAA64: "windows-arm64"}.get(int.from_bytes(head[at + 4:at + 6], "little"))
    return {0x01000007: "macos-x64", 0x0100000C: "macos-arm64"}.get(int.from_bytes(head[4:8], "little"))


def with_platforms(manifest, platforms):
    named = ", ".join(f'"{platform}"' for platform in sorted(platforms))
    return manifest.replace(b"\n[permissions]", f"platforms = [{named}]\n\n[permissions]".encode()) if platforms else manifest


def add(archive, path, name, change=None):
    with open(path, "rb") as file:
        content = file.read()
    entry = zipfile.ZipInfo(name, STAMP)
    entry.external_attr = 0o644 << 16
    entry.compress_type = zipfile.ZIP_DEFLATED
    archive.writestr(entry, change(content) if change else content)


def main(out, libraries, licences):
    module = os.path.join(FOLDER, os.pardir, "python", "sbfmt")
    temporary = f"{out}.{os.getpid()}"
    kinds = [(platform_of(path) or sys.exit(f"pack.py: {path} is not a library for a platform that Blender supports"), os.path.basename(path))
             for path in libraries]
    if len(set(kinds)) < len(libraries):
        sys.exit("pack.py: two libraries have the same name and platform: name one of them")
    platforms = {platform for platform, _ in kinds}
    with zipfile.ZipFile(temporary, "w") as archive:
        for folder, inside in ((os.path.join(FOLDER, ADDON), ADDON), (module, f"{ADDON}/sbfmt")):
            for path in python_files(folder):
                change = (lambda content: with_platforms(content, platforms)) if path.endswith("blender_manifest.toml") else None
                add(archive, path, f"{inside}/{os.path.relpath(path, folder).replace(os.sep, '/')}", change)
        for path, (platform, name) in zip(libraries, kinds):
            add(archive, path, f"{ADDON}/sbfmt/lib/{platform}/{name}")
        for name in sorted(os.listdir(licences)) if licences else ():
            add(archive, os.path.join(licences, name), f"{ADDON}/sbfmt/lib/licences/{name}")
    os.replace(temporary, out)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("--licences", default="")
    parser.add_argument("libraries", nargs="*")
    arguments = parser.parse_intermixed_args()
    main(arguments.out, arguments.libraries, arguments.licences)
