#!/usr/bin/env python3
"""Measures how well an OBJ gets the weights of a rig with a mesh. Case b: the same mesh, matched by position. Case c: a similar mesh.
Case d: a rig without a mesh. Case p: limbs in another pose. Case bones: a rig without a mesh, limbs in another pose.

Every rigged file is exported as OBJ, changed as other programs would write it (tests/e2e/obj_variants.py), and converted with the file
as its rig. The file's own conversion is the reference. Prints CSV. The targets:

    case b   weights equal within 1e-3 at >= 99.9 % of points; the same gait and legs; the distance walked in 4 s
             within 2 %; conversion in at most 1.3 times the time of the original. same_bundle: as many sections,
             and springs and tetrahedra within 5 %
    case c   the skin, posed by the original's own walk, within 1 % of the longest side of the original's at 99 % of
             points; another line for the poses of its clips, which bend farther
    case d   the skin, posed by its clips, against the original's, in % of the longest side: rms <= 0.6 (median of files),
             <= 1.2 (nine tenths); points over 2 %: median <= 2 %; the same gait and legs in 95 %

    ./run bench rigging
    SBFMT_BUILD_DIR=build/release python3 -B bench/bench_rigging.py [b] [c] [d] [p] [bones] [FILE.glb ...]
"""

import glob
import os
import resource
import statistics
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(ROOT, "tests", "e2e"))

import json  # noqa: E402

import obj_variants as variants  # noqa: E402
import posed_inputs  # noqa: E402
from rigged_weights import Original, clip_motions, posed_errors, equal_fraction, walk_motions  # noqa: E402
from sbfmt_program import call  # noqa: E402

Z_UP = ("x", "-z", "y")
MAX_RUNS, ENOUGH_S = 7, 3


def same_meshes(obj):
    yield "centimetres; Z up; 6 decimals", variants.moved(obj, 0.01, Z_UP), 6
    yield "inches; shuffled; triangles", variants.triangulated(variants.shuffled(variants.moved(obj, 0.0254))), 6
    yield "mirrored; elsewhere", variants.moved(obj, 1, ("-x", "y", "z"), (5, 1, -2)), None
    yield "odd unit; one object; merged", variants.moved(variants.merged(variants.one_object(obj)), 0.0371), None
    yield "objects by material", variants.by_material(obj), 6
    names = sorted({name for name, _, _ in obj.faces})
    if len(names) > 1:
        yield "one object of several", variants.moved(variants.only(obj, lambda n: n == names[0]), 0.01, Z_UP), 6


def like_meshes(obj):
    yield "a third of points moved by 1 %", variants.jiggled(obj)
    yield "subdivided once", variants.subdivided(obj)
    yield "simplified to half", variants.simplified(obj)


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def convert(path, rig, out, *options):
    """Converts and returns processor seconds. Other work on the machine affects them less than elapsed seconds."""
    start = processor_seconds()
    made = call("convert", path, *(["--rig", rig] if rig else []), *options, "-o", out)
    if made.status:
        raise RuntimeError(made.err.strip().splitlines()[-1])
    return processor_seconds() - start


def time_against(original, source, out):
    """Conversion time of an OBJ with the original as its rig, divided by that of the original. Each is the minimum of several
    alternating runs, because single runs of a tenth of a second vary."""
    seconds = ([], [])
    while len(seconds[0]) < 2 or (len(seconds[0]) < MAX_RUNS and sum(map(sum, seconds)) < ENOUGH_S):
        seconds[0].append(convert(original.path, None, out))
        seconds[1].append(convert(source, original.path, out))
    return min(seconds[1]) / min(seconds[0])


def described(path):
    info = json.loads(call("info", path, "--format", "json").out)
    walk = call("run", path, "--seconds", 4, "--drive", "0.4,0", "--format", "json")
    distance = json.loads(walk.out).get("distance", 0) if walk.status == 0 and walk.out else 0
    return info["gait"], distance, len(info["sections"]), sum(info["springs"].values()) + info["tetrahedra"]


def are_similar(found, wanted):
    """Whether two bundles have as many sections and about as many elements."""
    return found[2] == wanted[2] and abs(found[3] - wanted[3]) <= 0.05 * wanted[3]


