#!/usr/bin/env python3
"""./run: its calls and its handling of missing packages, on a machine of simulated commands."""
import contextlib
import hashlib
import io
import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

from repo_files import ROOT

sys.path.insert(0, os.path.join(ROOT, "cmake"))
import make_packages  # noqa: E402

RUN = os.path.join(ROOT, "run")
REAL = ("sh", "dirname", "cat", "sed", "env", "grep", "nproc", "mkdir", "awk", "wc", "date", "tail", "head", "true",
        "mktemp", "tee", "rm")
# apt-get that has lists of packages, or none until it updates them; it records the packages that it is asked to install.
WITH_LISTS = 'case $1 in indextargets) echo list ;; *) echo "apt-get $*"; exit 7 ;; esac'
WITHOUT_LISTS = '''here=$(dirname "$0")
case "$*" in indextargets*) cat "$here/lists" 2>/dev/null ;; *update*) echo list >"$here/lists" ;; *) echo "apt-get $*"; exit 7 ;; esac'''
# apt-cache of an archive with clang 19 and all packages but one
ARCHIVE = '''[ -e "$(dirname "$0")/lists" ] || [ -n "$LISTS" ] || exit 100
case "$*" in "depends clang") echo "  Depends: clang-19" ;; "show wasi-libc") exit 100 ;; esac'''


def call(*arguments, path=None):
    """Calls a copy of ./run in a folder of its own, so that it cannot touch this checkout."""
    environment = {**os.environ, "PATH": path or os.environ["PATH"]}
    with tempfile.TemporaryDirectory() as folder:
        return subprocess.run(["/bin/sh", shutil.copy(RUN, folder), *arguments], capture_output=True, text=True,
                              env=environment, stdin=subprocess.DEVNULL, timeout=60)


