#!/usr/bin/env python3
"""What the built static libraries define and need.

- Every symbol that leaves a file carries the project's prefix: two libraries in one engine must not clash.
- No library owns writable data: no globals, so worlds and loads on different threads cannot meet.
- core, mechanics and runtime need nothing of libm whose bits differ by machine.

Usage: check_symbols.py LIBRARY.a..."""
import os
import re
import subprocess
import sys

from repo_files import SKIPPED, conclude

OURS = re.compile(r"^_?(sbf|sbfi|sbr|sbri)_")
SAME_EVERYWHERE = ("libsbfmt-core.a", "libsbfmt-mechanics.a", "libsbrun.a")
# sqrt is correctly rounded by IEEE 754, and floor and its like are exact; these are neither.
LIBM = re.compile(r"^(a?(sin|cos|tan)h?|atan2|sincos|pow|exp|exp2|exp10|expm1|log|log2|log10|log1p|cbrt|hypot|t?gamma|"
                  r"lgamma|erf|erfc|j[01n]|y[01n])[fl]?$")


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def symbol_faults(library, table):
    """`table`: what `nm` prints of the library."""
    faults, member = [], ""
    for line in table.splitlines():
        if line.endswith(":"):
            member = line[:-1]
            continue
        fields = line.split()
        if len(fields) < 2:
            continue
        kind, name = fields[-2], fields[-1]
        where = f"{library}({member}): {name}"
        if kind.isupper() and kind not in "UW" and not OURS.match(name):
            faults.append(f"{where}: leaves its file without the prefix sbf_, sbfi_, sbr_ or sbri_")
        if kind in "BbCDdGgSs" and not name.startswith(".") and not name.startswith("__"):
            faults.append(f"{where}: writable data; pass state in, or make it const")
        if kind == "U" and library in SAME_EVERYWHERE and LIBM.match(name):
            faults.append(f"{where}: of libm, where its bits differ by machine")
    return faults


def repeated(definitions):
    """Names that two libraries define: who links both gets one of them, and nobody is told."""
    return [f"{name}: defined in {' and '.join(sorted(libraries))}" for name, libraries in sorted(definitions.items())
            if len(libraries) > 1]


def drop_relocated_constants(library, table):
    """`nm` calls constants that hold addresses (.data.rel.ro) writable: leave them out by their section."""
    constants = set()
    for line in run("objdump", "-t", library).splitlines():
        if "\t" in line and ".data.rel.ro" in line:
            constants.add(line.split()[-1])
    return "\n".join(line for line in table.splitlines()
                     if not (line.split()[-2:-1] in (["d"], ["D"]) and line.split()[-1] in constants))


def main():
    libraries = [path for path in sys.argv[1:] if os.path.exists(path)]
    if not libraries:
        print("skipped: no static library given, as in a build with BUILD_SHARED_LIBS")
        sys.exit(SKIPPED)
    faults, seen, definitions = [], 0, {}
    for path in libraries:
        table = run("nm", path)
        seen += table.count(" T ")
        for name in re.findall(r" [TDRB] (\w+)$", table, re.MULTILINE):
            definitions.setdefault(name, set()).add(os.path.basename(path))
        faults += symbol_faults(os.path.basename(path), drop_relocated_constants(path, table))
    faults += repeated(definitions)
    if seen < 20:
        faults.append(f"only {seen} functions seen: the check would be empty")
    conclude(f"{seen} functions of {len(libraries)} libraries", faults)


if __name__ == "__main__":
    main()
