#!/usr/bin/env python3
"""Runs benchmarks again and compares results that do not depend on the machine: errors, counts and bytes. Ignores times.

    bench/check_results.py --build build/release [--update] [NAME...]     (all tables below if none is named)

Compares each row of a table of bench/results with the program's output, in the columns of TABLES. `drawings` compares the charts of
docs/media with their tables; `maps` compares the maps there with new ones. --update writes these columns and drawings, and keeps the
times and the commit at which they were measured. Exit status: 0 fresh, 1 stale, 77 a program or gnuplot is missing."""
import argparse
import csv
import glob
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RESULTS = os.path.join(ROOT, "bench", "results")
MEDIA = os.path.join(ROOT, "docs", "media")
SKIPPED = 77
NEAR = 2e-3  # compilers differ in the last digits of sums in double precision


@dataclass
class Table:
    keys: str  # columns that identify a row
    same: str  # columns that are compared
    cases: tuple = ()  # of `sbfmt chart`; none: bench_NAME
    only: tuple = ()  # (column, value) of the rows that are compared
    example: str = ""  # whose character is charted
    most_substeps: int = 64
    from_shared: bool = False  # rows may be of ../shared/data, which is not always there


CHARTED = "elements visits_per_frame outcome path_m farthest_m period amplitude shape volume energy path_px farthest_px"
CHART_KEYS = "case model scheme substeps step_error_m elements"
TABLES = {
    "size": Table("file", "vertices polygons springs xml gzip packed stored meshes glb packed/xml packed/gzip meshes/glb"),
    "elements": Table("file cell_m", "points tetrahedra elements_xml elements_packed elements_xml/elements_packed xml packed packed/xml"),
    "schemes": Table("body scheme substeps", "points springs error_mm"),
    "ik": Table("solver limits targets tolerance_m", "passes error_mean_m error_most_m missed of"),
    "skin": Table("mesh level", "triangles vertices"),
    "levels": Table("body level", "elements error_mm cost"),
    "springs": Table("body method", "points elements leaving spread fall off substeps"),
    "falls": Table("scene engine method steps iterations", "elements apart_mm beyond_deg deep_mm inside rest_mm_s stretch_pct",
                   only=("engine", "sbrun")),
    "knocked": Table("scene steps", "sections bone_mm flesh_mm"),
    "thrown": Table("variant", "tetrahedra polygons joints bend_deg beyond_deg sag_mm swing_mm given_n_s left_deg left_mm"),
    "lattice": Table("surface by tetrahedra", "least_deg most_deg volume farthest_cells", only=("by", "sbfmt"), from_shared=True),
    "crowd": Table("character count threads", "elements substeps", from_shared=True),
    "detail": Table("case lizards", "visits rms_px worst_lizard_px worst_px soft coarser jiggle bones away returned"),
    "bullet": Table("body engine method steps iterations threads", "points elements error_mm", only=("engine", "sbrun"), from_shared=True),
    "chart-character": Table(CHART_KEYS, CHARTED, cases=("walk",), example="pup", most_substeps=16),
    "chart-drop": Table(CHART_KEYS, CHARTED, cases=("drop",)),
    "chart-beam": Table(CHART_KEYS, CHARTED, cases=("beam",)),
    "chart-pendulum": Table(CHART_KEYS, CHARTED, cases=("pendulum",)),
    "chart-meshes": Table(CHART_KEYS, CHARTED, cases=("cantilever-meshes",)),
}
DRAWINGS = (("chart-meshes", "cantilever-meshes-shape"), ("chart-beam", "beam-amplitude"), ("chart-drop", "drop-volume"),
            ("chart-pendulum", "pendulum-period"), ("chart-character", "walk-path_px"))
MAPS = ("damping", "mass-springs", "poisson")  # always drawn: they have no times and no stored table


def skip(message):
    print(f"skipped: {message}")
    sys.exit(SKIPPED)


def path_of(name):
    """The table, from any machine."""
    found = glob.glob(os.path.join(RESULTS, "*", name + ".csv"))
    if len(found) != 1:
        sys.exit(f"bench/results has {len(found)} tables {name}.csv, not one: keep the newest")
    return found[0]


def read_table(path):
    with open(path, encoding="utf-8", newline="") as stream:
        reader = csv.DictReader(stream)
        return reader.fieldnames, list(reader)


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(f"{' '.join(command)} failed:\n{done.stderr[-2000:]}")
    return done.stdout


def converted(program, table, folder):
    """[the file of the table's character], or nothing."""
    if not table.example:
        return []
    path = os.path.join(folder, table.example + ".sbf")
    run([program, "convert", os.path.join(ROOT, "examples", table.example, table.example + ".glb"), "--budget", "none", "-o", path])
    return [path]


def measure(build, name):
    """The rows that the table's program prints now."""
    table = TABLES[name]
    program = os.path.join(build, "tools", "sbfmt") if table.cases else os.path.join(build, "bench", f"bench_{name}")
    if not os.access(program, os.X_OK):
        skip(f"{program} is not built")
    if not table.cases:
        return list(csv.DictReader(io.StringIO(run([program, "--once"]))))
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        character = converted(program, table, folder)
        for case in table.cases:
            run([program, "chart", *character, "--no-svg", "--runs", "1", "--most-substeps", str(table.most_substeps), "--case", case,
                 "-o", folder])
            rows += read_table(os.path.join(folder, case + ".csv"))[1]
    return rows


