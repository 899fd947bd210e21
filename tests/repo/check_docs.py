#!/usr/bin/env python3
"""Checks the documents: C code compiles as C11 and C++17, links and their anchors exist, commands exist, documents and
media stay within their sizes, and no document uses private words.

Usage: check_docs.py C-COMPILER C++-COMPILER [PROGRAM]    (without PROGRAM, sbfmt's verbs are not looked up)"""
import os
import re
import subprocess
import sys

from repo_files import ROOT, conclude, is_generated, project_files, read_text

sys.path.insert(0, os.path.join(ROOT, "docs", "site"))
from anchors import FENCE, LINK, anchors  # noqa: E402

FOLDERS = ("libsbfmt/include", "runtime/include")
# Words of an old private dialect, and what to write instead.
PRIVATE = {"told": "reported, given", "tell": "report, show", "tells": "reports, shows", "mend": "repair", "mends": "repairs",
           "mended": "repaired", "heed": "follow", "heeds": "follows", "judged": "checked, estimated", "borne": "attached, supported",
           "guest": "external body", "lest": "so that ... not", "aslant": "obliquely", "likewise": "the same, also"}
QUOTED = re.compile(r"`[^`\n]*`|\*[^*\n]+\*|\]\([^)]*\)|<!--.*?-->")  # code, labels of panels, addresses, markers
MEDIA = (".png", ".gif", ".webp", ".svg", ".mp4", ".jpg", ".jpeg")
MOST_WORDS, MOST_SPECIFICATION_WORDS, MOST_CHANGELOG_BYTES, MOST_MEDIA_BYTES = 35000, 12000, 6144, 12_000_000


def compile_faults(text, compilers):
    includes = [argument for folder in FOLDERS for argument in ("-I", os.path.join(ROOT, folder))]
    for compiler, language in compilers:
        done = subprocess.run([compiler, *language, "-Wall", "-Wextra", "-Werror", "-fsyntax-only", *includes, "-"],
                              input=text, capture_output=True, text=True)
        if done.returncode:
            return [f"{' '.join(language)}: {done.stderr.strip()}"]
    return []


def output(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else None


def command_faults(text, run_help, program):
    """Commands that ./run or the program does not have, and options that a verb does not know."""
    faults = []
    for line in text.splitlines():
        line = line.split("#")[0]
        for command in re.findall(r"(?:^|[\s;&])\./run (\w+)", line):
            if f"\n  {command} " not in run_help:
                faults.append(f"./run {command}: no such command")
        for verb, rest in re.findall(r"(?:^|[\s;&/])sbfmt ([a-z]\w*)([^;&|]*)", line):
            if not program:
                continue
            printed = output(program, verb, "--help")
            if printed is None:
                faults.append(f"sbfmt {verb}: no such verb")
                continue
            faults += [f"sbfmt {verb} {option}: no such option" for option in re.findall(r"(?:^|\s)(--?[a-z][\w-]*)", rest)
                       if not re.search(rf"^\s+{re.escape(option)}(\s|$)", printed, re.MULTILINE)]
    return faults


def link_faults(path, text, read=read_text):
    """Links from the document at path whose file or heading does not exist."""
    faults = []
    for link in LINK.findall(FENCE.sub("", text)):
        if "://" in link or link.startswith("mailto:"):
            continue
        target, _, anchor = link.partition("#")
        file = os.path.normpath(os.path.join(os.path.dirname(path), target)) if target else path
        if not os.path.exists(os.path.join(ROOT, file)):
            faults.append(f"the link to {target} leads nowhere")
        elif anchor and file.endswith(".md") and anchor not in anchors(text if file == path else read(file)):
            faults.append(f"the link to {link}: no heading has this anchor")
    return faults


def word_faults(text):
    """Private words in a document's sentences."""
    words = re.findall(r"[a-z]+", QUOTED.sub("", FENCE.sub("", text)).lower())
    return [f"'{word}': write {PRIVATE[word]}" for word in sorted(set(words) & set(PRIVATE))]


def size_faults(sizes, words):
    """Files above the size limits. sizes: bytes by path; words: number of words by document."""
    pages = sum(count for path, count in words.items() if path.startswith("docs/"))
    specification = sum(count for path, count in words.items() if re.fullmatch(r"spec/[^/]+", path))
    media = sum(size for path, size in sizes.items() if path.lower().endswith(MEDIA))
    limits = (("docs/*.md", pages, MOST_WORDS, "words: cut a page, or move measurements to bench/README.md"),
              ("spec/*.md", specification, MOST_SPECIFICATION_WORDS, "words, generated tables not counted"),
              ("CHANGELOG.md", sizes.get("CHANGELOG.md", 0), MOST_CHANGELOG_BYTES, "bytes: merge lines of one topic"),
              ("pictures and films", media, MOST_MEDIA_BYTES, "bytes: shorten or shrink a film (examples/films.sh)"))
    return [f"{what}: {size} of at most {limit} {unit}" for what, size, limit, unit in limits if size > limit]


def main():
    compilers = [(sys.argv[1], ["-x", "c", "-std=c11"]), (sys.argv[2], ["-x", "c++", "-std=c++17"])]
    program = sys.argv[3] if len(sys.argv) > 3 and os.path.exists(sys.argv[3]) else None
    run_help = output("/bin/sh", os.path.join(ROOT, "run"), "help")
    faults, seen = [], {"c": 0, "sh": 0, "links": 0}
    files = [path for path in project_files() if path.endswith(".md") and not is_generated(path)]
    for path in files:
        text = read_text(path)
        for kind, inside in FENCE.findall(text):
            if kind == "c":
                found = compile_faults(inside, compilers)
            elif kind == "sh":
                found = command_faults(inside, run_help, program)
            else:
                continue
            seen[kind] += 1
            faults += [f"{path}: {fault}" for fault in found]
        seen["links"] += len(LINK.findall(FENCE.sub("", text)))
        faults += [f"{path}: {fault}" for fault in link_faults(path, text) + word_faults(text)]
    faults += size_faults({path: os.path.getsize(os.path.join(ROOT, path)) for path in project_files()},
                          {path: len(read_text(path).split()) for path in files})
    faults += [f"nothing of kind {kind} was found to check" for kind, count in seen.items() if not count]
    conclude(f"{len(files)} documents, {seen['c']} programs, {seen['sh']} lists of commands, {seen['links']} links", faults)


if __name__ == "__main__":
    main()
