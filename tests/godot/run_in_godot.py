#!/usr/bin/env python3
"""Runs one case of the extension's tests inside a Godot. Exits 77 where there is none.

    run_in_godot.py [--root FOLDER] [--godot PROGRAM] [--build FOLDER | --addon ZIP] --program SBFMT CASE

--root names a folder that holds another system with its Godot; what the tests need is copied into it (root only). --build is the
build whose add-on is installed, --addon one that was packed; without either there is none."""

import argparse
import base64
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

from godot_project import HERE, ROOT, Godot, needed_libraries, skip
from blender_window import Screen

LIZARD = os.path.join(ROOT, "examples", "lizard", "lizard")
BAR = os.path.join(ROOT, "examples", "tear", "bar.sbf")
DEMO = os.path.join(ROOT, "runtime", "hosts", "godot", "demo")
IN_A_CHROOT = ("XDG_RUNTIME_DIR", "dbus", "Fontconfig")
ENGINES = ("Jolt Physics", "GodotPhysics3D")


def packed(program, folder):
    """The lizard, as an engine loads it; and a second one of stiffer flesh with the same structure."""
    for name, flesh in (("lizard", []), ("stiffer", ["--material", "muscle"])):
        text, out = os.path.join(folder, name + ".sbf"), os.path.join(folder, name + ".sbfz")
        subprocess.run([program, "convert", LIZARD + ".obj", "--rig", LIZARD + ".glb", *flesh, "-o", text], check=True, capture_output=True)
        subprocess.run([program, "pack", text, "--store", "-o", out], check=True, capture_output=True)
        os.remove(text)


def cube(program, folder, cells=6, side=0.3):
    """A closed, unpinned cube of flesh, of 27 kg, standing on y = 0."""
    points, faces = {}, []
    def point(*at):
        return points.setdefault(at, len(points) + 1)
    for a in range(cells):
        for b in range(cells):
            around = [(a, b), (a + 1, b), (a + 1, b + 1), (a, b + 1)]
            for axis in range(3):
                for end in (0, cells):
                    corners = [point(*(pair[:axis] + (end,) + pair[axis:])) for pair in around]
                    faces.append(corners if (end > 0) == (axis != 1) else corners[::-1])
    path = os.path.join(folder, "cube.obj")
    with open(path, "w", encoding="utf-8") as file:
        file.write("o Cube\n")
        for x, y, z in points:
            file.write(f"v {side * (x / cells - 0.5)} {side * y / cells} {side * (z / cells - 0.5)}\n")
        for corners in faces:
            file.write("f " + " ".join(map(str, corners)) + "\n")
    packed_mesh(program, path, folder)
    os.remove(path)


def packed_mesh(program, path, folder):
    """A mesh without a rig, as an engine loads it."""
    text = os.path.join(folder, os.path.basename(path)[:-3] + "sbf")
    subprocess.run([program, "convert", path, "-o", text], check=True, capture_output=True)
    subprocess.run([program, "pack", text, "--store", "-o", text + "z"], check=True, capture_output=True)
    os.remove(text)


def quaternion(text):
    return [float(one) for one in text.split()]