class Calls(unittest.TestCase):
    def test_help(self):
        done = call("help")
        self.assertEqual(done.returncode, 0)
        for command in ("demo", "test", "bench", "charts", "build", "fuzz", "coverage", "mutants", "abi", "docs", "studio", "format"):
            self.assertIn(f"\n  {command} ", done.stdout)
        self.assertEqual(call().stdout, done.stdout)

    def test_wrong_calls(self):
        for arguments in (["nonsense"], ["test", "--most"], ["fuzz", "long"], ["demo", "now"], ["abi", "now"], ["docs", "now"], ["studio", "1", "2"], ["package", "rpm"],
                          ["package", "--check", "deb"], ["test", "--all", "--systems"]):
            done = call(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn("run: ", done.stderr)


class Packages(unittest.TestCase):
    """A machine where no package is installed, to whom `id` and `sudo` say what the test wants."""

    def machine(self, commands):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        for name in REAL:
            found = next((os.path.join(position, name) for position in ("/usr/bin", "/bin")
                          if os.path.exists(os.path.join(position, name))), None)
            if found:
                os.symlink(found, os.path.join(folder, name))
        for name, text in commands.items():
            path = os.path.join(folder, name)
            with open(path, "w", encoding="utf-8") as file:
                file.write("#!/bin/sh\n" + text + "\n")
            os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
        return folder

    def test_the_user_gets_the_command(self):
        path = self.machine({"dpkg-query": "exit 1", "id": "echo 1000", "apt-get": "echo must not run; exit 1",
                             "sudo": "exit 1"})
        done = call("build", path=path)
        self.assertEqual(done.returncode, 2)
        command = next(line for line in done.stdout.splitlines() if "apt-get" in line)
        self.assertTrue(command.startswith("  sudo apt-get update && sudo apt-get install -y"), command)
        for package in ("cmake", "ninja-build", "gcc", "libxml2-dev", "libassimp-dev", "libjansson-dev"):
            self.assertIn(" " + package, command)
        self.assertNotIn("must not run", done.stdout)

    def test_root_and_sudo_install(self):
        for user in ({"id": "echo 0"}, {"id": "echo 1000", "sudo": 'shift; exec "$@"'}):
            path = self.machine({"dpkg-query": "exit 1", "apt-get": WITH_LISTS, **user})
            done = call("build", path=path)
            self.assertEqual(done.returncode, 2)
            self.assertIn(" install -y --no-install-recommends", done.stdout)
            self.assertIn(" update", done.stdout)
            self.assertIn("could not install", done.stderr)

    def test_names_of_packages_come_from_the_archive(self):
        """With or without lists at first: clang's runtime has clang's number, and what the archive lacks is done without."""
        for apt, lists in ((WITH_LISTS, "LISTS=1;"), (WITHOUT_LISTS, "")):
            path = self.machine({"dpkg-query": "exit 1", "id": "echo 0", "apt-get": apt, "apt-cache": lists + ARCHIVE})
            command = next(line for line in call("build", path=path).stdout.splitlines() if " install -y" in line)
            self.assertIn(" libclang-rt-19-dev-wasm32", command)
            self.assertNotIn("wasi-libc", command)
            self.assertNotIn("%", command)

    def test_lists_past_their_date_are_used(self):
        """A snapshot of an archive; other errors of an update stay errors, and only once is asked for the exception."""
        apt = 'case "$*" in indextargets*) ;; *Valid-Until=false*) echo updated ;; *update*) echo "E: Release file {}"; exit 100 ;; esac'
        for words, times in (("is expired (invalid since 17d)", 1), ("could not be read", 0)):
            path = self.machine({"dpkg-query": "exit 1", "id": "echo 0", "apt-get": apt.format(words) + "\nexit 0"})
            done = call("build", path=path)
            self.assertEqual(done.stdout.count("updated"), times, done.stdout)
            self.assertEqual("could not update its lists" in done.stderr, not times)
            self.assertNotRegex(done.stdout, r"(?m)^[01]$")

    def test_a_user_without_lists_gets_one_line_that_finds_the_number(self):
        path = self.machine({"dpkg-query": "exit 1", "id": "echo 1000", "apt-get": WITHOUT_LISTS, "apt-cache": ARCHIVE})
        lines = [line for line in call("build", path=path).stdout.splitlines() if "apt-get" in line]
        self.assertEqual(len(lines), 1)
        words = lines[0].split("--no-install-recommends")[1]
        typed = subprocess.run(["/bin/sh", "-c", "echo" + words], capture_output=True, text=True, check=True,
                               env={"PATH": self.machine({"apt-cache": "LISTS=1;" + ARCHIVE})}).stdout
        self.assertIn(" libclang-rt-19-dev-wasm32", typed)
        self.assertNotIn("@", typed)

    def test_a_user_without_godot_gets_the_command(self):
        there = {name: "exit 0" for name in ("ninja", "gcc", "pkg-config", "python3", "cmake", "clang", "wasm-ld", "npm", "debootstrap", "g++",
                                             "dpkg-shlibdeps", "file")}
        path = self.machine({"dpkg-query": "printf 'installed '", "id": "echo 1000", "sudo": "exit 1", **there})
        done = call("package", path=path)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stdout, r"(?m)^  sudo tests/other_system.sh /.*/build/other-system godot$")

    def test_a_package_that_is_only_named_is_missing(self):
        """dpkg knows packages that others only name in Breaks: "not-installed", and nothing for a second architecture."""
        for status in ("not-installed ", "config-files ", "not-installed not-installed "):
            path = self.machine({"dpkg-query": f"printf '{status}'", "id": "echo 0", "apt-get": 'echo "apt-get $*"; exit 7'})
            done = call("build", path=path)
            self.assertEqual(done.returncode, 2, status)
            self.assertIn(" libassimp-dev", done.stdout)

    def test_nothing_is_installed_twice(self):
        path = self.machine({"dpkg-query": "printf 'installed '", "id": "echo 0", "apt-get": "echo must not run",
                             **{name: "exit 0" for name in ("ninja", "gcc", "pkg-config", "python3", "clang", "wasm-ld")},
                             "cmake": "echo asked to configure; exit 5"})
        done = call("build", path=path)
        self.assertEqual(done.returncode, 1)
        self.assertNotIn("must not run", done.stdout)
        self.assertIn("configuring failed", done.stderr)


