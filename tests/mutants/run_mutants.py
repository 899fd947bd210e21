#!/usr/bin/env python3
"""Puts known mistakes into copies of the source, one at a time in each, and counts how many of them the tests notice.

    run_mutants.py --build build/mutants [--check] [--survivors] [WORD...]

mutants.txt lists the mistakes; its first lines explain the form. --check only compares the list with the source.
--survivors runs those that survived or could not be run the last time; words select mutants by file or mistake.
$JOBS copies work at once (default: one a core).
Exit status: 0 at least 95 of 100 mutants are killed in each folder, 1 fewer or a mutant could not be run, 2 the call is wrong."""
import argparse
import contextlib
import json
import os
import queue
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor, as_completed

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "repo"))
from mutant_list import FOLDERS, ListError, check_mutants, read_mutants  # noqa: E402
from repo_files import ROOT, SKIPPED, project_files  # noqa: E402

GOAL = 0.95
TEST_SECONDS = 900  # a test that takes longer has noticed
KILLED, SURVIVED, FAULT = "killed", "survived", "not run"


class Scratch:
    """A copy of the source, and a build of it that is kept from one run to the next."""

    def __init__(self, folder):
        self.source, self.build = os.path.join(folder, "source"), os.path.join(folder, "build")
        shared = os.environ.get("SBFMT_SHARED_DATA", os.path.join(ROOT, os.pardir, "shared", "data"))
        self.environment = {**os.environ, "CCACHE_BASEDIR": self.source, "SBFMT_BUILD_DIR": self.build,
                            "SBFMT_SHARED_DATA": os.path.realpath(shared)}

    def update(self):
        """Copies what differs, so that no more is compiled than has changed."""
        names = set(project_files())
        for name in names:
            self.write(name, open(os.path.join(ROOT, name), "rb").read())
        for folder, folders, files in os.walk(self.source):
            folders[:] = [name for name in folders if name not in ("node_modules", "__pycache__")]
            for name in files:
                path = os.path.join(folder, name)
                if os.path.relpath(path, self.source).replace(os.sep, "/") not in names:
                    os.remove(path)

    def write(self, name, content):
        path = os.path.join(self.source, name)
        if os.path.isfile(path) and open(path, "rb").read() == content:
            return
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as stream:
            stream.write(content)
        shutil.copymode(os.path.join(ROOT, name), path)

    def configure(self):
        cache = ["-DCMAKE_C_COMPILER_LAUNCHER=ccache", "-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        self.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DSBFMT_BENCH=OFF",
                  *cache], "configuring")

    def run(self, command, what):
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True, errors="replace", check=False)
        if done.returncode:
            raise ListError(f"{what} failed:\n{(done.stdout + done.stderr)[-2000:]}")

    def make(self, tests):
        targets = sorted({target for test in tests for target in targets_of(test)})
        self.run(["cmake", "--build", self.build, "--target", *targets], "the build")

    def passes(self, test):
        """Whether the test passes; raises where it is skipped."""
        command, case = command_of(test, self), test.partition(":")[2]
        environment = {**self.environment, **({"CK_RUN_CASE": case} if case else {})}
        try:
            done = subprocess.run(command, cwd=self.source, env=environment, capture_output=True, text=True, errors="replace",
                                  timeout=TEST_SECONDS, check=False)
        except subprocess.TimeoutExpired:
            return False
        if done.returncode == SKIPPED or "***Skipped" in done.stdout or "No tests were found" in done.stdout + done.stderr \
                or (case and ("skipped" in done.stderr or "Ran 0 tests" in done.stderr)):
            raise ListError(f"{test} was skipped:\n{(done.stdout + done.stderr)[-600:]}")
        return done.returncode == 0


def targets_of(test):
    """What must be built before a test runs."""
    folder, _, name = test.partition("/")
    return {"e2e": ["sbfmt", "sbfmt-import"], "examples": ["sbfmt", "sbfmt-import"], "blender": ["sbfmt", "sbfmt-import", "sbfmt-for-python"],
            "python": ["sbfmt", "sbfmt-import", "sbfmt-for-python"], "reader": ["sbfmt"], "repo": ["sbfmt"]}.get(folder, [name.partition(":")[0]])


def command_of(test, scratch):
    name, _, case = test.partition(":")
    if case and name.startswith("e2e/"):
        return [sys.executable, "-B", os.path.join(scratch.source, "tests", name + ".py"), case]
    return ["ctest", "--test-dir", scratch.build, "--output-on-failure", "-R", f"^{name}$"]


