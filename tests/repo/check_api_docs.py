#!/usr/bin/env python3
"""Doxygen finds a comment for every public symbol, and nothing to warn of. Skips (77) where it is not installed."""
import os
import shutil
import subprocess
import sys
import tempfile

from repo_files import ROOT, conclude, read_text


def main():
    if not shutil.which("doxygen"):
        print("skipped: doxygen is not installed")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        settings = read_text("docs/Doxyfile") + f"\nOUTPUT_DIRECTORY = {folder}\nGENERATE_HTML = NO\nGENERATE_XML = YES\n"
        done = subprocess.run(["doxygen", "-"], input=settings, capture_output=True, text=True, cwd=ROOT, check=False)
        pages = os.listdir(os.path.join(folder, "xml")) if done.returncode == 0 else []
    faults = [line.replace(ROOT + os.sep, "") for line in done.stderr.splitlines() if line.strip()]
    if done.returncode or not any(name.startswith("structsbf__asset") for name in pages):
        faults.append(f"doxygen made no pages of the public headers (status {done.returncode})")
    conclude("comments of public symbols", faults)


if __name__ == "__main__":
    main()
