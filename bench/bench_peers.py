#!/usr/bin/env python3
"""The same cases in other engines and in ours, all as WebAssembly from npm under node: bench/peers. As CSV.

    SBFMT_BUILD_DIR=build/release python3 -B bench/bench_peers.py [--quick] [--folder FOLDER] [ENGINE...]

Engines: sbfmt, jolt, mujoco, bullet, rapier; all where none is named. The packages are installed in FOLDER (out/bench/peers), in the
versions of bench/peers/package.json. --quick measures each engine's recommended settings once: a test that its setup is what it should
be. Exits 1 where an engine was given another case than the others, 77 where node is missing or npm cannot fetch the packages."""
import argparse
import csv
import datetime
import os
import re
import shutil
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
sys.path.insert(0, os.path.join(ROOT, "tests", "web"))
import web_files  # noqa: E402

ENGINES = ("sbfmt", "jolt", "mujoco", "bullet", "rapier")


def install(folder):
    """The programs, beside the packages that they import."""
    os.makedirs(folder, exist_ok=True)
    for name in os.listdir(os.path.join(HERE, "peers")):
        shutil.copy(os.path.join(HERE, "peers", name), folder)
    done = web_files.npm(folder, "install", "--omit=peer", "--prefer-offline")
    if done.returncode != 0:
        web_files.skip("npm could not fetch the other engines: " + (done.stderr.strip().splitlines() or ["?"])[-1])
    done = web_files.npm(folder, "install", "--offline", "--omit=peer", "--no-save", web_files.tarball())
    if done.returncode != 0:
        sys.exit("npm install: " + done.stderr[-2000:])


def circumstances():
    """What write_tables.py puts above a table."""
    with open("/proc/cpuinfo", encoding="ascii") as file:
        processor = re.search(r"^model name\s*: (.*)$", file.read(), re.MULTILINE).group(1)
    commit = web_files.run("git", "-C", HERE, "rev-parse", "--short=9", "HEAD").strip()
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
    asked = parser.parse_args()
    unknown = [name for name in asked.engines if name not in ENGINES]
    if unknown:
        parser.error(f"no engine {unknown[0]}; there are: {', '.join(ENGINES)}")
    web_files.need("node", "npm")
    install(asked.folder)
    here, table = circumstances(), None
    for engine in asked.engines or ENGINES:
        for row in measured(engine, asked.folder, asked.quick):
            if not table:
                table = csv.DictWriter(sys.stdout, [*row, *here], lineterminator="\n")
                table.writeheader()
            table.writerow({**row, **here})
        sys.stdout.flush()


if __name__ == "__main__":
    main()
