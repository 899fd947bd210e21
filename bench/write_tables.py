#!/usr/bin/env python3
"""Writes the tables and figures of bench/README.md and docs/*.md from the results that are committed.

    bench/write_tables.py [--check]      --check reports stale documents and changes nothing

The lines `<!-- table NAME MACHINE -->` and `<!-- end of table -->` enclose a table from bench/results/MACHINE/NAME.csv. The markers
`<!-- figure NAME MACHINE COLUMN KEY=VALUE... -->` and `<!-- end -->` enclose a figure: the column in the row of these keys, or the
smallest to the largest value of several rows. `over=COLUMN KEY=VALUE...` names the row whose value divides it. A figure must not begin
a line, because Markdown ends a paragraph there. New results: ./run bench, then copy out/bench/*.csv there."""
import csv
import math
import os
import re
import shlex
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
DOCUMENTS = ["bench/README.md"] + sorted("docs/" + name for name in os.listdir(os.path.join(ROOT, "docs")) if name.endswith(".md"))
FIGURE = re.compile(r"(<!-- figure ([^>]*?) -->)[^<]*(<!-- end -->)")
BLOCK = re.compile(r"(<!-- table (\w+) ([\w-]+) -->\n).*?(<!-- end of table -->)", re.DOTALL)


def number(text):
    """Three significant digits, or all digits of a whole number, with separators of thousands."""
    if not text or "." not in text:
        return f"{int(text):,}" if text else ""
    value = float(text)
    before = math.floor(math.log10(abs(value))) + 1 if value else 0
    return f"{value:,.{min(max(0, 3 - before), len(text.split('.')[1]))}f}"


def load_row(r):
    form = r["form"] + {"yes": ", CRC checked", "no": ", CRC not checked", "": ""}[r["crc"]]
    if r["reader"] == "sbfmt" and r["form"] == "stored" and r["file"] == "read":
        form += ", copied"
    return [r["asset"], r["reader"], form, number(r["bytes"]), number(r["median_ms"]), number(r["MB/s"]),
            number(r["times_glb"]), number(r["peak_KiB"]), number(r["private_KiB"])]


def save_row(r):
    return [r["asset"], r["action"], r["form"], number(r["bytes"]) if r["bytes"] != "0" else "", number(r["median_ms"]), number(r["MB/s"])]


def run_row(r):
    return [r["character"], r["threads"], r["part"], number(r["springs"]), r["substeps"], number(r["least_us"]),
            number(r["median_us"]), number(r["worst_us"])]


def gait_row(r):
    return [r["character"], r["legs"], r["bones"], r["ground"], r["drive"], number(r["least_us"]), number(r["median_us"]),
            number(r["worst_us"])]


def contacts_row(r):
    return [r["layout"], number(r["boxes"]), number(r["touches"]) if r["touches"] != "0" else "", number(r["tick_us"]), number(r["box_us"]),
            number(r["touches_a_second"]) if r["touches"] != "0" else "", r["slope"] if r["boxes"] != "16" else ""]


def size_row(r):
    return [r["file"], number(r["vertices"]), number(r["springs"]), number(r["xml"]), number(r["gzip"]),
            number(r["packed"]), number(r["stored"]), r["packed/xml"], r["packed/gzip"], number(r["meshes"]),
            number(r["glb"]), r["meshes/glb"]]


def elements_row(r):
    return [r["file"], r["cell_m"], number(r["points"]), number(r["tetrahedra"]), number(r["elements_xml"]),
            number(r["elements_packed"]), r["elements_xml/elements_packed"], number(r["xml"]), number(r["packed"]),
            r["packed/xml"]]


def solids_row(r):
    return [number(r["tetrahedra"]), number(r["points"]), r["substeps"], number(r["frame_us"]), number(r["substep_us"]),
            r["ns_per_element"], r["slope"]]


def progress_row(r):
    return [r["asset"], r["build"], number(r["seconds"]), r["calls"], number(r["longest_silence_s"]), r["after"]]


def skin_row(r):
    return [r["mesh"], r["level"], number(r["triangles"]), number(r["vertices"]), number(r["least_us"]), number(r["median_us"]),
            r["of_full"]]