def measure_same(original, folder, rows):
    source, out = os.path.join(folder, "in.obj"), os.path.join(folder, "out.sbf")
    whole = os.path.join(folder, "whole.sbf")
    convert(original.path, None, whole)
    wanted = described(whole)
    gait, distance = wanted[:2]
    for name, obj, digits in same_meshes(original.obj):
        variants.write(obj, source, digits)
        try:
            time = time_against(original, source, out)
            found = described(out)
            fraction = equal_fraction(original, obj, out)
        except RuntimeError as error:
            print(f"b,{original.name},{name},{len(obj.points)},0,,,,,,,{error}".replace("\n", " "), flush=True)
            rows.append((0, False, 0, 0, False))
            continue
        walked = found[1] / distance if distance else 1.0
        part = name.startswith("one object of")
        same = part or found[0] == gait
        similar = are_similar(found, wanted)
        rows.append((fraction, same, walked if not part else 1.0, time, similar))
        print(f"b,{original.name},{name},{len(obj.points)},{100 * fraction:.2f},{'yes' if same else 'no'},"
              f"{walked:.3f},{time:.2f},{'yes' if similar else 'no'},,,", flush=True)


def measure_like(original, folder, rows):
    source, out = os.path.join(folder, "in.obj"), os.path.join(folder, "out.sbf")
    walk, clips = walk_motions(os.path.join(folder, "whole.sbf"), folder), clip_motions(original.bundle, 1, 2)
    for name, obj in like_meshes(original.obj):
        obj = variants.moved(obj, 0.01, Z_UP)
        variants.write(obj, source, 6)
        try:
            convert(source, original.path, out, "--no-build")
        except RuntimeError as error:
            print(f"c,{original.name},{name},{len(obj.points)},,,,,,,,{error}", flush=True)
            rows.append((1.0, 1.0))
            continue
        walked, posed = (percentile(posed_errors(original, obj, out, motions)) for motions in (walk, clips))
        rows.append((walked, posed))
        print(f"c,{original.name},{name},{len(obj.points)},,,,,,{100 * walked:.3f},{100 * posed:.3f},", flush=True)


def bare_meshes(obj):
    yield "as exported", obj, None
    yield "centimetres; Z up; 6 decimals", variants.moved(obj, 0.01, Z_UP), 6
    yield "inches; faces +X; elsewhere; shuffled", variants.shuffled(variants.moved(obj, 0.0254, ("z", "y", "-x"), (60, 5, -90))), 6


def measure_bare(original, folder, rows):
    """Weights computed from the bones alone."""
    source, out, rig = (os.path.join(folder, name) for name in ("in.obj", "out.sbf", "bones.glb"))
    posed_inputs.write_rest_bones(original.bundle, rig)
    stems = {posed_inputs.side_of(name)[0] for name in original.bone_names}
    motions = posed_inputs.motions_to_compare(original, {stem: ("x", 15) for stem in stems})
    gait = json.loads(call("info", os.path.join(folder, "whole.sbf"), "--format", "json").out)["gait"]
    for name, obj, digits in bare_meshes(original.obj):
        variants.write(obj, source, digits)
        start = f"d,{original.name},{name},{len(obj.points)}"
        try:
            time = convert(source, rig, out, "--no-build", "--budget", "none")
        except RuntimeError as error:
            print(f"{start},,,,,,,,{error}".replace("\n", " "), flush=True)
            rows.append((1.0, 1.0, False))
            continue
        errors = posed_inputs.skin_errors(original, obj, out, motions)
        rms = (sum(e * e for e in errors) / max(len(errors), 1)) ** 0.5
        over = sum(e > 0.02 for e in errors) / max(len(errors), 1)
        same = json.loads(call("info", out, "--format", "json").out)["gait"] == gait
        rows.append((rms, over, same))
        print(f"{start},,{'yes' if same else 'no'},,{time:.2f},,{100 * rms:.3f},{100 * over:.2f},", flush=True)


def print_bare(rows):
    rms, over = (sorted(row[k] for row in rows) for k in range(2))
    print(f"# d: rms median {100 * statistics.median(rms):.2f} %, nine tenths {100 * rms[int(0.9 * len(rms))]:.2f} %; points over 2 %, "
          f"median {100 * statistics.median(over):.2f} %; the same gait and legs in {sum(row[2] for row in rows)} of {len(rows)}")


def posed_meshes(original, turns):
    obj, motions = posed_inputs.pose_of(original, turns)
    yield "posed", obj, motions
    yield "posed; simplified to half", variants.simplified(obj), motions


