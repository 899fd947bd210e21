"""Tests walks of walks.py against their limits: all walks of the two lizards and some others; of all other characters those on
flat ground, and straight ones elsewhere. Takes minutes."""

import concurrent.futures
import os
import unittest

from sbfmt_program import ROOT, ProgramTest, convert_once, example, liz, main, needs_lizard, shared
from walks import all_walks, failures, leg_of, measure, straight

# Criteria that are not met, with the measured values.
EXAMPLE = {}
THESIS = {}

# Of a caterpillar's stumps, driven beyond their speed: they are attached to a chain with its own motion.
CRAWLS = {"stance_slip": 0.0023, "skate_ratio": 0.004, "knee_speed_step": 12.3, "body_speed_step": 0.0029}

# On flat ground: files, options, and criteria that they do not meet.
OTHERS = {
    "pup": ((ROOT, "examples", "pup", "pup.glb"), (), {}),
    "calf": ((ROOT, "examples", "calf", "calf.glb"), (), {}),
    "yeti": ((ROOT, "examples", "yeti", "yeti.glb"), (), {}),
    "spider": ((ROOT, "examples", "spider", "spider.glb"), (), {}),
    "kenney": ((shared("kenney-fbx"), "kenney_character.fbx"), (), {}),
    "greenman": ((shared("greenman"), "greenman.glb"), (), {
        "flat, 0.1": {"support_margin": -0.34}, "flat, 0.3": {"support_margin": -0.34}}),
    "fox": ((shared("fox"), "fox.glb"), ("--unit", "0.01"), {}),
    # All of its soft parts: with its fine skin the default budget suffices for few, and rigid ones shift its centre of mass.
    "walkdae": ((shared("walk-dae"), "walk.dae"), ("--budget", "none"), {}),
    # With the abdomen in the pose of its idle clip, the body drops once while eight legs run up stairs.
    "spiderglb": ((shared("spider"), "spider.glb"), (), {"stairs of a quarter leg, 3": {"body_speed_step": 0.0929}}),
    "caterpillar": ((ROOT, "examples", "caterpillar", "caterpillar.glb"), (), {
        "flat, 2": CRAWLS, "flat, 3": CRAWLS, "flat, turning on the spot": CRAWLS, "flat, a curve": CRAWLS,
        "flat, forward, then back": CRAWLS}),
}

# All walks on every ground meet all criteria.
EVERYWHERE = ("spiderglb",)

# Straight walks off flat ground: criteria that they do not meet.
OFF_FLAT_SPEEDS = (0.1, 0.3, 1, 3)
OFF_FLAT = {
    "pup": {},
    "calf": {"stairs of a quarter leg, 3": {"penetration": 0.00103}},
    "yeti": {},
    "kenney": {"stairs of a quarter leg, 0.3": {"support_margin": -0.041},
               **{f"noise, {speed}": {"penetration": 0.0061} for speed in OFF_FLAT_SPEEDS}},
    "walkdae": {"slope of 20°, 0.1": {"support_margin": -0.066}, "slope of 20°, 0.3": {"support_margin": -0.042},
                "stairs of a quarter leg, 1": {"body_speed_step": 0.0301, "body_turn_step": 1.71},
                "stairs of a quarter leg, 3": {"body_speed_step": 0.0542, "body_turn_step": 3.2}},
    "spider": {},
    "fox": {},
}


def missed_of(file, walks, known):
    """Criteria that the walks of a file do not meet, without the known ones."""
    leg = leg_of(file)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        reports = list(pool.map(lambda walk: measure(file, walk, leg), walks))
    return [text for walk, report in zip(walks, reports) for text in failures(report, walk, leg, known.get(walk.name))]


class Walks:
    make, known = None, {}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = cls.make(cls.class_folder.name)

    def test_all_of_them(self):
        self.assertEqual(missed_of(self.file, all_walks(), self.known), [])


class Others(ProgramTest):
    def file_of(self, name):
        position, options, _ = OTHERS[name]
        if not os.path.exists(os.path.join(*position)):
            self.skipTest(f"{position[-1]} is not there")
        return convert_once(self.class_folder.name, name + ".sbf", os.path.join(*position), *options)

    def test_flat_walks_and_some_everywhere(self):
        for name, (_, _, known) in OTHERS.items():
            walks = [walk for walk in all_walks() if walk.ground == "flat" or name in EVERYWHERE]
            with self.subTest(name):
                self.assertEqual(missed_of(self.file_of(name), walks, known), [])

    def test_walks_off_flat_ground(self):
        walks = [straight(kind, speed) for kind in ("slope of 20°", "stairs of a quarter leg", "noise")
                 for speed in OFF_FLAT_SPEEDS]
        for name, known in OFF_FLAT.items():
            with self.subTest(name):
                self.assertEqual(missed_of(self.file_of(name), walks, known), [])


class ExampleLizard(Walks, ProgramTest):
    make, known = staticmethod(example), EXAMPLE


@needs_lizard
class ThesisLizard(Walks, ProgramTest):
    make, known = staticmethod(liz), THESIS


if __name__ == "__main__":
    unittest.TestCase.longMessage = True
    main()
