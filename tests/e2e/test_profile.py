#!/usr/bin/env python3
"""`sbfmt run --profile` and `--trace`: times by stage and counters, and a trace that viewers open; the motion is the same."""
import json
import os

from sbfmt_program import ROOT, ProgramTest, call, main, read_text

STAGES = ["colliders", "detail", "broad_phase", "animation", "contact_groups", "islands", "events"]
SECONDS, TICKS = "0.5", 30


class Profile(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = os.path.join(cls.class_folder.name, "pup.sbf")
        result = call("convert", os.path.join(ROOT, "examples", "pup", "pup.glb"), "-o", cls.file)
        assert result.status == 0, result.err

    def test_stage_times_add_up_to_the_tick(self):
        plain = self.json_of("run", self.file, "--seconds", SECONDS)
        timed = self.json_of("run", self.file, "--seconds", SECONDS, "--profile")
        self.assertEqual(timed["state_hash"], plain["state_hash"])
        self.assertNotIn("profile", plain)
        profile = timed["profile"]
        self.assertEqual(list(profile), ["tick", *STAGES, "skin"])
        self.assertGreater(profile["islands"], 0)
        self.assertAlmostEqual(sum(profile[stage] for stage in STAGES), profile["tick"], delta=1e-3 * profile["tick"])

    def test_counters_are_those_of_the_file(self):
        info = self.json_of("info", self.file)
        counters = self.json_of("run", self.file, "--seconds", SECONDS, "--profile")["counters"]
        self.assertEqual(counters["soft_bodies"], len(info["sections"]))
        self.assertEqual(counters["rigid_bodies"], info["rigid_bodies"])
        self.assertGreaterEqual(counters["springs"], info["springs"]["internal"])
        self.assertGreater(counters["element_visits"], TICKS)
        self.assertGreater(counters["memory_bytes"], counters["state_bytes"])

    def test_a_trace_has_every_stage_of_every_tick_in_order(self):
        trace = self.path("trace.json")
        self.good("run", self.file, "--seconds", SECONDS, "--trace", trace)
        events = [event for event in json.loads(read_text(trace))["traceEvents"] if event["ph"] == "X"]
        for number in range(1, TICKS + 1):
            tick, *stages, skin = [event for event in events if event["args"]["tick"] == number]
            self.assertEqual([tick["name"], skin["name"]], ["tick", "skin"])
            self.assertEqual([stage["name"] for stage in stages], STAGES)
            end = tick["ts"]
            for stage in stages:
                self.assertGreaterEqual(stage["ts"], end - 0.002)
                end = stage["ts"] + stage["dur"]
            self.assertAlmostEqual(end, tick["ts"] + tick["dur"], delta=0.01)
            self.assertGreaterEqual(skin["ts"], end - 0.002)

    def test_failed_writes_are_reported(self):
        result = call("run", self.file, "--trace", os.path.join(self.path("missing"), "trace.json"))
        self.assertEqual(result.status, 2)
        self.assertIn("cannot write", result.err)
        result = call("run", self.file, "--trace", self.path("trace.txt"))
        self.assertEqual(result.status, 2)
        self.assertIn(".json", result.err)


if __name__ == "__main__":
    main()