def is_same(one, other):
    if one == other:
        return True
    try:
        a, b = float(one), float(other)
    except ValueError:
        return False
    digits = max(len(text.partition(".")[2]) for text in (one, other) if "e" not in text) if "e" not in one + other else 0
    return abs(a - b) <= max(NEAR * max(abs(a), abs(b)), 1.01 * 10.0**-digits if digits else 0)


def compare(name, kept, fresh):
    """(messages about stale values, [(row, column, new value)])."""
    table = TABLES[name]
    key = lambda row: tuple(row[column] for column in table.keys.split())  # noqa: E731
    now = {key(row): row for row in fresh}
    stale, changes = [], []
    for row in kept:
        if row.get("scheme") == "reference" or table.only and row[table.only[0]] != table.only[1]:
            continue
        found = now.pop(key(row), None)
        if found is None:
            if not table.from_shared and "/" not in row.get("file", ""):
                stale.append(f"{name}: {' '.join(key(row))} is no longer measured")
            continue
        broken = row.get("outcome", "sound") != "sound" and row["outcome"] == found["outcome"]
        for column in ("elements",) if broken else table.same.split():  # the error of a run that exploded means nothing
            if not is_same(row[column], found[column]):
                stale.append(f"{name}: {' '.join(key(row))}: {column} is {found[column]}, not {row[column]}")
                changes.append((row, column, found[column]))
    for left, row in now.items():
        if row.get("scheme") != "reference" and not (table.only and row[table.only[0]] != table.only[1]):
            stale.append(f"{name}: {' '.join(left)} is measured and not in the table: run ./run bench {name}")
    return stale, changes


def write_rows(path, columns, rows, changed):
    """Writes the changed rows and keeps the lines of all others."""
    with open(path, encoding="utf-8") as stream:
        head, *lines = stream.read().splitlines()
    with open(path, "w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, columns, lineterminator="\n")
        stream.write(head + "\n")
        for line, row in zip(lines, rows):
            if id(row) in changed:
                writer.writerow(row)
            else:
                stream.write(line + "\n")


def check_table(build, name, update):
    path = path_of(name)
    columns, kept = read_table(path)
    stale, changes = compare(name, kept, measure(build, name))
    if update and changes:
        for row, column, value in changes:
            row[column] = value
        write_rows(path, columns, kept, {id(row) for row, _, _ in changes})
    return stale


def without_times(drawing):
    """The drawing's text without its compiler, commit and date, and what differs from one gnuplot to the next."""
    return re.sub(r"<desc>.*?</desc>|gnuplot_plot_\d+\w*|gnuplot [\d.]+ \w+ \d+|\d+ lanes, [^<]*", "", drawing, flags=re.DOTALL)


def check_drawing(fresh, kept, update):
    with open(fresh, encoding="utf-8") as one, open(os.path.join(MEDIA, kept), encoding="utf-8") as other:
        if without_times(one.read()) == without_times(other.read()):
            return []
    if update:
        shutil.copy(fresh, os.path.join(MEDIA, kept))
    return [f"docs/media/{kept} differs from a new drawing"]


def draws(build):
    """The program that draws, or None."""
    program = os.path.join(build, "tools", "sbfmt")
    if not (shutil.which("gnuplot") and os.access(program, os.X_OK)):
        skip("gnuplot is not installed, or sbfmt is not built")
    return program


def check_drawings(build, update):
    program = draws(build)
    stale = []
    with tempfile.TemporaryDirectory() as folder:
        for table, drawing in DRAWINGS:
            run([program, "chart", *converted(program, TABLES[table], folder), "--redraw", path_of(table), "-o", folder])
            stale += check_drawing(os.path.join(folder, drawing + ".svg"), table + ".svg", update)
    return stale


def check_maps(build, update):
    program = draws(build)
    stale = []
    with tempfile.TemporaryDirectory() as folder:
        run([program, "chart", "--map", *(word for name in MAPS for word in ("--case", name)), "-o", folder])
        for name in MAPS:
            stale += check_drawing(os.path.join(folder, f"map-{name}.svg"), f"map-{name}.svg", update)
    return stale


OTHERS = {"drawings": check_drawings, "maps": check_maps}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--build", required=True)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    names = arguments.names or [*TABLES, *OTHERS]
    unknown = [name for name in names if name not in TABLES and name not in OTHERS]
    if unknown:
        parser.error(f"no table {unknown[0]}; there are: {', '.join([*TABLES, *OTHERS])}")
    stale = []
    for name in names:
        found = OTHERS[name](arguments.build, arguments.update) if name in OTHERS else check_table(arguments.build, name, arguments.update)
        print(f"{name}: {len(found)} stale" if found else f"{name}: fresh", flush=True)
        stale += found
    if stale and not arguments.update:
        print(*stale[:40], sep="\n")
        print("bench/check_results.py --build BUILD --update, then bench/write_tables.py, write them anew; ./run bench measures the times")
        sys.exit(1)


if __name__ == "__main__":
    main()
