"""Every walk of walks.py, of the example lizard and of the thesis's, against what was asked for. Takes minutes."""

import concurrent.futures
import os
import unittest

from sbfmt_program import ProgramTest, example, liz, main, needs_lizard
from walks import all_walks, failures, leg_of, measure

# What is not met, and how far off it is.
EXAMPLE = {
    "slope of 20°, 3": {"knee_speed_step": 10},
    "stairs of a quarter leg, 0.3": {"support_margin": -0.0005},
    "stairs of a quarter leg, 2": {"knee_speed_step": 12, "stance_slip": 0.0015, "body_speed_step": 0.0075},
    "stairs of a quarter leg, 3": {"knee_speed_step": 18, "stance_slip": 0.0025, "skate_ratio": 0.004,
                                   "body_speed_step": 0.009},
    "stairs of a quarter leg, a curve": {"knee_speed_step": 7, "stance_slip": 0.003, "body_speed_step": 0.012,
                                         "body_turn_step": 3},
}
THESIS = {
    "flat, 3": {"stance_slip": 0.0025},
    "slope of 20°, 0.3": {"support_margin": -0.03},
    "stairs of a quarter leg, a curve": {"penetration": 0.06},
}


class Walks:
    make, known = None, {}

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = cls.make(cls.class_folder.name)
        cls.leg = leg_of(cls.file)

    def test_all_of_them(self):
        walks, missed = all_walks(), []
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            reports = pool.map(lambda walk: measure(self.file, walk, self.leg), walks)
        for walk, report in zip(walks, reports):
            missed += failures(report, walk, self.leg, self.known.get(walk.name))
        self.assertEqual(missed, [])


class ExampleLizard(Walks, ProgramTest):
    make, known = staticmethod(example), EXAMPLE


@needs_lizard
class ThesisLizard(Walks, ProgramTest):
    make, known = staticmethod(liz), THESIS


if __name__ == "__main__":
    unittest.TestCase.longMessage = True
    main()