def turned(a, b):
    """First b, then a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz]


def animated(program, folder):
    """The lizard with clips: `nod` turns its neck once, `sway` its spine again and again, `crawl` takes its body bone 0.3 m forward; and a
    mask of the spine."""
    path, out = os.path.join(folder, "animated.sbf"), os.path.join(folder, "animated.sbfz")
    subprocess.run([program, "unpack", os.path.join(folder, "lizard.sbfz"), "-o", path], check=True, capture_output=True)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    bones = {}
    for found in re.finditer(r"<bone ([^>]*)", text):
        values = dict(re.findall(r'(\w+)="([^"]*)"', found.group(1)))
        bones[values["id"]] = values
    def keys(bone, *angles):
        own = quaternion(bones[bone].get("rotation", "0 0 0 1"))
        parent = quaternion(bones[bones[bone]["parent"]].get("rotation", "0 0 0 1"))
        rest = turned([-parent[0], -parent[1], -parent[2], parent[3]], own)
        return " ".join(str(one) for angle in angles for one in turned(rest, [math.sin(angle / 2), 0, 0, math.cos(angle / 2)]))
    body = re.search(r'<gait [^>]*body="([^"]*)"', text).group(1)
    head = [float(one) for one in bones[body].get("head", "0 0 0").split()]
    ahead = f"{head[0]} {head[1]} {head[2]} {head[0]} {head[1]} {head[2] + 0.3}"
    def clip(name, seconds, loop, bone, kind, times, values):
        return (f'<clip id="{name}" name="{name}" duration="{seconds}" loop="{loop}"><track bone="{bone}" property="{kind}">'
                f"<times>{times}</times><values>{values}</values></track></clip>")
    more = ("<clips>" + clip("nod", 0.5, "false", "bone.neck", "rotation", "0 0.5", keys("bone.neck", 0, 0.5)) +
            clip("sway", 1, "true", "bone.spine", "rotation", "0 0.5 1", keys("bone.spine", 0, 0.2, 0)) +
            clip("crawl", 1, "true", body, "translation", "0 1", ahead) + "</clips>" +
            '<bone_masks><bone_mask id="back" name="back"><bones>' + str(list(bones).index("bone.spine")) + "</bones></bone_mask></bone_masks>")
    at = text.index("<environment") if "<environment" in text else text.index("</sbf>")
    for tag in ("<retarget_chains", "<section_recipes", "<extensions"):
        at = min(at, text.index(tag)) if tag in text else at
    with open(path, "w", encoding="utf-8") as file:
        file.write(text[:at] + more + text[at:])
    subprocess.run([program, "pack", path, "--store", "-o", out], check=True, capture_output=True)
    os.remove(path)


def png(width, pixels):
    """A picture of RGBA pixels, row by row from the top, in base64."""
    rows = b"".join(b"\0" + bytes(one for pixel in pixels[k:k + width] for one in pixel) for k in range(0, len(pixels), width))
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, len(pixels) // width, 8, 6, 0, 0, 0)
    return base64.b64encode(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")).decode()


def plates(program, folder):
    """Upright plates of a metre that face +Z, beside each other: bumps that slope to the right, left, up and down in its quarters (and the same
    with turned coordinates); colours of vertices; a picture turned by a quarter; one with a hole; glass; one that shines; and one of two sides."""
    def quarters(*colors):
        return png(8, [colors[(0 if y < 4 else 2) + (0 if x < 4 else 1)] for y in range(8) for x in range(8)])
    right, left, up, down = (218, 128, 218, 255), (38, 128, 218, 255), (128, 218, 218, 255), (128, 38, 218, 255)
    red, blue, hole = (255, 0, 0, 255), (0, 0, 255, 255), (255, 255, 255, 0)
    textures = {"bumps": quarters(right, left, up, down), "halves": quarters(red, blue, red, blue), "holes": quarters(hole, red, hole, red)}
    materials = {"bumpy": 'normal_texture="bumps"', "tinted": "", "turned": 'base_color_texture="halves"', "holed": 'alpha_mode="mask" base_color_texture="holes"',
                 "glass": 'alpha_mode="blend" base_color="1 1 1 0.25"', "shining": 'base_color="0 0 0 1" emissive="0 0.5 0"',
                 "back": 'double_sided="true"', "spun": 'normal_texture="bumps"'}
    uv = {"turned": '<base_color_uv rotation="1.5707963"/>', "spun": '<normal_uv rotation="1.5707963"/>'}
    text = '<?xml version="1.0" encoding="UTF-8"?>\n<sbf version="1.1"><textures>'
    text += "".join(f'<texture id="{name}" media_type="image/png"><bytes>{data}</bytes></texture>' for name, data in textures.items())
    text += "</textures><materials>" + "".join(f'<material id="{name}" {more} roughness="1">{uv.get(name, "")}</material>' for name, more in materials.items())
    text += "</materials>"
    for k, name in enumerate(materials):
        x = 1.5 * k
        order = "0 3 2 1" if name == "back" else "0 1 2 3"
        colors = "<colors>1 0 0 1 0 1 0 1 0 1 0 1 1 0 0 1</colors>" if name == "tinted" else ""
        text += (f'<render_mesh id="plate.{name}" name="{name}"><polygon_mesh target="rendering"><positions>{x} 0 0 {x + 1} 0 0 {x + 1} 1 0 {x} 1 0</positions><polygon_sizes>4</polygon_sizes>'
                 f"<polygon_points>{order}</polygon_points></polygon_mesh><uv_set><coordinates>0 0 1 0 1 1 0 1</coordinates></uv_set>"
                 f'<material_slot material="{name}"/>{colors}</render_mesh>')
    path = os.path.join(folder, "plates.sbf")
    with open(path, "w", encoding="utf-8") as file:
        file.write(text + "</sbf>")
    subprocess.run([program, "pack", path, "--store", "-o", path + "z"], check=True, capture_output=True)
    os.remove(path)


def copy_demo(godot, program):
    """The demo project, with what its README has one make for it; but for the lizard, which is there."""
    for name in os.listdir(DEMO):
        if name.endswith((".gd", ".tscn", ".godot")):
            shutil.copy(os.path.join(DEMO, name), godot.folder)
    packed_mesh(program, os.path.join(DEMO, "jelly.obj"), godot.folder)


def native(program, folder, name="lizard"):
    """What the program itself says of ten seconds on level ground."""
    done = subprocess.run([program, "run", os.path.join(folder, name + ".sbfz"), "--seconds", "10", "--drive", "0.25,0", "--format", "json"],
                          check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def drawn(godot, program, keep):
    """Plates with materials of every kind, drawn; the picture is kept where `keep` says."""
    if not shutil.which("Xvfb"):
        skip("there is no screen: install the package xvfb")
    plates(program, godot.folder)
    with Screen(godot.folder, godot.root) as screen:
        passed = godot.passes("drawn", "res://picture.png", display=f":{screen.number}", allowed=(*IN_A_CHROOT, "surface_materials: Nose/0"))
    if keep:
        shutil.copy(os.path.join(godot.folder, "picture.png"), keep)
    return passed


def demo(godot, program, keep):
    """The demo project on a screen of its own that nobody sees; its picture is kept where `keep` says."""
    if not shutil.which("Xvfb"):
        skip("there is no screen: install the package xvfb")
    copy_demo(godot, program)
    with Screen(godot.folder, godot.root) as screen:
        passed = godot.passes("demo", "res://picture.png", display=f":{screen.number}", allowed=IN_A_CHROOT)
    if keep:
        shutil.copy(os.path.join(godot.folder, "picture.png"), keep)
    return passed


REFUSALS = (
    "play: the asset has no clip wave: see SoftAsset.get_clip_names", "play: the options are a dictionary with", "speed: nan is not a number",
    "layer: 7 is not a number from 0 to 3", "the asset has no bone mask wings", "queue: 8 clips are waiting already",
    "the asset has no ik_chain that ends at the bone wing", "set_ik_target: the transform is not finite",
    "set_look_target: the asset has no such bone", "set_look_target: the point is not finite", "pose_weight: nan is not a number",
    "drag: nothing is grabbed", "apply_impulse: the position is not finite", "velocity: inf is not a number",
    "move_and_slide: nothing of it walks", "collision_layer: -1.09951e+12 is not a number", "sbr_character_apply_soft_impulse", "its scale is negative")


def refused(godot):
    """Each wrong value is said once, to the node by its name, and nothing else is complained of."""
    godot.copy(os.path.join(HERE, "checks.gd"), os.path.join(HERE, "refused.gd"))
    done = godot.run("--headless", "--fixed-fps", "60", "--script", "refused.gd")
    passed = godot.is_good(done, ("SoftCharacter3D#",))
    for expected_text in REFUSALS:
        times = sum(expected_text in line for line in done.stdout.splitlines() if "SoftCharacter3D#" in line)
        if times != 1:
            print(f"FAILED: said {times} times: {expected_text}")
            passed = False
    return passed


def fresh_demo(godot):
    """The demo as its README has it made, in another folder: it plays at once."""
    subprocess.run(["cmake", "--build", godot.build, "--target", "sbfmt-godot-demo"], check=True, stdout=subprocess.DEVNULL)
    made = os.path.join(godot.build, "godot-demo")
    shutil.rmtree(os.path.join(godot.folder, "addons"))
    shutil.rmtree(os.path.join(godot.folder, ".godot"))
    shutil.copytree(made, godot.folder, dirs_exist_ok=True)
    passed = godot.is_good(godot.run("--headless", "--fixed-fps", "60", "--quit-after", "120"))
    return godot.is_good(godot.run("--headless", "--import")) and godot.is_good(godot.run("--headless", "--fixed-fps", "60", "--quit-after", "120")) and passed


PLUGINS = '\n[editor_plugins]\n\nenabled=PackedStringArray({})\n'
VISITED = """[gd_scene load_steps=2 format=3]