def skin_weights_row(r):
    return [r["model"], number(r["rms_percent"]), number(r["p95_percent"]), number(r["over_2_percent"]), number(r["wrong_side_percent"]),
            r["gait"], number(r["s"])]


def schemes_row(r):
    return [r["body"], r["scheme"], number(r["springs"]), r["substeps"], number(r["us_per_tick"]),
            r["ns_per_spring"], r["error_mm"]]


def ik_row(r):
    return [r["solver"], r["limits"], r["targets"], r["tolerance_m"], r["passes"], r["us"], f"{float(r['error_mean_m']):.1g}",
            f"{float(r['error_most_m']):.1g}", f"{r['missed']} of {r['of']}"]


def lattice_row(r):
    if not r["tetrahedra"]:
        return [r["surface"], r["by"], "ends with an error"] + 7 * [""]
    return [r["surface"], r["by"], number(r["tetrahedra"]), number(r["median_ms"]), number(r["tetrahedra/s"]), r["least_deg"],
            r["most_deg"], r["volume"], r["farthest_cells"], number(r["peak_KiB"])]


def springs_row(r):
    return [r["body"], r["method"], number(r["points"]), number(r["elements"]), r["leaving"], r["spread"], r["fall"], r["off"],
            r["substeps"]]


def bullet_row(r):
    return [r["body"], number(r["elements"]), r["engine"], r["method"], r["steps"], r["iterations"], r["threads"], number(r["us"]), r["ns"],
            r["error_mm"], r["times"]]


def godot_row(r):
    return [r["engine"], r["precision"], r["stiffness"], r["pressure"], number(r["ms"]), f"{float(r['volume_least']):.3f}",
            f"{float(r['volume_last']):.3f}", number(r["lowest_mm"])]


def crowd_row(r):
    return [r["character"], r["count"], r["threads"], r["instructions"], r["substeps"], number(r["busy_ms"]),
            number(r["wall_ms"]) if r["wall_ms"] else "", r["times_one"], r["ns_per_element"], r["gb_s"]]


def detail_row(r):
    return [r["case"], r["lizards"], number(r["ms_tick"]), r["times_full"], r["rms_px"], r["worst_lizard_px"], r["worst_px"], r["soft"],
            r["coarser"], r["bones"], r["away"], r["returned"], r["mb_most"]]


def page_row(r):
    return [r["scene"], r["with"], number(r["mean_ms"]), number(r["dearest_ms"]), r["ticks_s"], r["dearest_ticks_s"]]


def falls_row(r):
    steps = "as needed" if r["steps"] == "0" else r["steps"]
    return [r["scene"], number(r["elements"]), r["engine"], r["method"], steps, r["iterations"], number(r["fall_us"]), number(r["lie_us"]),
            r["apart_mm"], r["beyond_deg"], r["deep_mm"], r["rest_mm_s"], r["stretch_pct"]]


def knocked_row(r):
    off = [r["bone_mm"], r["flesh_mm"]] if r["steps"] != "64" else ["", ""]
    return ["as needed" if r["steps"] == "0" else r["steps"], f"{float(r['tick_us']) / 1000:.1f}", f"{float(r['walk_us']) / 1000:.1f}", *off]


def thrown_row(r):
    return [r["variant"], r["bend_deg"], "" if r["joints"] == "0" or "without limits" in r["variant"] else r["beyond_deg"], r["sag_mm"], r["swing_mm"], r["given_n_s"],
            r["left_deg"], r["left_mm"], r["one_fps"], r["two_at_once_fps"]]


def character_row(r):
    return [f"{float(r['young_modulus']) / 1000:.0f}", r["elements"], r["substeps"], r["strain"], r["residual"], r["tick_us"],
            r["skin_us"], r["frame_us"], r["worst_us"]]


def short(text, digits=2):
    """That many significant digits, without an exponent."""
    return f"{float(text):.{digits}g}" if text else ""


