"""Tests that manual pages and shell completion cover everything in --help, and that man and shells accept them."""

import os
import re
import shutil
import subprocess
import unittest

from sbfmt_program import ProgramTest, call, main, read_text


def verbs():
    return re.findall(r"^  ([a-z]+) ", call("--help").out, re.MULTILINE)


def options(verb):
    return re.findall(r"^  (--?[a-z-]+)", call(verb, "--help").out, re.MULTILINE)


def run(*command, text=None):
    return subprocess.run(command, input=text, capture_output=True, text=True, check=False, timeout=60)


def needs(program):
    return unittest.skipUnless(shutil.which(program), f"{program} is not there")


class Generated(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for what in ("man", "bash", "zsh", "fish"):
            os.mkdir(cls.made(what))
            done = call("--generate", what, cls.made(what))
            if done.status != 0:
                raise AssertionError(done.err)

    def page(self, verb):
        return os.path.join(self.made("man"), f"sbfmt-{verb}.1")

    def completed(self, *words):
        """The completions of bash for the last word."""
        quoted = " ".join(f"'{word}'" for word in words)
        script = (f". {self.made('bash')}/sbfmt\nCOMP_WORDS=({quoted})\nCOMP_CWORD={len(words) - 1}\n_sbfmt\n"
                  'printf "%s\\n" "${COMPREPLY[@]}"\n')
        done = run("bash", "-c", script)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout.split()

    def test_every_verb_has_a_page_with_every_option(self):
        self.assertGreaterEqual(len(verbs()), 10)
        self.assertEqual(len(os.listdir(self.made("man"))), len(verbs()) + 1)
        overview = read_text(os.path.join(self.made("man"), "sbfmt.1"))
        for verb in verbs():
            self.assertIn(f"sbfmt\\-{verb}", overview)
            for option in options(verb):
                self.assertIn(".B " + option.replace("-", "\\-"), read_text(self.page(verb)))

    def test_help_is_whole_and_fits_a_terminal(self):
        """No text is cut off, and only unbreakable words are wider than 100 columns."""
        for verb in verbs():
            text = call(verb, "--help").out
            for line in text.split("\n\n", 2)[2].splitlines():
                self.assertTrue(len(line) <= 100 or " " not in line.strip(), f"{verb}: {line}")
            for cut in re.findall(r"^  -.*\|[^ ]*$", text, re.MULTILINE):
                self.assertRegex(cut, r"[a-z0-9\]]$", verb)
        self.assertRegex(call("export", "--help").out, r"(?m)^  -o OUT\.glb\|.*\.mdd$")

    @needs("mandoc")
    def test_pages_are_well_formed(self):
        for name in os.listdir(self.made("man")):
            done = run("mandoc", "-T", "lint", "-W", "warning", os.path.join(self.made("man"), name))
            lines = [line for line in done.stdout.splitlines() if "missing date" not in line]
            self.assertEqual(lines, [], name)

    @needs("bash")
    def test_bash_offers_verbs_options_and_words(self):
        self.assertEqual(sorted(self.completed("sbfmt", "")), sorted(verbs() + ["--help", "--version"]))
        self.assertEqual(self.completed("sbfmt", "conv"), ["convert"])
        for verb in verbs():
            self.assertEqual(sorted(self.completed("sbfmt", verb, "-")), sorted(options(verb) + ["--help"]), verb)
        self.assertEqual(self.completed("sbfmt", "convert", "--up", ""), ["y", "z"])
        self.assertEqual(self.completed("sbfmt", "run", "--seconds", ""), [])
        self.assertIn(self.made("man"), self.completed("sbfmt", "convert", "--out-dir", self.made("m")))

    @needs("zsh")
    def test_zsh_can_read_it(self):
        path = os.path.join(self.made("zsh"), "_sbfmt")
        done = run("zsh", "-n", path)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for verb in verbs():
            for option in options(verb):
                self.assertIn(f"'*{option}[", read_text(path))

    @needs("fish")
    def test_fish_can_read_it(self):
        path = os.path.join(self.made("fish"), "sbfmt.fish")
        done = run("fish", "-c", f"source {path}; complete -C 'sbfmt convert --u'")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(sorted(line.split()[0] for line in done.stdout.splitlines()), ["--unit", "--up"])

    def test_wrong_calls(self):
        self.assertIn("man, bash, zsh or fish", self.fails(2, "--generate", "tcsh", self.folder))
        self.fails(2, "--generate", "man")
        self.fails(2, "--generate", "man", self.path("none"))


if __name__ == "__main__":
    main()
