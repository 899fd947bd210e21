#!/usr/bin/env python3
"""Checks that file names are unique, that files are not too long, and that identifiers and file names have no private words where
the field has a standard word."""
import io
import re
import tokenize

from repo_files import conclude, is_generated, project_files, read_text

CHECKED = (".c", ".h", ".cpp", ".py", ".sh", ".cmake", ".md", ".js", ".mjs", ".ts", ".glsl", ".vert", ".frag", ".comp")
SHARED_NAMES = {"README.md", "__init__.py", "index.js", "index.ts"}
MAX_LINES = 700
# Words that may not stand between underscores in identifiers and file names of C code and of scripts, and the field's words for them.
PRIVATE_WORDS = {
    "most": "max", "least": "min", "guest": "external_body", "guests": "external_bodies", "rub": "friction_impulse",
    "wild": "unstable", "heed": "apply", "place": "position, index or path", "places": "positions",
    "way": "direction, displacement, path or method", "ways": "directions", "share": "fraction, weight or t",
    "shares": "fractions", "held": "pinned or locked", "touch": "contact", "touches": "contacts",
    "room": "capacity or storage", "rooms": "storage", "rung": "detail_level", "rungs": "detail_levels",
    "ladder": "detail_levels", "look": "query, check or find", "looks": "style or samples", "told": "reported",
    "tell": "report", "mend": "repair", "mended": "repaired", "mending": "repair", "ease": "inverse_mass",
    "meet": "collide", "meets": "collides", "meeting": "pair", "meetings": "pairs", "settle": "solve or resolve",
    "tend": "update", "remember": "store", "guide": "driver", "guides": "drivers", "flesh": "attached body",
    "borne": "attached", "spin": "angular_velocity or angular_momentum", "apart": "separation",
    "doubt": "tolerance or warning", "doubts": "warnings", "judge": "check or evaluate", "calm": "damping",
    "quiet": "idle", "crush": "compression", "thinning": "stretch", "mover": "kinematic", "roster": "pool",
    "yardstick": "comparison", "burden": "attached_load", "burdens": "attached_loads", "girth": "wall_volume",
    "bumper": "wall_sphere", "bumpers": "wall_spheres", "carrier": "attachment or embedding point",
    "carriers": "attachments or embedding points", "frayed": "torn_ends", "relapse": "repeat_window", "veil": "xray",
    "hindmost": "rearmost", "girdle": "limb_root", "leveller": "level_maker", "lonely": "boundary or isolated",
    "adrift": "unpinned", "dearer": "costlier", "dearest": "costliest", "hitch": "slow frame", "easel": "canvas",
    "traveller": "translated_bone", "tells": "reports", "mends": "repairs", "mender": "repair reporter", "heeds": "applies",
    "judged": "checked", "felt": "effect", "mendable": "repairable"}
# Words that the names of tests may not contain either: they name behaviour by other words than the code does.
TEST_WORDS = {
    "what": "the subject", "whatever": "any", "anew": "again", "alike": "equally", "likewise": "too", "otherwise": "the condition",
    "hung": "attached", "bears": "supports or carries", "bear": "support or carry", "lies": "rests", "knows": "has", "knew": "had",
    "speaks": "shows", "dies": "becomes unstable", "die": "become unstable", "let": "released", "lets": "allows", "say": "report",
    "says": "reports"}
# Names of the format, its diagnostics and systems.
KNOWN_NAMES = {
    "substeps_least", "substeps_most", "SBF_CODE_UNIT_LOOKS_WRONG", "SBF_CODE_DENSITY_LOOKS_WRONG",
    "SBF_CODE_GRAVITY_LOOKS_WRONG", "SBF_CODE_RIG_OBJECT_APART", "FILE_SHARE_READ", "FILE_SHARE_WRITE",
    "FILE_SHARE_DELETE", "most_substeps", "volume_least", "uneven_volume_least", "uneven_distance_share"}
# Scripts whose identifiers are checked like those of the C code.
SCRIPTS = ("exporters/", "bench/", "examples/", "cmake/")
# Phrases whose words are the field's: stripped before the words are looked for.
PHRASES = re.compile(r"least_squares|in_place")
NOT_CODE = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|^#include.*?$", re.DOTALL | re.MULTILINE)


def identifiers_of(path, text):
    if path.endswith(".py"):
        return {token.string for token in tokenize.generate_tokens(io.StringIO(text).readline) if token.type == tokenize.NAME}
    return set(re.findall(r"[A-Za-z_]\w*", NOT_CODE.sub(" ", text)))


def name_faults_of(path, text):
    """Private words in the identifiers of C or Python code and in the file's name."""
    names = identifiers_of(path, text) - KNOWN_NAMES
    names.add(path.rsplit("/", 1)[-1].rsplit(".", 1)[0])
    found = {(name, word) for name in names for word in PHRASES.sub("", name.lower()).split("_") if word in PRIVATE_WORDS}
    return [f"{path}: '{name}' holds '{word}': say '{PRIVATE_WORDS[word]}', or what it is" for name, word in sorted(found)]


def faults_of_test_names(path, text):
    """Words in the names of tests that do not say plainly what behaviour they test."""
    words = {**PRIVATE_WORDS, **TEST_WORDS}
    names = re.findall(r"^START_TEST\((\w+)\)", text, re.MULTILINE) + re.findall(r"^ *def (test_\w+)", text, re.MULTILINE)
    found = {(name, word) for name in names for word in PHRASES.sub("", name).split("_") if word in words}
    return [f"{path}: test '{name}' has '{word}': say '{words[word]}'" for name, word in sorted(found)]


def faults_of(lines_of):
    """`lines_of`: path -> count of lines."""
    faults, by_name = [], {}
    for path, lines in lines_of.items():
        name = path.rsplit("/", 1)[-1]
        if name.endswith(CHECKED) and name not in SHARED_NAMES:
            by_name.setdefault(name, []).append(path)
        if name.endswith((".c", ".h", ".cpp", ".py", ".sh")) and lines > MAX_LINES and not is_generated(path):
            faults.append(f"{path}: {lines} lines, more than {MAX_LINES}: which ideas does it hold?")
    faults += [f"the same name twice: {', '.join(paths)}" for paths in by_name.values() if len(paths) > 1]
    return faults


def main():
    texts = {path: read_text(path) or "" for path in project_files()}
    faults = faults_of({path: text.count("\n") for path, text in texts.items()})
    for path, text in texts.items():
        is_checked = path.endswith((".c", ".h", ".cpp")) and not path.startswith("tests/") or \
            path.endswith(".py") and path.startswith(SCRIPTS)
        if is_checked and not is_generated(path):
            faults += name_faults_of(path, text)
        if path.startswith("tests/") and path.endswith((".c", ".py")):
            faults += faults_of_test_names(path, text)
    conclude(f"names and sizes of {len(texts)} files", faults)


if __name__ == "__main__":
    main()
