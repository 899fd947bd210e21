#!/usr/bin/env python3
"""Measures the physics of the page that `sbfmt export -o lizard.html` writes, in Chromium: walking, knocked over, hit by a ball, dragged.
Prints CSV: milliseconds of processor time per tick of 1/60 s, on average and in the slowest half second, and possible ticks per second.

    bench_page.py [--quick]

Also measures the program's own loops on the same walk, with the same and with the largest vector width. --quick measures less: it tests
that every scene runs. Exits 1 if a scene fails, 77 if there is no Chromium."""
import csv
import datetime
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

FOLDER = os.path.dirname(os.path.abspath(__file__))
TESTS = os.path.join(FOLDER, os.pardir, "tests", "web")
sys.path.insert(0, TESTS)
import web_files  # noqa: E402

WALK = ("--drive", "0.3,0", "--ground", "noise:0.1,7")


def processor_s(*command):
    before = os.times().children_user
    subprocess.run(command, check=True, capture_output=True)
    return os.times().children_user - before


def native_ms(path, instructions, seconds, rounds):
    """Time of a tick on a walk: the time of a run minus the time of a run of half a second."""
    command = (web_files.SBFMT, "run", path, *WALK, "--instructions", instructions, "--seconds")
    return min((processor_s(*command, str(seconds + 0.5)) - processor_s(*command, "0.5")) / seconds / 60 * 1e3 for _ in range(rounds))


def first_line(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=FOLDER).stdout.splitlines()[0]


def circumstances():
    """The columns that table() of write_tables.py prints above a table: source, machine and date."""
    clang = next(name for name in ("clang", "clang-19", "clang-16", "clang-14") if shutil.which(name))
    with open("/proc/cpuinfo", encoding="ascii") as file:
        processor = re.search(r"^model name\s*: (.*)$", file.read(), re.MULTILINE).group(1)
    return {"commit": first_line("git", "rev-parse", "--short=9", "HEAD"), "compiler": "clang " + re.search(r"[\d.]+", first_line(clang, "--version")).group(),
            "processor": processor, "date": datetime.date.today().isoformat(), "load": f"{os.getloadavg()[0]:.2f}"}


def main():
    quick = "--quick" in sys.argv[1:]
    web_files.need("node", "npm", "chromium")
    modules = web_files.playwright()
    rows = csv.writer(sys.stdout, lineterminator="\n")
    here = circumstances()
    rows.writerow(("scene", "with", "mean_ms", "dearest_ms", "ticks_s", "dearest_ticks_s", *here))
    with tempfile.TemporaryDirectory() as folder:
        lizard, page = web_files.bundles(folder)["lizard"], os.path.join(folder, "lizard.html")
        web_files.run(web_files.SBFMT, "export", lizard, "-o", page)
        found = json.loads(web_files.run("node", os.path.join(FOLDER, "page_scenes.mjs"), os.path.join(TESTS, "chromium.mjs"), modules, page,
                                         "4" if quick else "12").splitlines()[-1])
        for scene, cost in found["scenes"].items():
            rows.writerow((scene, f"Chromium {found['browser']}", f"{cost['mean']:.2f}", f"{cost['most']:.2f}", round(1000 / cost["mean"]),
                           round(1000 / cost["most"]), *here.values()))
        for instructions in () if quick else ("sse2", "automatic"):
            took = native_ms(lizard, instructions, 4, 3)
            rows.writerow(("walks", f"sbfmt run, {instructions}", f"{took:.2f}", "", round(1000 / took), "", *here.values()))
    if found["faults"]:
        sys.exit("\n".join(found["faults"]))


if __name__ == "__main__":
    main()
