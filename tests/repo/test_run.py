#!/usr/bin/env python3
"""./run: its calls, and what it does about missing packages, on a machine made of pretended commands."""
import os
import shutil
import stat
import subprocess
import tempfile
import unittest

from repo_files import ROOT

RUN = os.path.join(ROOT, "run")
REAL = ("sh", "dirname", "cat", "sed", "env", "ls", "nproc", "mkdir", "awk", "wc", "date", "tail", "head", "true")


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
        for command in ("demo", "test", "bench", "charts", "build", "fuzz", "coverage", "abi", "format"):
            self.assertIn(f"\n  {command} ", done.stdout)
        self.assertEqual(call().stdout, done.stdout)

    def test_wrong_calls(self):
        for arguments in (["nonsense"], ["test", "--most"], ["fuzz", "long"], ["demo", "now"], ["abi", "now"]):
            done = call(*arguments)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn("run: ", done.stderr)


class Packages(unittest.TestCase):
    """A machine where no package is installed, to whom `id` and `sudo` say what the test wants."""

    def machine(self, commands):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        for name in REAL:
            found = next((os.path.join(place, name) for place in ("/usr/bin", "/bin")
                          if os.path.exists(os.path.join(place, name))), None)
            if found:
                os.symlink(found, os.path.join(folder, name))
        for name, text in commands.items():
            path = os.path.join(folder, name)
            with open(path, "w", encoding="utf-8") as file:
                file.write("#!/bin/sh\n" + text + "\n")
            os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
        return folder

    def test_user_is_told_the_command(self):
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
        for who in ({"id": "echo 0"}, {"id": "echo 1000", "sudo": 'shift; exec "$@"'}):
            path = self.machine({"dpkg-query": "exit 1", "apt-get": 'echo "apt-get $*"; exit 7', **who})
            done = call("build", path=path)
            self.assertEqual(done.returncode, 2)
            self.assertIn(" install -y --no-install-recommends", done.stdout)
            self.assertIn(" update", done.stdout)
            self.assertIn("could not install", done.stderr)

    def test_a_package_that_is_only_named_is_missing(self):
        """dpkg knows packages that others only name in Breaks: "not-installed", and nothing for a second architecture."""
        for status in ("not-installed ", "config-files ", "not-installed not-installed "):
            path = self.machine({"dpkg-query": f"printf '{status}'", "id": "echo 0", "apt-get": 'echo "apt-get $*"; exit 7'})
            done = call("build", path=path)
            self.assertEqual(done.returncode, 2, status)
            self.assertIn(" libassimp-dev", done.stdout)

    def test_nothing_is_installed_twice(self):
        path = self.machine({"dpkg-query": "printf 'installed '", "id": "echo 0", "apt-get": "echo must not run",
                             **{name: "exit 0" for name in ("ninja", "gcc", "pkg-config", "python3")},
                             "cmake": "echo asked to configure; exit 5"})
        done = call("build", path=path)
        self.assertEqual(done.returncode, 1)
        self.assertNotIn("must not run", done.stdout)
        self.assertIn("configuring failed", done.stderr)


if __name__ == "__main__":
    unittest.main()