def measure_posed(original, turns, case, folder, rows):
    source, out, rig = os.path.join(folder, "in.obj"), os.path.join(folder, "out.sbf"), original.path
    if case == "bones":
        rig = os.path.join(folder, "bones.glb")
        posed_inputs.write_bones(original.path, rig)
    compared = posed_inputs.motions_to_compare(original, turns)
    for name, obj, motions in posed_meshes(original, turns):
        variants.write(variants.moved(obj, 0.01, Z_UP), source, 6)
        start = f"{case},{original.name},{name},{len(obj.points)},,,,"
        try:
            time = convert(source, rig, out, "--no-build")
        except RuntimeError as error:
            print(f"{start},,,,{error}", flush=True)
            rows.append((name, None, None))
            continue
        skin = percentile(posed_inputs.skin_errors(original, obj, out, compared))
        joints = posed_inputs.joint_error(original, out, motions)
        rows.append((name, skin, joints))
        print(f"{start}{time:.2f},,{100 * joints:.3f},{100 * skin:.3f},", flush=True)


def print_posed(case, rows):
    for name in sorted({row[0] for row in rows}):
        own = [row for row in rows if row[0] == name]
        right = sum(skin is not None and skin <= 0.02 for _, skin, _ in own)
        near, nearly = (sum(joints is not None and joints <= limit for _, _, joints in own) for limit in (0.03, 0.06))
        print(f"# {case}, {name}: joints within 3 % in {near} of {len(own)}, within 6 % in {nearly}; skin within 2 % at 99 % "
              f"of points in {right}; refused {sum(skin is None for _, skin, _ in own)}")


def run_posed(cases, picked):
    for case in cases:
        rows = []
        for name, turns in posed_inputs.POSES:
            path = posed_inputs.path_of(name)
            if not os.path.exists(path) or (picked and not any(os.path.samefile(path, p) for p in picked)):
                continue
            with tempfile.TemporaryDirectory() as folder:
                measure_posed(Original(path, folder), turns, case, folder, rows)
        print_posed(case, rows)


def percentile(errors):
    return errors[int(0.99 * (len(errors) - 1))] if errors else 0


def default_files():
    zoo = os.path.join(ROOT, os.pardir, "shared", "zoo", "*", "*.glb")
    return sorted(glob.glob(os.path.join(ROOT, "examples", "*", "*.glb"))) + sorted(glob.glob(zoo))


def main():
    same, like, bare = [], [], []
    print("case,file,variant,points,equal_percent,same_kind,distance,time,same_bundle,p99_walk_percent,p99_clip_percent,error")
    known = ("b", "c", "d", "p", "bones")
    cases, picked = [a for a in sys.argv[1:] if a in known] or ["b", "c", "p"], [a for a in sys.argv[1:] if a not in known]
    for path in (picked or default_files()) if {"b", "c", "d"} & set(cases) else []:
        with tempfile.TemporaryDirectory() as folder:
            try:
                original = Original(path, folder)
            except RuntimeError as error:
                print(f"-,{os.path.basename(path)},,,,,,,,,,{str(error).splitlines()[-1]}")
                continue
            convert(path, None, os.path.join(folder, "whole.sbf"))
            if "b" in cases:
                measure_same(original, folder, same)
            if "c" in cases:
                measure_like(original, folder, like)
            if "d" in cases:
                measure_bare(original, folder, bare)
    if bare:
        print_bare(bare)
    if same:
        print(f"# b: equal at 99.9 % of points in {sum(r[0] >= 0.999 for r in same)} of {len(same)}, the same kind in "
              f"{sum(r[1] for r in same)}, distance within 2 % in {sum(abs(r[2] - 1) <= 0.02 for r in same)}, median "
              f"time {statistics.median(r[3] for r in same):.2f}, at most 1.3 in {sum(r[3] <= 1.3 for r in same)}, most "
              f"{max(r[3] for r in same):.2f}, most of {sum(r[4] for r in same)} with the same bundle "
              f"{max([r[3] for r in same if r[4]], default=0):.2f}")
    for column, motion in enumerate(("its walk", "its clips") if like else ()):
        errors = [row[column] for row in like]
        print(f"# c: by {motion} within 1 % at 99 % of points in {sum(e <= 0.01 for e in errors)} of {len(errors)}, median "
              f"{100 * statistics.median(errors):.3f} %")
    run_posed([case for case in cases if case in ("p", "bones")], picked)


if __name__ == "__main__":
    main()