[ext_resource type="SoftAsset" path="res://lizard.sbfz" id="1"]

[node name="Scene" type="Node3D"]

[node name="Lizard" type="SoftCharacter3D" parent="."]
asset = ExtResource("1")
ground = 1
"""


# What Import As of the Import dock writes.
CHOSEN = """[remap]

importer="sbfmt.glb"
type="SoftAsset"

[deps]

source_file="res://walker.glb"

[params]
"""


def imported(godot, program):
    """A .sbf and a .glb in the project's folder, imported by the editor, changed, and broken."""
    godot.set_engine("Jolt Physics", PLUGINS.format('"res://addons/sbfmt/plugin.cfg"'))
    godot.provide_program()
    text = os.path.join(godot.folder, "lizard.sbf")
    passed, states = True, set()
    samples = os.path.join(ROOT, "spec", "samples", "valid")
    shutil.copy(os.path.join(samples, "jelly.sbf"), godot.folder)
    shutil.copytree(os.path.join(samples, "textures"), os.path.join(godot.folder, "textures"))
    for name in ("lizard", "stiffer"):
        reported = native(program, godot.folder, name)
        states.add(reported["state_hash"])
        subprocess.run([program, "unpack", os.path.join(godot.folder, name + ".sbfz"), "-o", text], check=True, capture_output=True)
        os.remove(os.path.join(godot.folder, name + ".sbfz"))
        for scene in ("walker.glb", "scene.glb"):
            subprocess.run([program, "pack", text, "-o", os.path.join(godot.folder, scene)], check=True, capture_output=True)
        godot.write("walker.glb.import", CHOSEN)
        passed = godot.is_good(godot.run("--headless", "--import")) and godot.passes("imported", reported["state_hash"]) and passed
    if len(states) != 2:
        print("FAILED: the stiffer lizard is no other")
        return False
    godot.write("broken.sbf", "<soft_body_format/>")
    done = godot.run("--headless", "--import")
    print(done.stdout)
    return passed and "res://broken.sbf: " in done.stdout and "broken.sbf" in done.stdout