def peers_row(r):
    exploded = "" if not r["exploded_at_frame"] else f"exploded at frame {r['exploded_at_frame']}"
    setting = r["setting"] + (", recommended" if r["recommended"] else "")
    return [r["case"], r["engine"] + " " + r["version"], setting or r["note"], number(r["us_per_simulated_second"]),
            exploded or short(r["error_own"]), short(r["error_continuum"]), short(r["energy_drift"]), short(r["momentum_drift"]),
            short(r["least_volume"], 3), short(1000 * float(r["joint_gap_m"])) if r["joint_gap_m"] else ""]


TABLES = {
    "lattice": (lattice_row, "surface | by | tetrahedra | ms | tetrahedra/s | min angle | max angle | volume | max distance, cells | "
                             "peak KiB", 2),
    "springs": (springs_row, "body | method | points | elements | outside | spread | displacement | error | substeps", 2),
    "solids": (solids_row, "tetrahedra | points | substeps | frame, µs | substep, µs | ns for each and substep | slope", 0),
    "elements": (elements_row, "file | cell, m | points | tetrahedra | their XML | packed | × smaller | bundle, XML | "
                               "bundle, packed | packed / XML", 1),
    "load": (load_row, "asset | reader | form | bytes | ms | MB/s | × assimp on GLB | peak KiB | private KiB", 3),
    "save": (save_row, "asset | action | form | bytes | ms | MB/s", 3),
    "run": (run_row, "character | threads | part | springs | substeps | min µs | median µs | max µs", 3),
    "progress": (progress_row, "asset | build | s | calls | max interval, s | pass", 2),
    "gait": (gait_row, "character | legs | bones | ground | drive | min µs | median µs | max µs", 1),
    "skin": (skin_row, "mesh | render level | triangles | vertices | min µs | median µs | of the full mesh", 1),
    "skin_weights": (skin_weights_row, "models | rms, % | 95th percentile, % | points over 2 %, % | wrong side, % | gait | s", 1),
    "bullet": (bullet_row, "body | elements | engine | method | steps | iterations | threads | µs a tick | ns | error, mm | "
                           "× ours at that error", 1),
    "godot": (godot_row, "engine | precision | stiffness | pressure | ms a frame | min volume | volume at the end | lowest point, mm", 1),
    "crowd": (crowd_row, "character | count | threads | instructions | substeps | ms a tick | wall, ms | × one thread | ns a tetrahedron "
                         "and substep | GB/s", 1),
    "detail": (detail_row, "levels | lizards | ms a tick | × full detail | RMS, px | of the worst lizard | worst vertex, px | soft "
                           "| of them coarser | bones | away | were away | max MB", 1),
    "page": (page_row, "scene | program | ms a tick | in the slowest half second | ticks a second | there", 2),
    "peers": (peers_row, "case | engine | setting | µs a simulated second | error, own model | error, continuum | energy | angular momentum "
                         "| min volume | gap, mm", 3),
    "falls": (falls_row, "scene | elements | engine | method | steps | iterations | falling, µs | at rest, µs | joint gap, mm | limit violation, degrees "
                         "| penetration, mm | at rest, mm/s | stretch, %", 1),
    "knocked": (knocked_row, "steps | tick, ms | of a walk, ms | bone error, mm | point error, mm", 1),
    "thrown": (thrown_row, "variant | max bend, degrees | limit violation, degrees | shape error at rest, mm | max displacement, mm "
                           "| momentum per ball, N s | bend after 8 s, degrees | shape error then, mm | one, frames/s | two at once", 1),
    "character": (character_row, "E, kPa | tetrahedra | substeps | strain | error against 20,000 | tick, µs | skin, µs | frame, µs | worst", 0),
    "schemes": (schemes_row, "body | scheme | springs | substeps | µs a tick | ns a spring and substep | error, mm", 2),
    "contacts": (contacts_row, "layout | boxes | contacts | tick, µs | a box, µs | contacts/s | slope", 1),
    "ik": (ik_row, "solver | limits | targets | tolerance, m | passes | µs | mean error, m | max error, m | missed", 3),
    "size": (size_row, "file | vertices | springs | XML | gzip of it | packed | stored | packed / XML | "
                       "packed / gzip | meshes | GLB | meshes / GLB", 1),
}


