#!/usr/bin/env python3
"""File names are unique, so that one names its file wherever it is spoken of, and a file holds one idea. Identifiers and file
names hold no private words where the field has a word of its own."""
import re

from repo_files import conclude, is_generated, project_files, read_text

CHECKED = (".c", ".h", ".cpp", ".py", ".sh", ".cmake", ".md", ".js", ".mjs", ".ts", ".glsl", ".vert", ".frag", ".comp")
SHARED_NAMES = {"README.md", "__init__.py", "index.js", "index.ts"}
MAX_LINES = 700
# Words that stand between underscores in no identifier and no file name of the C code, and what is said instead.
PRIVATE_WORDS = {"most": "max", "least": "min", "guest": "external_body", "guests": "external_bodies",
                 "rub": "friction_impulse", "wild": "unstable",
                 "heed": "apply"}
# Names of the format and of the public interface.
KNOWN_NAMES = {
    "SBR_MOST_VIEWS", "least_dihedral_deg", "least_factor", "least_spring_factor",
    "most_dihedral_deg", "most_factor", "most_period_error", "most_residual", "most_spring_factor", "most_spring_residual",
    "substeps_least", "substeps_most"}
NOT_CODE = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])*'|^#include.*?$", re.DOTALL | re.MULTILINE)


def name_faults_of(path, text):
    """Private words in the identifiers of C code and in the file's name."""
    names = set(re.findall(r"[A-Za-z_]\w*", NOT_CODE.sub(" ", text))) - KNOWN_NAMES
    names.add(path.rsplit("/", 1)[-1].rsplit(".", 1)[0])
    found = {(name, word) for name in names for word in name.lower().replace("least_squares", "").split("_") if word in PRIVATE_WORDS}
    return [f"{path}: '{name}' holds '{word}': say '{PRIVATE_WORDS[word]}', or what it is" for name, word in sorted(found)]


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
        if path.endswith((".c", ".h", ".cpp")) and not path.startswith("tests/") and not is_generated(path):
            faults += name_faults_of(path, text)
    conclude(f"names and sizes of {len(texts)} files", faults)


if __name__ == "__main__":
    main()