def editor(godot):
    """A visit to a scene in the editor."""
    godot.write("addons/visit/plugin.cfg", '[plugin]\n\nname="visit"\ndescription=""\nauthor=""\nversion=""\nscript="editor_visit.gd"\n')
    shutil.copy(os.path.join(HERE, "editor_visit.gd"), os.path.join(godot.folder, "addons", "visit"))
    godot.write("visited.tscn", VISITED)
    godot.set_engine("Jolt Physics", PLUGINS.format('"res://addons/sbfmt/plugin.cfg", "res://addons/visit/plugin.cfg"'))
    godot.run("--headless", "--import")
    done = godot.run("--headless", "--editor", "--fixed-fps", "60", "--quit-after", "3000")
    print(done.stdout)
    return "\n0 failed after" in done.stdout and "SCRIPT ERROR" not in done.stdout and "words.c" not in done.stdout


PRESET = """[preset.0]

name="Linux"
platform="Linux"
runnable=true
export_filter="all_resources"
include_filter=""
exclude_filter="addons/sbfmt/*.gd"
export_path="game.pck"

[preset.0.options]

binary_format/architecture="x86_64"
"""
GAME = """[gd_scene load_steps=3 format=3]

[ext_resource type="Script" path="res://exported.gd" id="1"]
[ext_resource type="SoftAsset" path="res://lizard.sbfz" id="2"]

[node name="Game" type="Node3D"]
script = ExtResource("1")

[node name="Lizard" type="SoftCharacter3D" parent="."]
asset = ExtResource("2")
ground = 1
detail = 1
forward_speed = 0.25
"""


