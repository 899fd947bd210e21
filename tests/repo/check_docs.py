#!/usr/bin/env python3
"""What the documents say is so: C in them compiles, as C11 and as C++17; links lead somewhere; the commands exist.

Usage: check_docs.py C-COMPILER C++-COMPILER [PROGRAM]    (without PROGRAM, sbfmt's verbs are not looked up)"""
import os
import re
import subprocess
import sys

from repo_files import ROOT, conclude, is_generated, project_files, read_text

FENCE = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\[[^\]]*\]\(([^)#\s]+)(?:#[^)]*)?\)")
FOLDERS = ("libsbfmt/include", "runtime/include")


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
            said = output(program, verb, "--help")
            if said is None:
                faults.append(f"sbfmt {verb}: no such verb")
                continue
            faults += [f"sbfmt {verb} {option}: no such option" for option in re.findall(r"(?:^|\s)(--?[a-z][\w-]*)", rest)
                       if not re.search(rf"^\s+{re.escape(option)}(\s|$)", said, re.MULTILINE)]
    return faults


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
        for target in LINK.findall(FENCE.sub("", text)):
            if "://" not in target:
                seen["links"] += 1
                if not os.path.exists(os.path.join(ROOT, os.path.dirname(path), target)):
                    faults.append(f"{path}: the link to {target} leads nowhere")
    faults += [f"nothing of kind {kind} was found to check" for kind, count in seen.items() if not count]
    conclude(f"{len(files)} documents, {seen['c']} programs, {seen['sh']} lists of commands, {seen['links']} links", faults)


if __name__ == "__main__":
    main()
