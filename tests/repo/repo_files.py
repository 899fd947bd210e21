"""Which files belong to the project, for the checks of this folder."""
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Written by spec/generate/generate.py: as long as they need to be.
GENERATED = ("libsbfmt/generated/", "libsbfmt/include/sbfmt/model", "libsbfmt/include/sbfmt/codes.h",
             "spec/reference.md", "spec/codes.md", "spec/sbf.xsd")
LEFT_OUT = {".git", "__pycache__", "node_modules"}
LEFT_OUT_AT_ROOT = LEFT_OUT | {"build", "out"}
SKIPPED = 77  # exit status by which ctest knows a test that could not run


def project_files(root=ROOT):
    """Paths below root, '/' between: what git knows or would add; without git, everything not ignored."""
    try:
        listed = subprocess.run(["git", "-C", root, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
                                capture_output=True, check=True).stdout
        names = [name for name in listed.decode().split("\0") if name]
    except (OSError, subprocess.CalledProcessError):
        names = []
        for folder, folders, files in os.walk(root):
            ignored = LEFT_OUT_AT_ROOT if folder == root else LEFT_OUT
            folders[:] = [name for name in folders if name not in ignored]
            names += [os.path.relpath(os.path.join(folder, name), root).replace(os.sep, "/") for name in files]
    return sorted(name for name in names if os.path.isfile(os.path.join(root, name)))


def is_generated(path):
    return path.startswith(GENERATED)


def read_text(path, root=ROOT):
    """The file's text; None where it is not text."""
    with open(os.path.join(root, path), "rb") as file:
        data = file.read()
    try:
        return None if b"\0" in data else data.decode("utf-8")
    except UnicodeDecodeError:
        return None


def conclude(what, faults):
    """Prints the faults and ends the program."""
    for fault in faults:
        print(fault)
    print(f"{what}: {len(faults)} at fault" if faults else f"{what}: good")
    sys.exit(1 if faults else 0)
