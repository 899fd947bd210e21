"""Calls of the program whose result must not depend on the system it was built for: words, exit statuses, files to the byte."""
import os
import re
import shutil
import subprocess

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
EXAMPLES = os.path.join(SOURCE, "examples")
LIZARD = os.path.join(EXAMPLES, "lizard", "lizard.obj")
RIG = os.path.join(EXAMPLES, "lizard", "lizard.glb")
FIGURE = os.path.join(EXAMPLES, "bones", "figure.sbf")
# A mesh with a JPEG texture beside it.
JPEG = os.path.join(SOURCE, "tests", "render", "images", "quarters.jpg")
INPUTS = {"panel.obj": "mtllib panel.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl skin\n"
                       "f 1/1 2/2 4/4\nf 2/2 3/3 4/4\nf 3/3 1/1 4/4\nf 1/1 3/3 2/2\n",
          "panel.mtl": "newmtl skin\nmap_Kd quarters.jpg\n",
          "broken.glb": "glTF and nothing else", "broken.fbx": "; FBX 7.3.0 project file\nObjects: {"}
# Words of each call; OUT is a file of its own.
CALLS = [
    ["--version"],
    ["validate", "--help"],
    ["validate", FIGURE],
    ["info", FIGURE],
    ["convert", LIZARD, "--rig", RIG, "-o", "lizard.sbf"],
    ["convert", os.path.join(EXAMPLES, "koi", "koi.glb"), "-o", "koi.sbfz"],
    ["validate", "lizard.sbf"],
    ["build", "lizard.sbf", "--levels", "2", "-o", "levels.sbfz"],
    ["run", "lizard.sbf", "--seconds", "1", "--drive", "0.3,0.2", "--pose", "pose.csv"],
    ["pack", "lizard.sbf", "-o", "lizard.glb"],
    ["unpack", "lizard.glb", "-o", "again.sbf"],
    ["diff", "lizard.sbf", "again.sbf"],
    ["export", "lizard.sbf", "-o", "lizard.xml"],
    ["export", "lizard.sbf", "-o", "mj.mjcf.xml"],
    ["export", "lizard.sbf", "-o", "page.html"],
    ["convert", "panel.obj", "-o", "panel.sbf"],
    ["pack", "panel.sbf", "-o", "panel.glb"],
    ["validate", "panel.glb"],
    # What cannot be done says so with the same words and status.
    ["validate", "not-there.sbf"],
    ["convert", "broken.glb", "-o", "none.sbf"],
    ["convert", LIZARD, "--rig", "broken.fbx", "-o", "none.sbf"],
    ["convert", "broken.glb"],
    ["run"],
]


def call(program, words, folder):
    done = subprocess.run([*program, *words], cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False)
    said = re.sub(r"us_per_frame +\S+ us\n| +\d+\.\d\d(?=\n)", "", done.stdout) + done.stderr  # without times
    return done.returncode, said


def files_of(folder):
    made = {}
    for name in sorted(os.listdir(folder)):
        path = os.path.join(folder, name)
        if os.path.isfile(path):
            with open(path, "rb") as stream:
                made[name] = stream.read()
    return made


def compare(other, native, folder, calls=CALLS, name="the other"):
    """Faults: where the program `other` (its words of a command line) does something else than the program `native`."""
    here, there = os.path.join(folder, "here"), os.path.join(folder, "there")
    for place in (here, there):
        os.mkdir(place)
        for file, text in INPUTS.items():
            with open(os.path.join(place, file), "w", encoding="utf-8") as stream:
                stream.write(text)
        shutil.copy(JPEG, place)
    faults = []
    for words in calls:
        one, two = call(native, words, here), call(other, words, there)
        if one != two:
            faults.append(f"{' '.join(words)}\n--- this system's:\n{one[0]}\n{one[1][-1500:]}\n--- {name}'s:\n{two[0]}\n{two[1][-1500:]}")
    mine, theirs = files_of(here), files_of(there)
    if mine.keys() != theirs.keys():
        faults.append(f"files: {sorted(mine)} and {sorted(theirs)}")
    faults += [f"{name} has other bytes" for name in mine if theirs.get(name, mine[name]) != mine[name]]
    return faults