class Workshop:
    """Scratch copies, each used by one thread at a time."""

    def __init__(self, folder, count):
        self.pool = ThreadPoolExecutor(count)
        self.copies = [Scratch(os.path.join(folder, str(number))) for number in range(1, count + 1)]
        self.free = queue.Queue()
        for copy in self.copies:
            self.free.put(copy)

    @contextlib.contextmanager
    def copy(self):
        scratch = self.free.get()
        try:
            yield scratch
        finally:
            self.free.put(scratch)

    def prepare(self, tests):
        # One after the other: what the first compiles, the compiler's cache gives to the next.
        for scratch in self.copies:
            scratch.update()
            scratch.configure()
            scratch.make(tests)

    def complaint(self, test):
        """Tests that fail without any mistake say nothing about mistakes."""
        try:
            with self.copy() as scratch:
                return None if scratch.passes(test) else f"{test} fails without a mistake"
        except ListError as error:
            return str(error)

    def try_mutant(self, mutant):
        """Puts the mistake in, builds, tests, and takes it out again."""
        with open(os.path.join(ROOT, mutant.file), encoding="utf-8") as stream:
            text = stream.read()
        with self.copy() as scratch:
            try:
                scratch.write(mutant.file, mutant.apply(text).encode())
                scratch.make(mutant.tests)
                noticed = next((test for test in mutant.tests if not scratch.passes(test)), None)
                return (KILLED, noticed) if noticed else (SURVIVED, "")
            except ListError as error:
                return FAULT, str(error)
            finally:
                scratch.write(mutant.file, text.encode())


def check_untouched(workshop, mutants):
    tests = sorted({test for mutant in mutants for test in mutant.tests})
    print(f"Building and running {len(tests)} tests without a mistake ...", flush=True)
    workshop.prepare(tests)
    return [complaint for complaint in workshop.pool.map(workshop.complaint, tests) if complaint]


def print_table(outcomes):
    """Killed and survived by folder; whether each folder reaches the goal."""
    reached = True
    print(f"\n{'folder':<10} {'mutants':>7} {'killed':>7} {'survived':>8} {'not run':>7} {'fraction':>6}")
    for _, folder in FOLDERS:
        mine = [outcome for mutant, outcome in outcomes if mutant.folder == folder]
        if not mine:
            continue
        count = {word: mine.count(word) for word in (KILLED, SURVIVED, FAULT)}
        fraction = count[KILLED] / len(mine)
        reached = reached and fraction >= GOAL and not count[FAULT]
        print(f"{folder:<10} {len(mine):>7} {count[KILLED]:>7} {count[SURVIVED]:>8} {count[FAULT]:>7} {fraction:>6.0%}")
    return reached


def selected(mutants, words, last):
    if words:
        return [m for m in mutants if any(word in m.file or word in m.mistake for word in words)]
    if last is not None:
        return [m for m in mutants if last.get(m.mistake) != KILLED]
    return mutants


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--build", required=True)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--survivors", action="store_true")
    parser.add_argument("words", nargs="*")
    arguments = parser.parse_args()
    try:
        mutants = read_mutants(os.path.join(ROOT, "tests", "mutants", "mutants.txt"))
        faults = check_mutants(mutants, ROOT)
    except ListError as error:
        faults = [str(error)]
    if faults:
        print(*(f"tests/mutants/mutants.txt: {fault}" for fault in faults), sep="\n")
        sys.exit(1)
    if arguments.check:
        print(f"{len(mutants)} mutants, each with its place in the source")
        return
    folder = os.path.abspath(arguments.build)
    results = os.path.join(folder, "results.json")
    last = json.load(open(results, encoding="utf-8")) if os.path.isfile(results) else {}
    chosen = selected(mutants, arguments.words, last if arguments.survivors else None)
    if not chosen:
        sys.exit("no mutant is selected")
    workshop = Workshop(folder, int(os.environ.get("JOBS") or os.cpu_count()))
    try:
        faults = check_untouched(workshop, chosen)
    except ListError as error:
        faults = [str(error)]
    if faults:
        print(*faults, sep="\n")
        sys.exit(1)
    outcomes = []
    running = {workshop.pool.submit(workshop.try_mutant, mutant): mutant for mutant in chosen}
    for number, done in enumerate(as_completed(running), 1):
        mutant, (outcome, more) = running[done], done.result()
        outcomes.append((mutant, outcome))
        last[mutant.mistake] = outcome
        with open(results, "w", encoding="utf-8") as stream:
            json.dump(last, stream, indent=1)
        print(f"{number:>4}/{len(chosen)} {outcome:<8} {mutant.file}: {mutant.mistake}{' [' + more + ']' if more else ''}", flush=True)
    sys.exit(0 if print_table(outcomes) else 1)


if __name__ == "__main__":
    main()
