"""`sbfmt view` in a window of a display that Xvfb makes: keys, pointer, balls and switches, by a file of input and by a
keyboard. Skipped where the program has no window, or there is no Xvfb or no OpenGL to draw with."""

import json
import os
import re
import shutil
import subprocess
import time
import unittest

from sbfmt_program import PROGRAM, ProgramTest, call, example, main, read_bytes, write_bytes
from test_render_files import read_png

SMALL = ("--size", "200x150")
# Memory that drivers and X still hold at exit is no leak of the program.
QUIET = {"SDL_VIDEODRIVER": "x11", "LSAN_OPTIONS": "detect_leaks=0"}


class Screen:
    """A display of its own; .name is None where there is none to be had."""

    def __init__(self):
        self.name = self.server = None
        if not shutil.which("Xvfb"):
            return
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x1024x24", "-nolisten", "tcp"],
                                       pass_fds=(write,), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as stream:
            number = stream.readline().strip()
        self.name = f":{number}" if number else None

    def close(self):
        if self.server:
            self.server.terminate()
            self.server.wait()


class View(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.screen = Screen()
        cls.addClassCleanup(cls.screen.close)
        if not cls.screen.name:
            raise unittest.SkipTest("there is no Xvfb to make a display")
        cls.environment = {**QUIET, "DISPLAY": cls.screen.name}
        text = example(cls.class_folder.name)
        cls.file = cls.made("lizard.sbfz")
        call("build", text, "--render-levels", "2", "-o", cls.file)
        tried = call("view", cls.file, "--frames", "1", *SMALL, environment=cls.environment)
        if "without a window" in tried.err or "OpenGL" in tried.err or "needs SDL" in tried.err:
            raise unittest.SkipTest(tried.err.strip())

    def view(self, frames, *lines, file=None, more=()):
        """The report after so many frames, with this input."""
        script = write_bytes(self.path("input.txt"), "\n".join(lines).encode() + b"\n")
        return self.json_of("view", file or self.file, "--frames", frames, *(() if "--size" in more else SMALL), "--input", script, *more,
                            environment=self.environment)

    def picture(self, name):
        return read_png(read_bytes(self.path(name)))

    def test_it_moves_as_run_does(self):
        shown = self.view(12)
        ran = self.json_of("run", self.file, "--seconds", "0.2")
        self.assertEqual((shown["frames"], shown["state_hash"]), (12, ran["state_hash"]))

    def test_keys_walk_and_turn(self):
        still = self.view(30)
        walks = self.view(30, "0 down W")
        stops = self.view(30, "0 down W", "12 up W")
        turns = self.view(30, "0 down A")
        self.assertEqual(still["walked"], 0)
        self.assertGreater(walks["walked"], 0.02)
        self.assertLess(stops["walked"], walks["walked"])
        self.assertEqual(len({one["state_hash"] for one in (still, walks, stops, turns)}), 4)

    def test_speed_and_drive(self):
        fast = self.view(30, "0 tap F", "0 down W")
        walk = self.view(30, "0 down W")
        self.assertEqual((walk["pace"], fast["pace"]), ("walk", "fast"))
        self.assertGreater(fast["walked"], walk["walked"])
        driven = self.view(12, more=("--drive", "0.3,0.1"))
        ran = self.json_of("run", self.file, "--seconds", "0.2", "--drive", "0.3,0.1")
        self.assertEqual(driven["state_hash"], ran["state_hash"])

    def test_every_switch_changes_the_picture_and_back(self):
        lines = ["0 tap P", "0 tap H", "0 tap H", f"0 shot {self.path('first.png')}"]
        for key in range(1, 8):
            lines += [f"{2 * key - 1} tap {key}", f"{2 * key - 1} shot {self.path(f'{key}.png')}", f"{2 * key} tap {key}"]
        report = self.view(16, *lines, more=("--shot", self.path("last.png")))
        self.assertTrue(report["paused"])
        first = self.picture("first.png")
        self.assertEqual(first[:2], (200, 150))
        # The area with shadows has grown, so some edges are smoothed differently.
        off = [abs(a - b) for one, other in zip(self.picture("last.png")[3], first[3]) for a, b in zip(one, other)]
        self.assertLess((max(off), sum(off) / len(off)), (24, 0.1))
        seen = [self.picture(f"{key}.png") for key in range(1, 8)]
        for key, one in enumerate(seen, 1):
            self.assertNotEqual(one, first, f"switch {key}")
        self.assertEqual(len({str(one[3]) for one in seen}), 7)

    def test_the_panel_is_shown_and_hidden(self):
        self.view(3, "0 tap P", f"0 shot {self.path('figures.png')}", "1 tap H", f"1 shot {self.path('keys.png')}",
                  "2 tap H", f"2 shot {self.path('bare.png')}", more=("--size", "480x400"))
        rows = [self.picture(name)[3] for name in ("figures.png", "keys.png", "bare.png")]
        self.assertEqual(len({str(one) for one in rows}), 3)
        # Words are on the left alone.
        right = [[row[len(row) * 3 // 4:] for row in one] for one in rows]
        self.assertEqual(right[0], right[2])

    def test_a_ball_hits(self):
        report = self.view(45, "0 tap B")
        self.assertEqual((report["balls_thrown"], report["ball_hits"] > 0), (1, True))
        self.assertNotEqual(report["state_hash"], self.view(45)["state_hash"])

    def test_dragging_moves_the_body_or_rotates_the_view(self):
        begins = self.view(1)["camera"]
        pulled = self.view(25, "0 press 0.5 0.5", "5 move 0.55 0.3")
        self.assertTrue(pulled["holds"])
        self.assertEqual(pulled["camera"]["yaw"], begins["yaw"])
        left = self.view(25, "0 press 0.5 0.5", "5 move 0.55 0.3", "10 release")
        self.assertFalse(left["holds"])
        self.assertNotEqual(left["state_hash"], pulled["state_hash"])
        turned = self.view(3, "0 press 0.97 0.97", "1 move 0.7 0.9")
        self.assertFalse(turned["holds"])
        self.assertNotEqual(turned["camera"]["yaw"], begins["yaw"])
        self.assertLess(self.view(2, "0 wheel 3")["camera"]["distance"], begins["distance"])
        self.assertGreater(self.view(2, "0 tap -")["camera"]["distance"], begins["distance"])

    def test_bodies_without_bones_are_pressed(self):
        file = self.path("block.sbf")
        write_bytes(self.path("block.obj"), b"""o block
v -0.2 0 -0.2
v 0.2 0 -0.2
v 0.2 0.4 -0.2
v -0.2 0.4 -0.2
v -0.2 0 0.2
v 0.2 0 0.2
v 0.2 0.4 0.2
v -0.2 0.4 0.2
f 4 3 2 1
f 5 6 7 8
f 1 2 6 5
f 3 4 8 7
f 2 3 7 6
f 4 1 5 8
""")
        self.good("convert", self.path("block.obj"), "-o", file)
        alone = self.view(12, file=file)
        pressed = self.view(12, "0 press 0.5 0.5", "2 move 0.45 0.45", file=file)
        self.assertEqual((pressed["valid"], pressed["holds"]), (True, True))
        self.assertNotEqual(pressed["state_hash"], alone["state_hash"])

    def test_ground_and_levels_are_chosen(self):
        report = self.view(3, "0 tap G", "0 tap M")
        self.assertEqual((report["ground"], report["render_level"]), ("uneven", 1))
        again = self.view(4, "0 tap G", "1 tap G", "2 tap G", "3 tap G", "3 tap M", "3 tap M", "3 tap M")
        self.assertEqual((again["ground"], again["render_level"]), ("flat", 0))
        self.assertEqual(self.view(2, more=("--ground", "slope:5"))["ground"], "as given")

    def test_beginning_again_is_beginning(self):
        again = self.view(20, "0 down W", "5 up W", "6 tap B", "12 tap R")
        self.assertEqual(again["frames"], 8)
        self.assertEqual(again["balls_thrown"], 1)
        self.assertTrue(again["valid"])

    def test_inputs_are_recorded_and_replayed(self):
        record = self.path("played.sbrec")
        shown = self.view(40, "0 down W", "20 press 0.5 0.5", "24 move 0.5 0.3", more=("--record", record))
        self.assertTrue(shown["holds"])
        ran = self.json_of("run", self.file, "--replay", record)
        self.assertTrue(ran["replay_same"])
        self.assertEqual(ran["state_hash"], shown["state_hash"])
        self.assertEqual(self.view(40, more=("--replay", record))["state_hash"], shown["state_hash"])

    def test_wrong_calls_are_reported(self):
        at = ("view", self.file, *SMALL)
        printed = self.fails(2, *at, "--frames", "1", environment={**QUIET, "DISPLAY": ":999"})
        self.assertIn("display", printed)
        nowhere = {name: "" for name in ("DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER", "XDG_RUNTIME_DIR")}
        printed = self.fails(2, *at, "--frames", "1", environment=nowhere)  # not on a screen that SDL makes up
        self.assertIn("display", printed)
        self.fails(2, *at, "--frames", "0", environment=self.environment)
        self.fails(2, *at, "--frames", "1", "--input", self.path("none.txt"), environment=self.environment)
        self.fails(2, *at, "--frames", "1", "--shot", self.path("no/folder.png"), environment=self.environment)
        for wrong in ("x", "1 jump", "1 down Nokey", "5 tap W\n4 tap W", "1 press 2 0", "1 press 0.5", "1 wheel x", "1 shot",
                      "1 release now", "1 tap W" + " " * 2000):
            script = write_bytes(self.path("wrong.txt"), b"# first\n" + wrong.encode() + b"\n")
            printed = self.fails(1, *at, "--frames", "1", "--input", script, environment=self.environment)
            self.assertRegex(printed, r"wrong\.txt, line \d")
        self.assertFalse(os.path.exists(self.path("no")))

    @unittest.skipUnless(shutil.which("xdotool"), "there is no xdotool to press keys with")
    def held(self, shot, seconds):
        """W pressed for some time, then a ball, another size and the end, as keyboard events; returns the output."""
        program = subprocess.Popen([PROGRAM, "view", self.file, *SMALL, "--shot", shot, "--format", "json"],
                                   env={**os.environ, **self.environment}, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

        def tool(*words):
            return subprocess.run(["xdotool", *words], env={**os.environ, **self.environment}, capture_output=True, text=True,
                                  timeout=120, check=True).stdout.split()

        try:
            window = tool("search", "--sync", "--onlyvisible", "--name", "sbfmt")[0]
            tool("windowfocus", "--sync", window, "keydown", "w")
            time.sleep(seconds)
            tool("keyup", "w", "key", "b", "windowsize", "--sync", window, "320", "240")
            time.sleep(2)
            tool("key", "Escape")
            out, err = program.communicate(timeout=200)
        finally:
            program.kill()
        self.assertEqual(program.returncode, 0, err)
        return json.loads(out)

    def test_a_keyboard_and_a_new_size(self):
        shot = self.path("last.png")
        for seconds in (3, 10, 30):  # a busy machine may not have drawn a frame by then
            report = self.held(shot, seconds)
            if report["walked"] > 0:
                break
        self.assertGreater(report["walked"], 0)
        self.assertEqual(report["balls_thrown"], 1)
        self.assertEqual(read_png(read_bytes(shot))[:2], (320, 240))


class WithoutDisplay(ProgramTest):
    def test_help_names_the_keys(self):
        printed = self.good("view", "--help").out
        for word in ("W A S D", "--input", "--shot"):
            self.assertTrue(re.search(re.escape(word), printed), word)


if __name__ == "__main__":
    main()
