#!/usr/bin/env python3
"""Compares the ABI of the shared libraries with abi.txt: their calls, and the layout of the public types.

Usage: check_abi.py --source DIR --build DIR [--accept]
Compares the shared libraries in the folder --build (built with -g) with abi.txt beside this script. What is gone, moved or of
another type fails, for programs built before would break; but while no version of this soname is released (CHANGELOG.md), there
are none, and it is only told. What is new is told, and fails nothing. --accept writes abi.txt anew, for a change that is meant
and at each release. A call of another name than the public ones fails always. Skips (77) without abigail's tools."""
import argparse
import functools
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
from xml.etree import ElementTree

SKIPPED = 77
PUBLIC = re.compile(r"^sb[fr]_")
PRIVATE = re.compile(r"^sb[fr]i_")
LISTED = os.path.join(os.path.dirname(os.path.abspath(__file__)), "abi.txt")
HEAD = """# Calls and public types of the shared libraries, as check_abi.py finds them: offsets and sizes in bits, on x86-64.
# Not written by hand. After a change that is meant: ./run abi --accept
"""


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(command)}\n{done.stdout[-3000:]}{done.stderr[-3000:]}")
    return done.stdout


def libraries_of(arguments):
    found = [os.path.join(arguments.build, folder, f"lib{name}.so") for folder, name in (
        ("libsbfmt", "sbfmt-core"), ("libsbfmt", "sbfmt-mechanics"), ("libsbfmt", "sbfmt-format"),
        ("libsbfmt", "sbfmt-interchange"), ("runtime", "sbrun"))]
    return [path for path in found if os.path.exists(path) or sys.exit(f"{path} was not built")]


class Description:
    """One library, as abidw describes it."""

    def __init__(self, library, headers):
        self.library = os.path.basename(library)
        with tempfile.NamedTemporaryFile(suffix=".abi") as file:
            run("abidw", *(word for folder in headers for word in ("--headers-dir", folder)), "--drop-private-types",
                "--out-file", file.name, library)
            self.root = ElementTree.parse(file.name).getroot()
        self.types = {node.get("id"): node for node in self.root.iter() if node.get("id")}

    @functools.cache
    def name_of(self, identifier):
        node = self.types.get(identifier)
        if node is None:
            return "?"
        if node.tag in ("pointer-type-def", "reference-type-def"):
            return self.name_of(node.get("type-id")) + " *"
        if node.tag == "qualified-type-def":
            inner = self.name_of(node.get("type-id"))
            return inner + " const" if inner.endswith("*") else "const " + inner
        if node.tag == "array-type-def":
            return self.name_of(node.get("type-id")) + "".join(f"[{part.get('length')}]" for part in node.iter("subrange"))
        if node.tag == "function-type":
            given = [self.name_of(part.get("type-id")) for part in node.iter("parameter")]
            return f"{self.name_of(node.find('return').get('type-id'))} ({', '.join(given)})"
        return node.get("name") or node.tag

    def calls(self):
        symbols = [node for node in self.root.iter("elf-symbol") if node.get("is-defined") == "yes"]
        for node in symbols:
            name, version = node.get("name"), node.get("version")
            kind = PUBLIC.match(name) and "SBFMT_0" or PRIVATE.match(name) and "SBFMT_PRIVATE"
            if kind != version:
                sys.exit(f"{self.library} exports {name} as {version or 'no version'}: names begin with sbf_ or sbr_ (SBFMT_0), "
                         "or with sbfi_ or sbri_ (SBFMT_PRIVATE)")
        signatures = {node.get("elf-symbol-id"): node for node in self.root.iter("function-decl")}
        made = {}
        for node in symbols:
            call = signatures.get(f"{node.get('name')}@@SBFMT_0")
            if node.get("version") == "SBFMT_0" and call is not None:
                given = [self.name_of(part.get("type-id")) or "..." for part in call.iter("parameter")]
                made[node.get("name")] = f"{self.name_of(call.find('return').get('type-id'))} ({', '.join(given)})"
            elif node.get("version") == "SBFMT_0":
                made[node.get("name")] = "data"
        return made

    def public_types(self):
        made = {}
        for node in self.root.iter():
            if not PUBLIC.match(node.get("name") or "") or node.get("is-declaration-only") == "yes":
                continue
            if node.tag in ("class-decl", "union-decl") and node.get("size-in-bits"):
                members = {}
                for part in node.iter("data-member"):
                    member = part.find("var-decl")
                    members[member.get("name")] = \
                        f"at {part.get('layout-offset-in-bits') or 0}: {self.name_of(member.get('type-id'))}"
                made[f"struct {node.get('name')}"] = members
            elif node.tag == "enum-decl":
                made[f"enum {node.get('name')}"] = {part.get("name"): part.get("value") for part in node.iter("enumerator")}
        return made


