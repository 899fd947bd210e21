#!/usr/bin/env python3
"""Counts the test cases of a run of `./run test`, lists the skipped ones with their reasons, and says which of them
tests/allowed_skips does not allow.

Usage: report.py [--strict] STAGES FOLDER
STAGES has lines of OUTCOME SECONDS NAME TITLE. FOLDER holds what ctest wrote, one NAME.xml a stage, and NAME.log of skipped ones. Programs that print "CASES n" and
"SKIP case: reason" count as so many cases, others as one; a stage counts as one case where it ran no tests. Exit status: 1 if
something failed or, with --strict, was skipped without being allowed."""
import collections
import fnmatch
import functools
import glob
import os
import re
import shutil
import subprocess
import sys
import urllib.request
from xml.etree import ElementTree

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SKIP = re.compile(r"^SKIP (.+?): (.*)$", re.MULTILINE)
CASES = re.compile(r"^CASES (\d+)$", re.MULTILINE)

Skip = collections.namedtuple("Skip", "test case reason")


def debian_12():
    try:
        with open("/etc/os-release", encoding="utf-8") as file:
            text = file.read()
    except OSError:
        return False
    return "\nID=debian" in "\n" + text and 'VERSION_ID="12"' in text


def newer_system():
    return os.path.join(ROOT, "build", "other-system", "usr", "bin")


@functools.cache
def no_registry():
    """Whether npm is here and its registry out of reach."""
    return bool(shutil.which("npm")) and subprocess.run(["npm", "ping"], capture_output=True, check=False).returncode != 0


@functools.cache
def no_archive():
    """Whether the archive that apt is configured for does not answer for Debian's unstable suite."""
    if not shutil.which("apt-get"):
        return True
    printed = subprocess.run(["apt-get", "indextargets", "--format", "$(REPO_URI)", "Created-By: Packages"], capture_output=True,
                          text=True, check=False).stdout
    for archive in printed.split()[:1]:
        try:
            with urllib.request.urlopen(archive.rstrip("/") + "/dists/unstable/Release", timeout=30):
                return False
        except (OSError, ValueError):
            pass
    return True


# The words of the column WHERE.
WHERE = {
    "anywhere": lambda: True,
    "not-debian-12": lambda: not debian_12(),
    "no-shared": lambda: not os.path.isdir(os.environ.get("SBFMT_SHARED_DATA", os.path.join(ROOT, os.pardir, "shared", "data"))),
    "no-blender": lambda: not shutil.which("blender"),
    "no-newer-blender": lambda: not os.path.exists(os.path.join(newer_system(), "blender")),
    "no-godot": lambda: not shutil.which("godot") and not os.path.exists(os.path.join(newer_system(), "godot")),
    "no-registry": no_registry,
    "no-archive": no_archive,
    "not-root": lambda: os.geteuid() != 0,
}


def allowances(path):
    """Lines of TEST WHERE REASON; TEST and REASON with the wildcards of a shell."""
    with open(path, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            words = line.split(None, 2)
            if not words or line.startswith("#"):
                continue
            if len(words) != 3 or words[1] not in WHERE:
                sys.exit(f"{path}:{number}: not a line of TEST WHERE REASON, where WHERE is one of {', '.join(WHERE)}: {line.strip()}")
            yield words[0], words[1], words[2].strip()


def is_allowed(skip, allowed):
    return any(fnmatch.fnmatchcase(skip.test, test) and fnmatch.fnmatchcase(skip.reason, reason) and WHERE[where]()
               for test, where, reason in allowed)


def last_line(text):
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1].removeprefix("skipped: ") if lines else "it gave no reason"


def read_tests(path):
    """Counts of passed and failed cases, and the skips, of one call of ctest."""
    passed = failed = 0
    skips = []
    for test in ElementTree.parse(path).getroot().iter("testcase"):
        printed, status = test.findtext("system-out") or "", test.get("status")
        reported = [Skip(test.get("name"), *found) for found in SKIP.findall(printed)]
        if status in ("notrun", "disabled") and not reported:
            reported = [Skip(test.get("name"), "all", last_line(printed))]
        cases = sum(map(int, CASES.findall(printed)))
        skips += reported
        if status == "fail":
            failed += 1
        elif status == "run":
            passed += max(cases - len(reported), 0) if cases else 1
    return passed, failed, skips


def read_stages(path, folder, tests):
    """Prints the stages, and counts those that failed outside of their tests or ran none: `tests` has (passed, failed) of each by name."""
    passed = failed = 0
    skips = []
    with open(path, encoding="utf-8") as file:
        lines = [line.split(None, 3) for line in file]
    for outcome, seconds, name, title in lines:
        print(f"{outcome:8}{seconds:>6} s  {title.strip()}")
        if outcome == "skipped":
            with open(os.path.join(folder, name + ".log"), encoding="utf-8", errors="replace") as file:
                printed = file.read()
            skips += [Skip("stage/" + name, *found) for found in SKIP.findall(printed)] or [Skip("stage/" + name, "all", last_line(printed))]
        elif outcome == "FAILED":
            failed += not tests.get(name, (0, 0))[1]
        else:
            passed += name not in tests
    return passed, failed, skips


def list_skips(title, skips):
    if skips:
        print(title)
    for skip in skips:
        print(f"  {skip.test} {skip.case}: {skip.reason}")


def main():
    strict = "--strict" in sys.argv
    stages, folder = sys.argv[-2:]
    tests, skips = {}, []
    for path in sorted(glob.glob(os.path.join(folder, "*.xml"))):
        passed, failed, more = read_tests(path)
        tests[os.path.basename(path)[:-len(".xml")]] = passed, failed
        skips += more
    passed, failed, more = read_stages(stages, folder, tests)
    skips += more
    passed, failed = passed + sum(count[0] for count in tests.values()), failed + sum(count[1] for count in tests.values())
    allowed = list(allowances(os.path.join(ROOT, "tests", "allowed_skips")))
    unexpected = [skip for skip in skips if not is_allowed(skip, allowed)]
    list_skips("Skipped, as tests/allowed_skips allows:", [skip for skip in skips if skip not in unexpected])
    list_skips("Skipped, not allowed by tests/allowed_skips:", unexpected)
    print(f"{passed} passed, {failed} failed, {len(skips)} skipped, {len(unexpected)} of them not allowed in CI")
    sys.exit(1 if failed or strict and unexpected else 0)


if __name__ == "__main__":
    main()
