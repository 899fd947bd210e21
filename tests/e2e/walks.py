"""Walks for evaluating characters: speed x ground x command, the measurements of `run`, and their limits.

As a program it measures every walk of the files it is given and writes the tables of bench/results/any-machine/walks.md:

    python3 tests/e2e/walks.py example.sbf [MORE.sbf ...]
"""

import collections
import concurrent.futures
import json
import os
import sys
import tempfile

from sbfmt_program import call

# Asked for: slip per stance <= 2 mm and 0.5 % of the leg, penetration <= 1 mm, no skating, a knee's turn in a frame
# of 1/60 s changes by <= 5 degrees in the next, no opposite feet in the air, balance when slow, limits kept.
SLIP_M, SLIP_SHARE, PENETRATION_M, KNEE_DEGREES, LIMIT_DEGREES = 0.002, 0.005, 0.001, 5.0, 0.02
# The hips move and turn without a break: changes from one frame to the next, in leg lengths and degrees a frame.
BODY_SHARE, BODY_DEGREES = 0.025, 1.5
SLOW = 0.3  # leg lengths a second: so slow, a character is balanced all the time

SPEEDS = (0.1, 0.3, 0.5, 1, 2, 3)

# `script`: lines of (second, forward, turn, sideways), speeds in leg lengths a second.
Walk = collections.namedtuple("Walk", "name script ground slow seconds")


def ground_of(kind, leg):
    return {"flat": "flat", "slope of 20°": "slope:20", "slope of 20° down": "slope:-20",
            "stairs of a quarter leg": f"stairs:{leg / 4},{1.5 * leg}", "noise": f"noise:{0.3 * leg},3"}[kind]


def straight(kind, speed):
    return Walk(f"{kind}, {speed}", [(0, speed, 0, 0)], kind, speed <= SLOW, 9 if speed < 0.3 else 6)


def commands(kind):
    return [
        Walk(f"{kind}, backward 0.5", [(0, -0.5, 0, 0)], kind, False, 5),
        Walk(f"{kind}, sideways 0.4", [(0, 0, 0, 0.4)], kind, False, 5),
        Walk(f"{kind}, turning on the spot", [(0, 0, 1.5, 0)], kind, False, 5),
        Walk(f"{kind}, a curve", [(0, 1, 1, 0)], kind, False, 5),
        Walk(f"{kind}, starting, stopping, aside", [(0.5, 1, 0, 0), (2, 0, 0, 0), (3.5, 0, 0, 0.4)], kind, False, 6),
        Walk(f"{kind}, forward, then back", [(0.5, 1, 0, 0), (2, -1, 0, 0), (3.5, 0, 1, 0)], kind, False, 6),
    ]


def all_walks():
    walks = []
    for kind in ("flat", "slope of 20°", "stairs of a quarter leg", "noise"):
        walks += [straight(kind, speed) for speed in SPEEDS]
        walks += commands(kind)
    return walks


def leg_of(path):
    return json.loads(call("run", path, "--seconds", "0", "--format", "json").out)["leg_length"]


def measure(path, walk, leg, *more):
    """The report of a run. Raises an error with the program's output if it fails."""
    lines = "".join(f"{at} drive {forward * leg} {turn} {aside * leg}\n" for at, forward, turn, aside in walk.script)
    with tempfile.NamedTemporaryFile("w", suffix=".txt") as script:
        script.write(lines)
        script.flush()
        result = call("run", path, "--seconds", walk.seconds, "--script", script.name, "--ground",
                      ground_of(walk.ground, leg), "--format", "json", *more)
    if result.status != 0:
        raise AssertionError(f"{walk.name}: {result.err}")
    return json.loads(result.out)


def failures(report, walk, leg, bounds=None):
    """Criteria that a walk's measures do not meet, as texts. `bounds` replaces some bounds."""
    maximum = {"stance_slip": min(SLIP_M, SLIP_SHARE * leg), "penetration": PENETRATION_M, "skate_ratio": 0,
            "knee_speed_step": KNEE_DEGREES, "opposite_feet_in_air": 0, "limit_excess": LIMIT_DEGREES,
            "body_speed_step": BODY_SHARE * leg, "body_turn_step": BODY_DEGREES, **(bounds or {})}
    balance = maximum.pop("support_margin", 0)
    missed = [f"{walk.name}: {key} {report[key]:.6g}, at most {bound:.6g}" for key, bound in maximum.items()
              if report[key] > bound]
    if walk.slow and report.get("support_margin", 0) < balance:
        missed.append(f"{walk.name}: support_margin {report['support_margin']:.6g}, at least {balance:.6g}")
    return missed + ([] if report["valid"] else [f"{walk.name}: not valid"])


def mean(report, key):
    legs = report["rhythm"].values()
    return sum(leg[key] for leg in legs) / len(legs) if legs else 0


def write_table(path):
    leg = leg_of(path)
    walks = all_walks()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        reports = list(pool.map(lambda walk: measure(path, walk, leg), walks))
    print(f"`{os.path.basename(path)}`, legs of {leg:.2f} m:\n")
    print("| walk | slip, mm | penetration, mm | skating | knee step | opposite feet | margin, % of leg | limit excess "
          "| body step, % of leg | speed | duty | stride, legs |")
    print("|---|" + "---:|" * 11)
    missed = 0
    for walk, r in zip(walks, reports):
        bad = {text.split(": ")[1].split()[0] for text in failures(r, walk, leg)}
        missed += bool(bad)

        def cell(key, text, bad=bad):
            return f"**{text}**" if key in bad else text
        cells = [walk.name, cell("stance_slip", f"{1e3 * r['stance_slip']:.2f}"),
                 cell("penetration", f"{1e3 * r['penetration']:.2f}"), cell("skate_ratio", f"{r['skate_ratio']:.4g}"),
                 cell("knee_speed_step", f"{r['knee_speed_step']:.1f}°"),
                 cell("opposite_feet_in_air", str(r["opposite_feet_in_air"])),
                 cell("support_margin", f"{100 * r.get('support_margin', 0) / leg:.1f}"),
                 cell("limit_excess", f"{r['limit_excess']:.2f}°"),
                 cell("body_speed_step", f"{100 * r['body_speed_step'] / leg:.2f}"),
                 f"{r['distance'] / leg / walk.seconds:.2f}", f"{mean(r, 'duty'):.2f}", f"{mean(r, 'stride') / leg:.2f}"]
        print("| " + " | ".join(cells) + " |")
    print(f"\n{len(walks) - missed} of {len(walks)} walks meet all bounds.\n")


if __name__ == "__main__":
    for file in sys.argv[1:]:
        write_table(file)