def exported(godot, program):
    """The demo as a packed game, as docs/godot.md says, away from its project: the pack and the extension's library are all there is."""
    state = native(program, godot.folder)["state_hash"]
    copy_demo(godot, program)
    godot.copy(os.path.join(HERE, "exported.gd"))
    godot.write("export_presets.cfg", PRESET)
    godot.write("game.tscn", GAME)
    done = godot.run("--headless", "--export-pack", "Linux", f"{godot.inside}/game.pck")
    pack = os.path.join(godot.folder, "game.pck")
    if not os.path.exists(pack):
        print(done.stdout)
        return False
    library = os.path.join("addons", "sbfmt", "bin", "libsbfmt_godot.so")
    needed = [os.path.basename(one) for one in needed_libraries(os.path.join(godot.folder, library))]
    for name in os.listdir(godot.folder):
        if name not in ("game.pck", "addons"):
            path = os.path.join(godot.folder, name)
            (shutil.rmtree if os.path.isdir(path) else os.remove)(path)
    kept = os.path.join(godot.folder, "kept.so")
    os.rename(os.path.join(godot.folder, library), kept)
    shutil.rmtree(os.path.join(godot.folder, "addons"))
    os.makedirs(os.path.join(godot.folder, os.path.dirname(library)))
    os.rename(kept, os.path.join(godot.folder, library))
    passed = True
    for words in (["res://game.tscn"], ["--quit-after", "90"]):
        done = godot.run_packed("--headless", "--fixed-fps", "60", "--main-pack", "game.pck", *words)
        passed = godot.is_good(done) and passed
        if words[0].endswith("tscn"):
            passed = f"state {state}\n" in done.stdout and "sbf_import" not in done.stdout and passed
    if any("xml" in name or "assimp" in name for name in needed):
        print("FAILED: the library needs", needed)
        passed = False
    return passed


