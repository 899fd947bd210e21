#!/usr/bin/env python3
"""Converts rigged characters without manual edits and drives each: on flat ground, uneven ground, through water or air.

    ./run zoo
    SBFMT_BUILD_DIR=build/release python3 -B bench/zoo.py [-o DIR] [--seconds S] [--jobs N] [--convert OPTIONS] [FILE|FOLDER ...]

Default files: examples/ and, if it exists, ../shared/zoo. Writes the bundles, DIR/zoo.csv (default out/zoo) with a row per character,
and DIR/sheet.png with a picture of each in the order of the rows. A table truth.tsv in a folder (columns file, kind and legs) has the
expected results. Prints the figures that docs/converting.md promises. Exit status 1 if a file was not converted, a run is not valid
or a kind is wrong."""
import argparse
import concurrent.futures
import csv
import glob
import json
import os
import shlex
import shutil
import statistics
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SBFMT = os.path.join(os.environ.get("SBFMT_BUILD_DIR", os.path.join(ROOT, "build", "release")), "tools", "sbfmt")
ZOO = os.path.join(ROOT, os.pardir, "shared", "zoo")
MEDIA = ("swim", "fly")
LEGS_A_SECOND, SIZES_A_SECOND = 1.0, 0.5  # target speeds: with legs by their length, else by the largest extent
COLUMNS = ("file", "kind", "true_kind", "legs", "true_legs", "bodies", "elements", "substeps", "visits", "us_per_frame", "convert_s",
           "size_m", "volume_least", "max_strain", "seam_gap_mm_per_m", "slip_mm", "distance_share", "uneven_volume_least",
           "uneven_max_strain", "uneven_distance_share", "valid", "note")


def program(*arguments):
    return subprocess.run([SBFMT, *map(str, arguments)], capture_output=True, text=True, check=False)


def inputs_of(paths):
    for path in paths:
        if os.path.isdir(path):
            yield from sorted(glob.glob(os.path.join(path, "**", "*.glb"), recursive=True))
        else:
            yield path


def truth_of(paths):
    """File name -> its row in a truth.tsv of one of the folders."""
    truth = {}
    for path in paths:
        table = os.path.join(path, "truth.tsv")
        if os.path.isfile(table):
            with open(table, encoding="utf-8", newline="") as file:
                truth.update({os.path.realpath(os.path.join(path, row["file"])): row for row in csv.DictReader(file, delimiter="\t")})
    return truth


def wanted_speed(report, size, legs):
    return LEGS_A_SECOND * report["leg_length"] if legs and report.get("leg_length") else SIZES_A_SECOND * size


def drive(path, speed, seconds, ground):
    made = program("run", path, "--seconds", seconds, "--drive", f"{speed:.6g},0", "--ground", ground, "--format", "json")
    if made.returncode or not made.stdout:
        raise RuntimeError(made.stderr.strip().splitlines()[-1] if made.stderr.strip() else f"run ended with {made.returncode}")
    return json.loads(made.stdout)


def measure(path, truth, seconds):
    """The row of a bundle."""
    info = json.loads(program("info", path, "--format", "json").stdout)
    size = max(high - low for low, high in zip(info["bounds"]["min"], info["bounds"]["max"]))
    gait = info.get("gait") or {}
    kind, legs = gait.get("kind", "none"), gait.get("legs", 0)
    levels = [section["levels"][0] for section in info["sections"] if section["levels"]]
    elements = sum(level["tetrahedra"] or level["springs"] for level in levels)
    row = {"kind": kind, "legs": legs, "bodies": len(levels), "elements": elements, "size_m": f"{size:.4g}", "valid": "yes"}
    if truth:
        row.update(true_kind=truth["kind"], true_legs=truth.get("legs", ""))
    speed = 0 if kind == "none" else wanted_speed(drive(path, 0, 0, "flat"), size, legs)
    flat = drive(path, speed, seconds, "flat")
    row.update(substeps=flat["substeps"], visits=elements * flat["substeps"], us_per_frame=f"{flat['us_per_frame']:.1f}",
               volume_least=f"{flat['volume_ratio_least']:.4f}", max_strain=f"{flat['max_strain']:.3f}",
               seam_gap_mm_per_m=f"{1e3 * flat.get('seam_gap', 0) / size:.4f}", slip_mm=f"{1e3 * flat.get('stance_slip', 0):.3f}")
    reports = [flat]
    if speed:
        row["distance_share"] = f"{flat.get('distance', 0) / (speed * seconds):.3f}"
    if speed and kind not in MEDIA:
        uneven = drive(path, speed, seconds, f"noise:{0.05 * size:.6g},3")
        row.update(uneven_volume_least=f"{uneven['volume_ratio_least']:.4f}", uneven_max_strain=f"{uneven['max_strain']:.3f}",
                   uneven_distance_share=f"{uneven.get('distance', 0) / (speed * seconds):.3f}")
        reports.append(uneven)
    if not all(report["valid"] for report in reports):
        row["valid"] = "no"
    return row, speed


def visit(source, path, picture, truth, seconds):
    row = {"file": os.path.basename(source)}
    if not os.path.exists(path):
        return {**row, "valid": "no", "note": "not converted"}
    try:
        found, speed = measure(path, truth, seconds)
    except (RuntimeError, ValueError) as error:
        return {**row, "valid": "no", "note": str(error)}
    program("render", path, "-o", picture, "--seconds", min(seconds, 2), "--drive", f"{speed:.6g},0.1", "--size", "320x240")
    return {**row, **found}


