"""Calls the built program as a user does; base classes for its tests.

The program is that of the build folder SBFMT_BUILD_DIR, or SBFMT_PROGRAM itself; shared data lie in ../shared/data
beside the checkout, or in SBFMT_SHARED_DATA. Where a whole test file has nothing to do it exits with 77, which ctest
takes as skipped.
"""

import collections
import hashlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.realpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir))
SHARED = os.environ.get("SBFMT_SHARED_DATA", os.path.join(ROOT, os.pardir, "shared", "data"))
EXAMPLE = os.path.join(ROOT, "examples", "lizard")
SKIPPED = 77
SOURCE_PARTS = ("--no-build", "--budget", "none")  # of `convert`: neither built, nor the soft parts chosen by their cost, which takes a second

Result = collections.namedtuple("Result", "status out err")


def find_program():
    named = os.environ.get("SBFMT_PROGRAM")
    if named:
        return named if os.access(named, os.X_OK) else None
    build = os.environ.get("SBFMT_BUILD_DIR", os.path.join(ROOT, "build", "release"))
    path = os.path.join(build, "tools", "sbfmt")
    return path if os.access(path, os.X_OK) else None


PROGRAM = find_program()


def shared(*parts):
    return os.path.join(SHARED, *parts)


def call(*arguments, timeout=300, environment=None, output=subprocess.PIPE):
    """Runs `sbfmt ARGUMENTS`. A negative status is the signal that ended it."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=output,
                          stderr=subprocess.PIPE, timeout=timeout, env={**os.environ, **(environment or {})},
                          check=False)
    return Result(done.returncode, (done.stdout or b"").decode("utf-8"), done.stderr.decode("utf-8", "replace"))


def call_limited(most_bytes, *arguments):
    """Runs `sbfmt ARGUMENTS` where no file can be larger, as on a full disk."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (most_bytes, most_bytes))

    done = subprocess.run([PROGRAM, *map(str, arguments)], preexec_fn=limit, stdin=subprocess.DEVNULL, capture_output=True, check=False)
    return Result(done.returncode, done.stdout.decode("utf-8"), done.stderr.decode("utf-8", "replace"))


def read_bytes(path):
    with open(path, "rb") as stream:
        return stream.read()


def read_text(path):
    with open(path, encoding="utf-8") as stream:
        return stream.read()


def write_bytes(path, content):
    with open(path, "wb") as stream:
        stream.write(content)
    return path


needs_lizard = unittest.skipUnless(os.path.exists(shared("lizard", "liz.obj")),
                                   "the lizard of ../shared/data/lizard is not there")
needs_bad_files = unittest.skipUnless(os.path.isdir(shared("bad")), "the files of ../shared/data/bad are not there")


class ProgramTest(unittest.TestCase):
    """Tests with a folder of their class, for files made once, and one of their own."""

    @classmethod
    def setUpClass(cls):
        cls.class_folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.class_folder.cleanup)

    def setUp(self):
        own = tempfile.TemporaryDirectory()
        self.addCleanup(own.cleanup)
        self.folder = own.name

    @classmethod
    def made(cls, name):
        return os.path.join(cls.class_folder.name, name)

    def path(self, name):
        return os.path.join(self.folder, name)

    def good(self, *arguments, **options):
        result = call(*arguments, **options)
        self.assertEqual(result.status, 0, f"sbfmt {' '.join(map(str, arguments))}\n{result.err}")
        return result

    def json_of(self, *arguments, status=0, **options):
        """What `--format json` prints: one object and nothing else."""
        result = call(*arguments, "--format", "json", **options)
        self.assertEqual(result.status, status, result.err)
        report = json.loads(result.out)
        self.assertIsInstance(report, dict)
        return report

    def fails(self, status, *arguments, **options):
        """A failure with a message and without a crash. Returns the message."""
        result = call(*arguments, **options)
        self.assertEqual(result.status, status, f"{result.out}\n{result.err}")
        self.assertIn("error: ", result.err)
        return result.err

    def assert_empty_folder(self, folder=None, but=()):
        self.assertEqual(sorted(set(os.listdir(folder or self.folder)) - set(but)), [])


def stamp_of(*paths):
    """A name for these files as they are now."""
    states = [(path, os.stat(path).st_size, os.stat(path).st_mtime_ns) for path in paths if os.path.isfile(path)]
    return hashlib.sha256(repr(states).encode()).hexdigest()[:24]


def kept_conversions():
    """A folder of the build for what this program converts, which other test files want as well; None without a build."""
    build = os.environ.get("SBFMT_BUILD_DIR")
    if not build or os.environ.get("SBFMT_PROGRAM"):
        return None
    every = os.path.join(build, "scratch", "converted")
    mine = os.path.join(every, stamp_of(PROGRAM, os.path.join(os.path.dirname(PROGRAM), "sbfmt-import")))
    if not os.path.isdir(mine):
        os.makedirs(mine, exist_ok=True)
        for other in set(os.listdir(every)) - {os.path.basename(mine)}:  # of the program as it was before
            shutil.rmtree(os.path.join(every, other), ignore_errors=True)
    return mine


def convert_once(folder, name, *arguments):
    """A file made for a whole class; a failure is the class's. Each class has a copy of its own."""
    out, kept = os.path.join(folder, name), kept_conversions()
    if os.path.exists(out):
        return out
    kept = kept and os.path.join(kept, f"{stamp_of(*arguments)}.{hashlib.sha256(repr(arguments).encode()).hexdigest()[:8]}.{name}")
    if kept and os.path.exists(kept):
        shutil.copyfile(kept, out)
        return out
    result = call("convert", *arguments, "-o", out)
    if result.status != 0:
        raise AssertionError(f"convert {' '.join(arguments)}: {result.err}")
    if kept:
        unfinished = f"{kept}.{os.getpid()}"
        shutil.copyfile(out, unfinished)
        os.replace(unfinished, kept)
    return out


def built_of_modulus(folder, name, source, modulus, *options):
    """The bundle `source` (.sbf) built again, of so many Pa where a section's is stated."""
    stated, out = os.path.join(folder, "stated." + name), os.path.join(folder, name)
    with open(source, encoding="utf-8") as stream:
        text = re.sub(r'(<attributes young_modulus=)"[^"]*"', rf'\1"{modulus:g}"', stream.read())
    write_bytes(stated, text.encode())
    result = call("build", stated, *options, "-o", out)
    if result.status != 0:
        raise AssertionError(f"build of {name}: {result.err}")
    return out


def liz(folder):
    """The lizard of the thesis: OBJ for the sections, FBX for the rig."""
    return convert_once(folder, "liz.sbf", shared("lizard", "liz.obj"), "--rig", shared("lizard", "liz.fbx"))


def lizart(folder):
    return convert_once(folder, "lizart.sbf", shared("lizard", "lizart.glb"))


def example(folder):
    """Our own lizard, which is always there."""
    return convert_once(folder, "example.sbf", os.path.join(EXAMPLE, "lizard.obj"), "--rig",
                        os.path.join(EXAMPLE, "lizard.glb"))


def main():
    if not PROGRAM:
        print("skipped: the program sbfmt is not built (SBFMT_BUILD_DIR says where to look)")
        sys.exit(SKIPPED)
    program = unittest.main(exit=False, verbosity=2)
    result = program.result
    if result.wasSuccessful() and result.skipped and len(result.skipped) >= result.testsRun:
        sys.exit(SKIPPED)
    sys.exit(not result.wasSuccessful())