def page(godot, program):
    """What docs/godot.md says, as it says it, in a folder where `build/release`, `examples`, `sbfmt` and `mygame` are; the project and its
    scene's floor are what the editor would have made. Whether a character walks then."""
    with open(os.path.join(ROOT, "docs", "godot.md"), encoding="utf-8") as file:
        text = file.read()
    commands = re.search(r"^```sh\n(.*?)^```", text, re.MULTILINE | re.DOTALL).group(1)
    script = re.search(r"^```gdscript\n(.*?)^```", text, re.MULTILINE | re.DOTALL).group(1)
    lines = [line for line in script.splitlines() if line.strip()]
    if len(lines) > 9:
        print(f"FAILED: {len(lines)} lines are no longer under ten")
        return False
    with tempfile.TemporaryDirectory() as position:
        os.mkdir(os.path.join(position, "build"))
        os.symlink(os.path.abspath(godot.build), os.path.join(position, "build", "release"))
        os.symlink(os.path.join(ROOT, "examples"), os.path.join(position, "examples"))
        os.symlink(godot.folder, os.path.join(position, "mygame"))
        shutil.rmtree(os.path.join(godot.folder, "addons"))
        os.remove(os.path.join(godot.folder, "lizard.sbfz"))
        path = f"{os.path.dirname(os.path.abspath(program))}:{os.environ['PATH']}"
        subprocess.run(["sh", "-e", "-c", commands], cwd=position, env={**os.environ, "PATH": path}, check=True, stdout=subprocess.DEVNULL)
    godot.write("main.gd", script)
    return godot.passes("page")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", default="")
    parser.add_argument("--godot", default="")
    parser.add_argument("--build", default="")
    parser.add_argument("--addon", default="")
    parser.add_argument("--program", required=True)
    parser.add_argument("--keep", default="", help="where to keep the picture that a case draws")
    parser.add_argument("case")
    arguments = parser.parse_args()
    with Godot(arguments.root, arguments.godot, arguments.build, arguments.addon) as godot:
        packed(arguments.program, godot.folder)
        if arguments.case == "values":
            reported = native(arguments.program, godot.folder)
            passed = godot.passes("values", reported["state_hash"], str(reported["distance"]), str(sum(reported["steps_taken"].values())))
        elif arguments.case in ("ground", "surroundings", "bodies", "push", "rest", "meet", "loose", "soft", "found"):
            passed = True
            if arguments.case in ("push", "rest", "meet", "loose", "soft", "found"):
                cube(arguments.program, godot.folder)
            for engine in ENGINES:
                godot.set_engine(engine)
                passed = godot.passes(arguments.case) and passed
        elif arguments.case == "convex":
            passed = True
            for engine in ENGINES:
                godot.set_engine(engine)
                passed = godot.passes("convex", allowed=("Failed to build convex hull",), expected_text="SoftCharacter3D passes through") and passed
        elif arguments.case == "node":
            passed = (godot.passes("node", allowed=("SoftCharacter3D#",), expected_text="there is no ground") and
                      godot.passes("node", allowed=("SoftCharacter3D#",), expected_text="more than 256 shapes"))
        elif arguments.case == "signals":
            subprocess.run([arguments.program, "build", BAR, "-o", os.path.join(godot.folder, "bar.sbfz"), "--elements", "600"], check=True, capture_output=True)
            passed = godot.passes("signals")
        elif arguments.case == "animation":
            animated(arguments.program, godot.folder)
            passed = godot.passes("animation", allowed=("SoftCharacter3D#",), expected_text="pose_source is not a Skeleton3D")
        elif arguments.case == "refused":
            animated(arguments.program, godot.folder)
            cube(arguments.program, godot.folder)
            passed = refused(godot)
        elif arguments.case == "damaged":
            with open(os.path.join(godot.folder, "lizard.sbfz"), "rb") as file:
                whole = file.read()
            for name, kept in (("cut.sbfz", whole[:len(whole) // 2]), ("empty.sbfz", b""), ("text.sbfz", b"<soft_body_format/>")):
                with open(os.path.join(godot.folder, name), "wb") as file:
                    file.write(kept)
            passed = godot.passes("damaged", allowed=("res://", "play: ", "Failed loading resource", "Error loading resource"))
        elif arguments.case == "page":
            passed = page(godot, arguments.program)
        elif arguments.case == "exported":
            passed = exported(godot, arguments.program)
        elif arguments.case == "imported":
            passed = imported(godot, arguments.program)
        elif arguments.case == "editor":
            passed = editor(godot)
        elif arguments.case == "drawn":
            passed = drawn(godot, arguments.program, arguments.keep)
        elif arguments.case == "fresh_demo":
            passed = fresh_demo(godot)
        elif arguments.case == "demo":
            passed = demo(godot, arguments.program, arguments.keep)
        else:
            passed = godot.passes(arguments.case)
    sys.exit(0 if passed else 1)


if __name__ == "__main__":
    main()
