#!/usr/bin/env python3
"""Other engines beside ours (bench/bench_peers.py): each is given the same case, measures finite numbers, and a case that is not the
same is refused. Skipped where npm cannot fetch the other engines."""
import csv
import math
import os
import subprocess
import sys
import tempfile

import web_files

BENCH = os.path.join(web_files.SOURCE, "bench", "bench_peers.py")
EXPECTED = {("beam", name) for name in ("sbfmt", "Jolt", "MuJoCo", "Bullet", "Rapier")}
EXPECTED |= {(case, name) for case in ("spin", "pendulum", "chain") for _, name in EXPECTED}
FILLED = {"beam": "us_per_simulated_second error_own error_continuum least_volume",
          "spin": "us_per_simulated_second error_own error_continuum energy_drift momentum_drift least_volume",
          "pendulum": "us_per_simulated_second error_own error_continuum energy_drift joint_gap_m",
          "chain": "us_per_simulated_second error_own joint_gap_m"}
EXPLODES = {("chain", "Jolt"), ("chain", "Bullet")}  # at their defaults
OTHER_CASE = """
import engine from './engine_sbfmt.mjs';
import { CASES } from './cases.mjs';
import { checkHung, checkSoft } from './setup.mjs';
const stiffer = { ...engine, soft: (body, setting) => engine.soft({ ...body, young: 1.001 * body.young }, setting) };
const heavier = { ...engine, soft: (body, setting) => engine.soft({ ...body, density: 1.001 * body.density }, setting) };
const heavierLinks = (hung) => ({ ...hung, links: hung.links.map((link) => ({ ...link, mass: 1.001 * link.mass })) });
const hung = { ...engine, chain: (chain, setting) => engine.chain(heavierLinks(chain), setting) };
for (const [check, what] of [[() => checkSoft(stiffer, 1), 'the sag'], [() => checkSoft(heavier, 1), 'the mass'],
  [() => checkHung(hung, CASES.pendulum()), 'the mass']])
  try {
    check();
    console.log(`${what}: passed`);
  } catch (error) {
    if (!error.message.startsWith(`sbfmt: ${what}`)) console.log(error.message);
  }
"""


def faults_of(row):
    """What of a row of recommended settings is empty, or no number."""
    if row["note"] == "it has no soft bodies":
        return [] if row["engine"] == "Rapier" and not row["us_per_simulated_second"] else ["it says that it has no soft bodies"]
    if row["exploded_at_frame"]:
        return [] if (row["case"], row["engine"]) in EXPLODES else [f"exploded at frame {row['exploded_at_frame']}"]
    return [f"{name} is '{row[name]}'" for name in FILLED[row["case"]].split() if not row[name] or not math.isfinite(float(row[name]))]


def main():
    web_files.need("node", "npm")
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, "-B", BENCH, "--quick", "--folder", folder], capture_output=True, text=True, check=False)
        if done.returncode:
            print(done.stdout + done.stderr)
            sys.exit(done.returncode)
        rows = list(csv.DictReader(done.stdout.splitlines()))
        faults = [f"{row['engine']}, {row['case']}: {fault}" for row in rows for fault in faults_of(row)]
        found = {(row["case"], row["engine"]) for row in rows}
        faults += [f"{engine}, {case}: no row" for case, engine in sorted(EXPECTED - found)]
        web_files.write(folder, "other_case.mjs", OTHER_CASE)
        faults += web_files.run("node", "other_case.mjs", cwd=folder, env={**os.environ, "SBFMT": web_files.SBFMT}).splitlines()
    if faults:
        sys.exit("\n".join(faults))


if __name__ == "__main__":
    main()