def per_cent(text):
    """Per cent with two significant digits."""
    return f"{100 * float(text):.2g}" if abs(float(text)) >= 5e-6 else "0"


def bias_table(rows):
    """One row per case and model, one column per scheme and substeps. It is the same on every machine."""
    schemes = list(dict.fromkeys((r["scheme"], r["substeps"]) for r in rows))
    names = [scheme + (f", {substeps}" if substeps != "0" else "") for scheme, substeps in schemes]
    lines = [["case", "model"] + [f"`{name}`" for name in names], ["---", "---"] + ["---:"] * len(names)]
    for case, model in dict.fromkeys((r["case"], r["model"]) for r in rows):
        cells = {(r["scheme"], r["substeps"]): r for r in rows if (r["case"], r["model"]) == (case, model)}
        at = [cells.get(scheme) for scheme in schemes]
        lines.append([case, model] + [per_cent(r["bias"]) if r else "" for r in at])
        if case == "swing":
            lines.append(["damping added", model] + [per_cent(r["damping"]) if r else "" for r in at])
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def results(name, machine):
    with open(os.path.join(ROOT, "bench/results", machine, name + ".csv"), newline="") as file:
        return list(csv.DictReader(file))


def values(rows, column, keys):
    """The column's numbers in the rows of these keys."""
    wanted = dict(key.split("=", 1) for key in keys)
    found = [float(row[column]) for row in rows if all(row[key] == value for key, value in wanted.items())]
    if not found:
        sys.exit(f"no row of bench/results has {' '.join(keys)}")
    return found


def two_digits(value):
    """Two significant digits, for sentences."""
    digits = max(0, 1 - math.floor(math.log10(abs(value)))) if value else 0
    return f"{round(value, digits):,.{digits}f}"


def figure(words):
    """The text of a marker's figure."""
    name, machine, column, *keys = shlex.split(words)
    rows = results(name, machine)
    over = next((i for i, key in enumerate(keys) if key.startswith("over=")), len(keys))
    found = values(rows, column, keys[:over])
    if over < len(keys):
        divisor, = values(rows, keys[over][len("over="):], keys[over + 1:])
        found = [value / divisor for value in found]
    low, high = two_digits(min(found)), two_digits(max(found))
    return low if low == high else f"{low} to {high}"


def table(name, machine):
    rows = results(name, machine)
    if name == "bias":
        return bias_table(rows)
    make_row, head, text_columns = TABLES[name]
    columns = head.split(" | ")
    rule = ["---" if i < text_columns else "---:" for i in range(len(columns))]
    lines = [columns, rule] + [make_row(row) for row in rows]
    first = rows[0]
    lanes = f", {first['lanes']} lanes" if name == "run" else ""
    return (f"{first['processor']}, {first['compiler']}{lanes}, commit {first['commit']}, {first['date']}:\n\n"
            + "".join("| " + " | ".join(line) + " |\n" for line in lines))


def main():
    stale, broken = [], []
    for path in DOCUMENTS:
        with open(os.path.join(ROOT, path)) as file:
            text = file.read()
        fresh = BLOCK.sub(lambda match: match[1] + table(match[2], match[3]) + match[4], text)
        fresh = FIGURE.sub(lambda match: match[1] + figure(match[2]) + match[3], fresh)
        broken += [f"{path}:{number}" for number, line in enumerate(text.split("\n"), 1) if line.startswith("<!-- figure")]
        if fresh == text:
            continue
        stale.append(path)
        if "--check" not in sys.argv:
            with open(os.path.join(ROOT, path), "w") as file:
                file.write(fresh)
    if broken:
        sys.exit(f"a figure begins a line, which ends the paragraph: {', '.join(broken)}")
    if stale and "--check" in sys.argv:
        sys.exit(f"not what bench/results says: {', '.join(stale)}; run bench/write_tables.py")
    print(f"tables {'written in' if stale else 'are fresh in'}: {', '.join(stale or DOCUMENTS)}")


if __name__ == "__main__":
    main()