class Stages(unittest.TestCase):
    """The stages of `test --all`, with others in their places."""

    def run_all(self, **bodies):
        stages = {name: "true" for name in ("other_system", "strict_build", "strict", "sanitize", "first_run", "slow")}
        replaced = "".join(f"stage_{name}() {{\n{body}\n}}\n" for name, body in {**stages, **bodies}.items())
        with open(RUN, encoding="utf-8") as file:
            functions, dispatch = file.read().split("\ncommand=${1:-help}\n")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "run")
            with open(path, "w", encoding="utf-8") as file:
                file.write(f"{functions}\nrequire() {{ :; }}\n{replaced}command=${{1:-help}}\n{dispatch}")
            shutil.copytree(os.path.join(ROOT, "tests"), os.path.join(folder, "tests"), ignore=lambda top, names: [
                name for name in names if os.path.isdir(os.path.join(top, name))])
            return subprocess.run(["/bin/sh", path, "test", "--all"], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                                  timeout=60, check=False)

    def test_each_is_counted_once(self):
        done = self.run_all(first_run="echo said beside", slow="echo said before; sleep 1")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(done.stdout.count("\npassed "), 6)
        self.assertIn("6 passed, 0 failed", done.stdout)
        self.assertLess(done.stdout.index("said before"), done.stdout.index("said beside"))

    def test_one_that_fails_beside_others_fails_all(self):
        for name in ("other_system", "first_run"):
            done = self.run_all(**{name: "echo broken; exit 1"})
            self.assertEqual(done.returncode, 1, done.stdout)
            self.assertIn("broken", done.stdout)
            self.assertRegex(done.stdout, r"(?m)^FAILED +\d+ s")
            self.assertIn("5 passed, 1 failed", done.stdout)

    def test_two_that_are_skipped_give_their_own_reasons(self):
        done = self.run_all(other_system="skippable 'no' sh -c 'echo SKIP one: no archive; exit 77'",
                            first_run="skippable 'no' sh -c 'sleep 1; echo SKIP two: no root; exit 77'")
        self.assertIn("stage/other_system one: no archive", done.stdout)
        self.assertIn("stage/first_run two: no root", done.stdout)


class Table(unittest.TestCase):
    def test_a_package_that_is_not_made_is_counted_and_reported(self):
        class Some:
            out = self.enterContext(tempfile.TemporaryDirectory())
            npm, tarball = staticmethod(lambda: "there is no npm"), staticmethod(lambda: open(os.path.join(Some.out, "it"), "wb").close())
            debian = staticmethod(lambda: make_packages.run("sh", "-c", "echo no room >&2; exit 3"))
        printed, complained = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(complained):
            self.assertEqual(make_packages.make_each(Some, ["npm", "debian", "tarball"]), (2, {"npm": set(), "debian": set(), "tarball": {"it"}}))
        self.assertEqual(printed.getvalue(), "npm       NOT MADE: there is no npm\n"
                                          "debian    NOT MADE: a command failed; see its output above\ntarball   made\n")
        self.assertIn("no room", complained.getvalue())

    def test_the_bill_of_materials_names_libraries_inside_each_package(self):
        folder = self.enterContext(tempfile.TemporaryDirectory())
        os.makedirs(os.path.join(folder, "libraries", "licences"))
        for path, text in (("libraries/licences/sources", "zlib 1.2 aa\nassimp 5.2 bb\n"), ("CMakeCache.txt", f"SBFMT_STATIC_LIBRARIES:PATH={folder}/libraries\n"),
                           ("addon.zip", "addon"), ("it.tar.gz", "program"), ("plain.deb", "")):
            with open(os.path.join(folder, path), "w", encoding="utf-8") as file:
                file.write(text)

        class Some:
            version = "0.1"
            tree_of = staticmethod(lambda name: None if name == "debian" else folder)
        make_packages.write_bill(Some, {"blender": {"addon.zip"}, "linux": {"it.tar.gz"}, "debian": {"plain.deb"}}, folder)
        with open(os.path.join(folder, "sbfmt-0.1.spdx.json"), encoding="utf-8") as file:
            bill = json.load(file)
        inside = {(one["spdxElementId"], one["relatedSpdxElement"]) for one in bill["relationships"] if one["relationshipType"] == "CONTAINS"}
        self.assertEqual(inside, {("SPDXRef-addon.zip", "SPDXRef-zlib"), ("SPDXRef-it.tar.gz", "SPDXRef-zlib"), ("SPDXRef-it.tar.gz", "SPDXRef-assimp")})
        self.assertEqual({one["name"] for one in bill["packages"]}, {"addon.zip", "it.tar.gz", "plain.deb", "zlib", "assimp"})
        sums = {one["name"]: one["checksums"][0]["checksumValue"] for one in bill["packages"]}
        self.assertEqual((sums["zlib"], sums["addon.zip"]), ("aa", hashlib.sha256(b"addon").hexdigest()))


if __name__ == "__main__":
    unittest.main()
