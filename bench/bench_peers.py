#!/usr/bin/env python3
"""Runs the same cases in sbfmt and other engines, all as WebAssembly from npm under node (bench/peers). Prints CSV.

    SBFMT_BUILD_DIR=build/release python3 -B bench/bench_peers.py [--quick] [--folder FOLDER] [ENGINE...]

Engines: sbfmt, jolt, mujoco, bullet, rapier; all if none is named. The packages are installed in FOLDER (out/bench/peers), in the
versions of bench/peers/package.json. --quick measures each engine's recommended settings once and tests its setup. Exits 1 if the
engines do not get the same case, 77 if node is missing or npm cannot fetch the packages."""
import argparse
import csv
import datetime
import os
import re
import shutil
import subprocess
import sys

FOLDER = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(FOLDER)
sys.path.insert(0, os.path.join(ROOT, "tests", "web"))
import web_files  # noqa: E402

ENGINES = ("sbfmt", "jolt", "mujoco", "bullet", "rapier")


def install(folder):
    """The programs, beside the packages that they import."""
    os.makedirs(folder, exist_ok=True)
    for name in os.listdir(os.path.join(FOLDER, "peers")):
        shutil.copy(os.path.join(FOLDER, "peers", name), folder)
    done = web_files.npm(folder, "install", "--omit=peer", "--prefer-offline")
    if done.returncode != 0:
        web_files.skip("npm could not fetch the other engines: " + (done.stderr.strip().splitlines() or ["?"])[-1])
    done = web_files.npm(folder, "install", "--offline", "--omit=peer", "--no-save", web_files.tarball())
    if done.returncode != 0:
        sys.exit("npm install: " + done.stderr[-2000:])


def circumstances():
    """The columns that write_tables.py prints above a table."""
    with open("/proc/cpuinfo", encoding="ascii") as file:
        processor = re.search(r"^model name\s*: (.*)$", file.read(), re.MULTILINE).group(1)
    commit = web_files.run("git", "-C", FOLDER, "rev-parse", "--short=9", "HEAD").strip()
    return {"processor": processor, "compiler": "node " + web_files.run("node", "--version").strip(), "commit": commit,
            "date": datetime.date.today().isoformat()}


def measured(engine, folder, quick):
    done = subprocess.run(["node", "peers.mjs", engine, *(["--quick"] if quick else [])], cwd=folder, capture_output=True, text=True,
                          check=False, env={**os.environ, "SBFMT": web_files.SBFMT})
    if done.returncode != 0:
        sys.exit(f"{engine}: {done.stderr[-2000:]}")
    return list(csv.DictReader(done.stdout.splitlines()))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--folder", default=os.path.join(ROOT, "out", "bench", "peers"))
    parser.add_argument("engines", nargs="*", metavar="ENGINE", help=", ".join(ENGINES))
    arguments = parser.parse_args()
    unknown = [name for name in arguments.engines if name not in ENGINES]
    if unknown:
        parser.error(f"no engine {unknown[0]}; there are: {', '.join(ENGINES)}")
    web_files.need("node", "npm")
    install(arguments.folder)
    here, table = circumstances(), None
    for engine in arguments.engines or ENGINES:
        for row in measured(engine, arguments.folder, arguments.quick):
            if not table:
                table = csv.DictWriter(sys.stdout, [*row, *here], lineterminator="\n")
                table.writeheader()
            table.writerow({**row, **here})
        sys.stdout.flush()


if __name__ == "__main__":
    main()