def describe(libraries, source):
    """{section: {name: what}}"""
    headers = [os.path.join(source, folder, "include") for folder in ("libsbfmt", "runtime")]
    calls, types = {}, {}
    for path in libraries:
        described = Description(path, headers)
        calls[f"calls of {described.library}"] = described.calls()
        for name, members in described.public_types().items():
            if len(members) >= len(types.get(name, {})):
                types[name] = members
    return {**calls, **dict(sorted(types.items()))}


def written(found):
    lines = []
    for section, entries in found.items():
        lines.append(f"\n{section}\n")
        names = sorted(entries) if section.startswith("calls") else entries
        lines.extend(f"  {name} {entries[name]}\n" for name in names)
    return HEAD + "".join(lines)


def listed():
    made, section = {}, None
    with open(LISTED, encoding="utf-8") as file:
        for line in file:
            if line.startswith("  "):
                name, what = line.strip().split(" ", 1)
                made[section][name] = what
            elif line.strip() and not line.startswith("#"):
                section = line.strip()
                made[section] = {}
    return made


def counts_kinds(section, name):
    """An enum's last entry, which says how many there are and grows with it."""
    return section.startswith("enum") and name.endswith("_COUNT")


def compare(was, found):
    broken, new = [], []
    for section, entries in was.items():
        now = found.get(section, {})
        broken += [f"{section}: {name} is gone" for name in entries if name not in now]
        broken += [f"{section}: {name} was {what}, is {now[name]}" for name, what in entries.items()
                   if name in now and now[name] != what and not counts_kinds(section, name)]
    for section, entries in found.items():
        new += [f"{section}: {name}" for name in entries if name not in was.get(section, {})]
    return broken, new


def is_released(source):
    """Whether the newest version in CHANGELOG.md has a released one of the same soname."""
    with open(os.path.join(source, "CHANGELOG.md"), encoding="utf-8") as file:
        headings = re.findall(r"^## (\d+\.\d+)\.\d+(.*)$", file.read(), re.M)
    return any(minor == headings[0][0] and "not yet released" not in rest for minor, rest in headings)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--source", required=True)
    parser.add_argument("--build", required=True)
    parser.add_argument("--accept", action="store_true")
    arguments = parser.parse_args()
    missing = [name for name in ("abidw", "abidiff") if not shutil.which(name)]
    if missing:
        print(f"skipped: {', '.join(missing)} not installed (abigail-tools)")
        sys.exit(SKIPPED)
    libraries = libraries_of(arguments)
    for path in libraries:
        if run("abidiff", path, path).strip():
            sys.exit(f"abidiff finds {path} to differ from itself")
    found = describe(libraries, arguments.source)
    if arguments.accept:
        with open(LISTED, "w", encoding="utf-8") as file:
            file.write(written(found))
        print(f"written: {LISTED}")
        return
    broken, new = compare(listed(), found)
    if new:
        print(f"new, {len(new)}: " + "; ".join(new[:40]))
    if broken and is_released(arguments.source):
        sys.exit("\n".join(broken[:60]) + f"\n{len(broken)} changes break programs that are built already. Where that is meant "
                 "(before 1.0, with a new minor version): say so in CHANGELOG.md and call ./run abi --accept")
    if broken:
        print("\n".join(broken[:60]) + f"\n{len(broken)} changes, which break nobody: no version of this soname is released yet")
        return
    print(f"{sum(map(len, found.values()))} entries: nothing is gone or moved")


if __name__ == "__main__":
    main()
