#!/usr/bin/env python3
"""Every public header compiles alone, twice in one file, as C11 and as C++17, without a warning: by the compilers given, and by
gcc and clang where they are here.

Usage: check_headers.py C-COMPILER [C++-COMPILER]"""
import os
import shutil
import subprocess
import sys

from repo_files import ROOT, SKIPPED, conclude, project_files

FOLDERS = ("libsbfmt/include/", "runtime/include/")
WARNINGS = ["-Wall", "-Wextra", "-pedantic-errors", "-Wshadow", "-Wundef", "-Werror", "-fsyntax-only"]
LANGUAGES = {"c11": ["-x", "c", "-std=c11", "-Wstrict-prototypes"],
             "c++17": ["-x", "c++", "-std=c++17", "-Wold-style-cast", "-Wno-unused-const-variable"]}


def complaint(compiler, language, header):
    """What the compiler says of a source that includes nothing but the header; '' where it is content."""
    source = f'#include "{header}"\n' * 2 + "int main(void) { return 0; }\n"
    includes = [argument for folder in FOLDERS for argument in ("-I", os.path.join(ROOT, folder))]
    run = subprocess.run([compiler, *LANGUAGES[language], *WARNINGS, *includes, "-"], input=source,
                         capture_output=True, text=True)
    return run.stderr.strip() if run.returncode else ""


def main():
    compilers = {"c11": {sys.argv[1] if len(sys.argv) > 1 else "cc", "gcc", "clang"},
                 "c++17": {sys.argv[2] if len(sys.argv) > 2 else "c++", "g++", "clang++"}}
    # One compiler under two names is asked once.
    compilers = {language: {os.path.realpath(shutil.which(name)): name for name in sorted(names) if shutil.which(name)}
                 for language, names in compilers.items()}
    if not compilers["c++17"]:
        print("skipped: no C++ compiler (Debian: apt-get install g++)")
        sys.exit(SKIPPED)
    headers = [path[len(folder):] for path in project_files() for folder in FOLDERS
               if path.startswith(folder) and path.endswith(".h")]
    faults = []
    for header in headers:
        for language, compiler in [(language, name) for language, names in compilers.items() for name in names.values()]:
            printed = complaint(compiler, language, header)
            if printed:
                faults.append(f"{header} as {language} by {compiler}: {printed}")
    if not headers:
        faults.append("no public header found: the check would be empty")
    names = sorted(name for names in compilers.values() for name in names.values())
    conclude(f"{len(headers)} public headers, alone, as C11 and C++17, by {', '.join(names)}", faults)


if __name__ == "__main__":
    main()
