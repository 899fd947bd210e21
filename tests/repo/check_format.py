#!/usr/bin/env python3
"""Checks that every C file is formatted by clang-format 14 with the .clang-format at the root; --fix formats them."""
import re
import shutil
import subprocess
import sys

from repo_files import ROOT, SKIPPED, conclude, is_generated, project_files


def formatter():
    """clang-format of version 14, others lay out some lines differently; None where it is not installed."""
    for name in ("clang-format-14", "clang-format"):
        path = shutil.which(name)
        if path and " version 14." in subprocess.run([path, "--version"], capture_output=True, text=True).stdout:
            return path
    return None


def main():
    program = formatter()
    if not program:
        print("skipped: clang-format 14 is not installed (Debian: apt-get install clang-format-14)")
        sys.exit(SKIPPED)
    files = [path for path in project_files() if path.endswith((".c", ".h")) and not is_generated(path)]
    if "--fix" in sys.argv[1:]:
        subprocess.run([program, "--style=file", "-i", *files], cwd=ROOT, check=True)
    printed = subprocess.run([program, "--style=file", "--dry-run", *files], cwd=ROOT, capture_output=True, text=True).stderr
    wrong = sorted(set(re.findall(r"^(\S+?):\d+:\d+: warning:", printed, re.MULTILINE)))
    conclude(f"layout of {len(files)} files", [f"{path}: ./run format mends it" for path in wrong])


if __name__ == "__main__":
    main()
