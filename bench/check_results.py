#!/usr/bin/env python3
"""Runs benchmarks again and compares what no machine changes: errors, counts and bytes. Times are not looked at.

    bench/check_results.py --build build/release [--update] [NAME...]     (all tables below where none is named)

A table of bench/results is compared row by row with what its program prints now, in the columns of TABLES; `drawings` compares
the charts of docs/media with their tables. --update writes those columns and drawings anew and leaves the times, with the commit
that they were measured at, as they are. Exit status: 0 fresh, 1 stale, 77 a program or gnuplot is missing."""
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
NEAR = 2e-3  # compilers round differently in the last digits of what is summed in double precision


@dataclass
class Table:
    keys: str  # columns that say which row it is
    same: str  # columns that are compared
    cases: tuple = ()  # of `sbfmt chart`; none: bench_NAME
    only: tuple = ()  # (column, value) of the rows that are compared


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
    "chart-drop": Table(CHART_KEYS, CHARTED, cases=("drop",)),
    "chart-beam": Table(CHART_KEYS, CHARTED, cases=("beam",)),
    "chart-pendulum": Table(CHART_KEYS, CHARTED, cases=("pendulum",)),
    "chart-meshes": Table(CHART_KEYS, CHARTED, cases=("cantilever-meshes",)),
}
DRAWINGS = (("chart-meshes", "cantilever-meshes-shape"), ("chart-beam", "beam-amplitude"), ("chart-drop", "drop-volume"),
            ("chart-pendulum", "pendulum-period"))


def skip(message):
    print(f"skipped: {message}")
    sys.exit(SKIPPED)


def path_of(name):
    """The table, of whatever machine it is."""
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


def measure(build, name):
    """The rows that the table's program prints now."""
    table = TABLES[name]
    program = os.path.join(build, "tools", "sbfmt") if table.cases else os.path.join(build, "bench", f"bench_{name}")
    if not os.access(program, os.X_OK):
        skip(f"{program} is not built")
    if not table.cases:
        return list(csv.DictReader(io.StringIO(run([program]))))
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for case in table.cases:
            run([program, "chart", "--no-svg", "--runs", "1", "--most-substeps", "64", "--case", case, "-o", folder])
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
    """Lines that say what is stale; [(row, column, value)] of what would make it fresh."""
    table = TABLES[name]
    key = lambda row: tuple(row[column] for column in table.keys.split())  # noqa: E731
    now = {key(row): row for row in fresh}
    stale, changes = [], []
    for row in kept:
        if row.get("scheme") == "reference" or table.only and row[table.only[0]] != table.only[1]:
            continue
        found = now.pop(key(row), None)
        if found is None:
            if "/" not in row.get("file", ""):  # else of ../shared/data, which is not always there
                stale.append(f"{name}: {' '.join(key(row))} is no longer measured")
            continue
        broken = row.get("outcome", "sound") != "sound" and row["outcome"] == found["outcome"]
        for column in ("elements",) if broken else table.same.split():  # how far off what breaks is says nothing
            if not is_same(row[column], found[column]):
                stale.append(f"{name}: {' '.join(key(row))}: {column} is {found[column]}, not {row[column]}")
                changes.append((row, column, found[column]))
    for left, row in now.items():
        if row.get("scheme") != "reference" and not (table.only and row[table.only[0]] != table.only[1]):
            stale.append(f"{name}: {' '.join(left)} is measured and not in the table: run ./run bench {name}")
    return stale, changes


def write_rows(path, columns, rows, changed):
    """Lines of rows that did not change stay as they were."""
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
    """The drawing's text without what differs from one gnuplot to the next."""
    return re.sub(r"<desc>.*?</desc>|gnuplot_plot_\d+\w*|gnuplot [\d.]+ \w+ \d+", "", drawing, flags=re.DOTALL)


def check_drawings(build, update):
    program = os.path.join(build, "tools", "sbfmt")
    if not (shutil.which("gnuplot") and os.access(program, os.X_OK)):
        skip("gnuplot is not installed, or sbfmt is not built")
    stale = []
    with tempfile.TemporaryDirectory() as folder:
        for table, drawing in DRAWINGS:
            run([program, "chart", "--redraw", path_of(table), "-o", folder])
            with open(os.path.join(folder, drawing + ".svg"), encoding="utf-8") as fresh, \
                    open(os.path.join(MEDIA, table + ".svg"), encoding="utf-8") as kept:
                if without_times(fresh.read()) != without_times(kept.read()):
                    stale.append(f"docs/media/{table}.svg is not what {table}.csv says")
                    if update:
                        shutil.copy(os.path.join(folder, drawing + ".svg"), os.path.join(MEDIA, table + ".svg"))
    return stale


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--build", required=True)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("names", nargs="*")
    asked = parser.parse_args()
    names = asked.names or [*TABLES, "drawings"]
    unknown = [name for name in names if name not in TABLES and name != "drawings"]
    if unknown:
        parser.error(f"no table {unknown[0]}; there are: {', '.join([*TABLES, 'drawings'])}")
    stale = []
    for name in names:
        found = check_drawings(asked.build, asked.update) if name == "drawings" else check_table(asked.build, name, asked.update)
        print(f"{name}: {len(found)} stale" if found else f"{name}: fresh", flush=True)
        stale += found
    if stale and not asked.update:
        print(*stale[:40], sep="\n")
        print("bench/check_results.py --build BUILD --update, then bench/write_tables.py, write them anew; ./run bench measures the times")
        sys.exit(1)


if __name__ == "__main__":
    main()
