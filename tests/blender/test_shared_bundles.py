"""Real files, converted: imported and exported again they are equal. Unusual content must neither be lost nor stop Blender."""

import glob
import os

import fixtures


class Shared(fixtures.RoundTripTest):
    def test_every_file_round_trips(self):
        paths = sorted(glob.glob(os.path.join(fixtures.BUNDLES, "*.sbf")))
        self.assertGreater(len(paths), 30)
        for path in paths:
            with self.subTest(os.path.basename(path)):
                fixtures.fresh_scene()
                self.comes_back_equal(path)
