#!/usr/bin/env python3
"""No unfinished words, no paths of one machine, no stray white space, in anything that is committed."""
import os
import re

from repo_files import ROOT, conclude, is_generated, project_files, read_text

# Written so that this file does not hold the words itself.
UNFINISHED = re.compile(r"\b(TO[D]O|FIX[M]E|X{3}|HAC[K]|not[ ]implemented|un[i]mplemented|st[u]b(?:bed)?|"
                        r"place[h]older|for[ ]now)\b")
MACHINE = re.compile(r"(?:^|[^\w.])(/(?:home|Users|root|work)/[\w.-]+)", re.MULTILINE)
SOURCE = (".c", ".h", ".cpp", ".py", ".sh", ".cmake", ".md", ".txt", ".json", ".schema", ".codes", ".xsd", ".yml")


def faults_of(path, text, checkout=ROOT):
    faults = []

    def found(position, what):
        faults.append(f"{path}:{text.count(chr(10), 0, position) + 1}: {what}")

    if path != "CHANGELOG.md":
        for match in UNFINISHED.finditer(text):
            found(match.start(), f"'{match.group(0)}': finish it, or say what is so instead")
    for match in MACHINE.finditer(text):
        found(match.start(1), f"{match.group(1)}: a path of one machine")
    if len(checkout) > 1 and checkout in text:
        found(text.index(checkout), "the path of this checkout")
    if path.endswith(SOURCE):
        for match in re.finditer(r"\r|[ \t]+$", text, re.MULTILINE):
            found(match.start(), "white space at the end of the line")
        if path.endswith((".c", ".h", ".py", ".sh")) and "\t" in text:
            found(text.index("\t"), "a tab")
        if text and not text.endswith("\n"):
            found(len(text) - 1, "no newline at the end of the file")
    return faults


def main():
    faults, read = [], 0
    for path in project_files():
        # Samples hold what the world's files hold.
        if path.startswith("spec/samples/") or is_generated(path):
            continue
        text = read_text(path)
        if text is None:
            if path.endswith(SOURCE):
                faults.append(f"{path}: not UTF-8 text")
            continue
        read += 1
        faults += faults_of(path, text, os.path.realpath(ROOT))
    conclude(f"words in {read} files", faults)


if __name__ == "__main__":
    main()