def make_sheet(pictures, path):
    """Makes one picture of all, eight in a row."""
    drawn = [picture for picture in pictures if os.path.exists(picture)]
    if not drawn or not shutil.which("ffmpeg"):
        return False
    listed = path + ".txt"
    with open(listed, "w", encoding="utf-8") as file:
        file.writelines(f"file '{os.path.abspath(picture)}'\nduration 1\n" for picture in drawn)
    rows = -(-len(drawn) // 8)
    made = subprocess.run(["ffmpeg", "-v", "error", "-y", "-f", "concat", "-safe", "0", "-i", listed, "-vf", f"tile=8x{rows}",
                           "-frames:v", "1", path], check=False)
    os.remove(listed)
    return made.returncode == 0


def times_of(folder):
    """File name -> seconds that its conversion took."""
    table = os.path.join(folder, "summary.tsv")
    if not os.path.isfile(table):
        return {}
    with open(table, encoding="utf-8", newline="") as file:
        return {row["file"]: row["seconds"] for row in csv.DictReader(file, delimiter="\t")}


def count_of(rows, good):
    return f"{sum(map(good, rows))} of {len(rows)}"


def conclude(rows):
    """Prints the figures and returns whether nothing failed."""
    checked = [row for row in rows if row.get("true_kind")]
    moved = [row for row in rows if row.get("distance_share")]
    measured = [row for row in rows if row.get("volume_least")]
    wrong = [row["file"] for row in checked if row["kind"] != row["true_kind"]]
    print(f"valid                        {count_of(rows, lambda r: r['valid'] == 'yes')}")
    print(f"kind as stated               {len(checked) - len(wrong)} of {len(checked)}{': not ' + ', '.join(wrong) if wrong else ''}")
    print(f"volume at least 0.9          {count_of(measured, lambda r: float(r['volume_least']) >= 0.9)}")
    print(f"strain at most 0.5           {count_of(measured, lambda r: float(r['max_strain']) <= 0.5)}")
    print(f"seam at most 0.1 mm per m    {count_of(measured, lambda r: float(r['seam_gap_mm_per_m']) <= 0.1)}")
    print(f"80 % of the wanted distance  {count_of(moved, lambda r: float(r['distance_share']) >= 0.8)}")
    if measured:
        times = [float(row["us_per_frame"]) for row in measured]
        print(f"time a frame                 {statistics.median(times):.0f} us (median), {max(times):.0f} us (most)")
        visits = [row["visits"] for row in measured]
        print(f"element visits a tick        {statistics.median(visits):.0f} (median), {max(visits)} (most)")
        print(f"substeps                     {max(row['substeps'] for row in measured)} (most)")
    seconds = [float(row["convert_s"]) for row in rows if row.get("convert_s")]
    if seconds:
        print(f"conversion                   {statistics.median(seconds):.2f} s (median), {max(seconds):.2f} s (most)")
    return not wrong and all(row["valid"] == "yes" for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("paths", nargs="*", metavar="FILE|FOLDER")
    parser.add_argument("-o", dest="out", default=os.path.join("out", "zoo"), metavar="DIR")
    parser.add_argument("--seconds", type=float, default=6)
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="at once; times a frame are true with one")
    parser.add_argument("--convert", default="", metavar="OPTIONS", help="for every conversion, in one word")
    arguments = parser.parse_args()
    paths = arguments.paths or [os.path.join(ROOT, "examples"), *([ZOO] if os.path.isdir(ZOO) else [])]
    sources, truth = list(inputs_of(paths)), truth_of(paths)
    if not sources:
        sys.exit("zoo: no .glb file there: name files, or folders that hold some")
    os.makedirs(arguments.out, exist_ok=True)
    # Files in two folders may have the same name, so each folder gets its own output folder.
    folders = {}
    for source in sources:
        folders.setdefault(os.path.dirname(os.path.realpath(source)), []).append(source)
    jobs, seconds = [], {}
    for folder, files in folders.items():
        out = os.path.join(arguments.out, os.path.relpath(folder, os.path.commonpath([*folders, os.path.dirname(folder)])).replace(os.sep, "."))
        made = program("convert", *files, "--out-dir", out, "--jobs", arguments.jobs, *shlex.split(arguments.convert))
        if made.returncode:
            print(f"{os.path.basename(folder)}: convert ended with {made.returncode}", file=sys.stderr)
        took = times_of(out)
        for source in files:
            seconds[source] = took.get(os.path.basename(source), "")
            path = os.path.join(out, os.path.splitext(os.path.basename(source))[0])
            jobs.append((source, path + ".sbf", path + ".png", truth.get(os.path.realpath(source)), arguments.seconds))
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        rows = [{**row, "convert_s": seconds[job[0]]} for job, row in zip(jobs, pool.map(lambda job: visit(*job), jobs))]
    with open(os.path.join(arguments.out, "zoo.csv"), "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n", restval="")
        table.writeheader()
        table.writerows(rows)
    sheet = os.path.join(arguments.out, "sheet.png")
    good = conclude(rows)
    print(f"{os.path.join(arguments.out, 'zoo.csv')}{', ' + sheet if make_sheet([job[2] for job in jobs], sheet) else ''}")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
