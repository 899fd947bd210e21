"""Every walk of walks.py of the two lizards, and those on flat ground of other characters, against what was asked for.
Takes minutes."""

import concurrent.futures
import os
import unittest

from sbfmt_program import ROOT, ProgramTest, convert_once, example, liz, main, needs_lizard, shared
from walks import all_walks, failures, leg_of, measure

# What is not met, and how far off it is.
EXAMPLE = {
    "slope of 20°, 3": {"knee_speed_step": 6},
    "stairs of a quarter leg, 2": {"knee_speed_step": 7},
    "stairs of a quarter leg, 3": {"knee_speed_step": 7, "stance_slip": 0.0018},
}
THESIS = {}

# On flat ground: files, options, and what is not met.
OTHERS = {
    "pup": ((ROOT, "examples", "pup", "pup.glb"), (), {}),
    "calf": ((ROOT, "examples", "calf", "calf.glb"), (), {}),
    "yeti": ((ROOT, "examples", "yeti", "yeti.glb"), (), {
        "flat, 0.1": {"support_margin": -0.0105}, "flat, 0.3": {"support_margin": -0.0095},
        "flat, starting, stopping, aside": {"body_speed_step": 0.013}}),
    "spider": ((ROOT, "examples", "spider", "spider.glb"), (), {}),
    "kenney": ((shared("kenney-fbx"), "kenney_character.fbx"), (), {}),
    "greenman": ((shared("greenman"), "greenman.glb"), (), {
        "flat, 0.1": {"support_margin": -0.35}, "flat, 0.3": {"support_margin": -0.36}}),
    "fox": ((shared("fox"), "fox.glb"), ("--unit", "0.01"), {}),
    "walkdae": ((shared("walk-dae"), "walk.dae"), (), {
        "flat, 0.1": {"support_margin": -0.06}, "flat, 0.3": {"support_margin": -0.06}}),
}


def missed_of(file, walks, known):
    """What the walks of a file miss but for what is known."""
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


class OthersOnFlatGround(ProgramTest):
    def test_flat_walks(self):
        for name, (place, options, known) in OTHERS.items():
            with self.subTest(name):
                if not os.path.exists(os.path.join(*place)):
                    self.skipTest(f"{place[-1]} is not there")
                file = convert_once(self.class_folder.name, name + ".sbf", os.path.join(*place), *options)
                walks = [walk for walk in all_walks() if walk.ground == "flat"]
                self.assertEqual(missed_of(file, walks, known), [])


class ExampleLizard(Walks, ProgramTest):
    make, known = staticmethod(example), EXAMPLE


@needs_lizard
class ThesisLizard(Walks, ProgramTest):
    make, known = staticmethod(liz), THESIS


if __name__ == "__main__":
    unittest.TestCase.longMessage = True
    main()
