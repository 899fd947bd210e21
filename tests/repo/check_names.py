#!/usr/bin/env python3
"""File names are unique, so that one names its file wherever it is spoken of, and a file holds one idea."""
from repo_files import conclude, is_generated, project_files, read_text

CHECKED = (".c", ".h", ".cpp", ".py", ".sh", ".cmake", ".md", ".js", ".mjs", ".ts", ".glsl", ".vert", ".frag", ".comp")
SHARED_NAMES = {"README.md", "__init__.py", "index.js", "index.ts"}
MOST_LINES = 700


def faults_of(lines_of):
    """`lines_of`: path -> count of lines."""
    faults, by_name = [], {}
    for path, lines in lines_of.items():
        name = path.rsplit("/", 1)[-1]
        if name.endswith(CHECKED) and name not in SHARED_NAMES:
            by_name.setdefault(name, []).append(path)
        if name.endswith((".c", ".h", ".cpp", ".py", ".sh")) and lines > MOST_LINES and not is_generated(path):
            faults.append(f"{path}: {lines} lines, more than {MOST_LINES}: which ideas does it hold?")
    faults += [f"the same name twice: {', '.join(paths)}" for paths in by_name.values() if len(paths) > 1]
    return faults


def main():
    lines_of = {path: (read_text(path) or "").count("\n") for path in project_files()}
    conclude(f"names and sizes of {len(lines_of)} files", faults_of(lines_of))


if __name__ == "__main__":
    main()
