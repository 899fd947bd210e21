"""Tests `sbfmt run --record` and `--replay`: a recording replays to the bit, or the difference is reported."""

import os

from sbfmt_program import ProgramTest, call_limited, example, main, read_bytes, write_bytes

SCRIPT = b"""0 drive 0.3 0.1
0.2 drive 0.1 -0.4
0.5 teleport 1 0.2 2 0.5
0.8 reset
"""


class Replay(ProgramTest):
    def setUp(self):
        super().setUp()
        self.file = example(self.class_folder.name)
        self.tape = self.path("a.sbrec")

    def record(self, *options):
        script = write_bytes(self.path("script.txt"), SCRIPT)
        return self.json_of("run", self.file, "--seconds", "1.5", "--script", script, "--record", self.tape, *options)

    def test_a_replay_ends_in_the_same_state(self):
        recorded = self.record("--fps", "50")
        self.assertNotIn("replay_same", recorded)
        for options in ((), ("--threads", "3"), ("--instructions", "scalar")):
            played = self.json_of("run", self.file, "--replay", self.tape, *options)
            self.assertEqual(played["state_hash"], recorded["state_hash"])
            self.assertEqual((played["frames"], played["steps"]), (recorded["frames"], recorded["steps"]))
            self.assertTrue(played["replay_same"])
            self.assertGreaterEqual(played["replay_checks"], 3)
            self.assertIsNone(played["replay_differs_at_tick"])

    def test_another_scheme_is_reported_at_the_end(self):
        self.record()
        report = self.json_of("run", self.file, "--replay", self.tape, "--scheme", "position_based", status=1)
        self.assertFalse(report["replay_same"])
        self.assertLessEqual(report["replay_differs_at_tick"], 60)

    def test_another_start_is_reported_at_once(self):
        self.record()
        printed = self.fails(1, "run", self.file, "--replay", self.tape, "--raise", "3")
        self.assertIn("begins in another state", printed)

    def test_options_that_change_the_world_must_be_repeated(self):
        self.record("--hold")
        self.assertTrue(self.json_of("run", self.file, "--replay", self.tape, "--hold")["replay_same"])
        self.assertIn("another state", self.fails(1, "run", self.file, "--replay", self.tape))

    def test_truncated_recordings_play_to_their_end(self):
        self.record()
        whole = read_bytes(self.tape)
        write_bytes(self.tape, whole[: len(whole) // 2 + 5])
        played = self.json_of("run", self.file, "--replay", self.tape)
        self.assertTrue(played["replay_same"])
        self.assertGreater(played["frames"], 20)

    def test_unplayable_files_are_reported(self):
        self.record()
        whole = read_bytes(self.tape)
        write_bytes(self.tape, b"nothing of the kind")
        self.assertIn("not a recording", self.fails(1, "run", self.file, "--replay", self.tape))
        write_bytes(self.tape, whole[:40] + b"\xff" * 40 + whole[80:])
        self.assertIn("damaged", self.fails(1, "run", self.file, "--replay", self.tape))
        self.assertIn("cannot be read", self.fails(2, "run", self.file, "--replay", self.path("none")))
        self.assertIn("leave out --drive", self.fails(2, "run", self.file, "--replay", self.tape, "--drive", "1,0"))
        nowhere = os.path.join(self.path("no"), "x.sbrec")
        self.assertIn("cannot be written", self.fails(2, "run", self.file, "--record", nowhere))

    def test_incomplete_recordings_are_removed(self):
        result = call_limited(512, "run", self.file, "--seconds", "1", "--drive", "0.3,0.1", "--record", self.tape)
        self.assertEqual(result.status, 2)
        self.assertIn("cannot be written", result.err)
        self.assert_empty_folder()


if __name__ == "__main__":
    main()
