#!/usr/bin/env python3
"""Calls point one way: reads from the built libraries which file calls which, and names the circles.

Includes alone do not tell: a header may declare what any file defines. So `nm` is asked what each member of the
static libraries defines and what it needs of the others, functions and tables alike.

- No files call each other in a circle.
- Folders take inner names only of those that their row in check_includes.py names.

Usage: check_calls.py LIBRARY.a..."""
import os
import sys

from check_includes import MAY_USE, longest
from check_symbols import run
from repo_files import SKIPPED, conclude, project_files


def read(table, positions):
    """`table`: what `nm` prints of the library; `positions`: file name -> path. Path -> path -> names that the first takes of the
    second, and the members that have no source."""
    needs, owners, lost, member = {}, {}, [], None
    for line in table.splitlines():
        fields = line.split()
        if line.endswith(":"):
            name = line[:-1].rsplit(".", 1)[0]
            member = positions.get(name)
            if member is None:
                lost.append(name)
            else:
                needs[member] = []
        elif len(fields) >= 2 and member is not None:
            if fields[-2] == "U":
                needs[member].append(fields[-1])
            elif fields[-2].isupper():
                owners[fields[-1]] = member
    calls = {path: {} for path in needs}
    for path, names in needs.items():
        for name in names:
            if owners.get(name, path) != path:
                calls[path].setdefault(owners[name], []).append(name)
    return calls, lost


def reach(calls, start):
    found, left = set(), [start]
    while left:
        for path in calls[left.pop()]:
            if path not in found:
                found.add(path)
                left.append(path)
    return found


def circles_of(calls):
    """Sets of files that call each other, directly or through others."""
    reached = {path: reach(calls, path) for path in calls}
    return sorted({frozenset(other for other in reached[path] if path in reached[other])
                   for path in calls if path in reached[path]}, key=sorted)


def is_inner(name):
    return not name.startswith(("sbf_", "sbr_"))


def faults_of(calls, lost):
    faults = [f"{name}: in a library, and no one source of the project has that name" for name in lost]
    for circle in circles_of(calls):
        ties = [f"\n  {a} takes {', '.join(sorted(calls[a][b]))} of {b}"
                for a in sorted(circle) for b in sorted(calls[a]) if b in circle]
        faults.append("a circle: move what the lower file takes of the upper one below both" + "".join(ties))
    for a in sorted(calls):
        folder = longest(MAY_USE, a)
        for b in sorted(calls[a]):
            inner = sorted(filter(is_inner, calls[a][b]))
            if inner and not any(b.startswith(one + "/") for one in MAY_USE[folder] or []):
                faults.append(f"{a}: {', '.join(inner)} of {b}: {folder} must not use {b.rsplit('/', 1)[0]}")
    return faults


def main():
    libraries = [path for path in sys.argv[1:] if os.path.exists(path)]
    if not libraries:
        print("skipped: no static library given, as in a build with BUILD_SHARED_LIBS")
        sys.exit(SKIPPED)
    positions = {os.path.basename(path): path for path in project_files()
              if path.startswith(("libsbfmt/", "runtime/")) and path.endswith(".c") and not path.startswith("runtime/hosts/")}
    calls, lost = read("".join(run("nm", path) for path in libraries), positions)
    faults = faults_of(calls, lost)
    count = sum(len(names) for others in calls.values() for names in others.values())
    if len(calls) < 20 or count < 100:
        faults.append(f"only {count} names between {len(calls)} files seen: the check would be empty")
    conclude(f"{count} names that {len(calls)} files take of each other", faults)


if __name__ == "__main__":
    main()
