"""Characters that strangers send: beside the origin, several in a file, lying, tiny. Each walks, or a finding says what to do."""

from bundle_file import matrix_of
from sbfmt_program import SOURCE_PARTS, ProgramTest, main
from stranger_rigs import people, turned


class StrangerRigs(ProgramTest):
    def converted(self, *placed, options=()):
        """The messages of the conversion of a file with people at these places."""
        people(self.path("in.glb"), *placed)
        return self.good("convert", self.path("in.glb"), *SOURCE_PARTS, *options, "-o", self.path("out.sbf")).err

    def walk(self, *options):
        return self.json_of("run", self.path("out.sbf"), "--seconds", "2", "--drive", "0.4,0.3", *options)

    def test_who_stands_aside_walks_as_in_the_middle(self):
        self.converted(matrix_of())
        expected = self.walk()
        self.assertGreater(expected["distance"], 0.3)
        said = self.converted(matrix_of((2, 0, 0)))
        self.assertIn("[IMPORT_GROUND]", said)
        self.assertNotIn("[RIG_NO_LEGS]", said)
        self.assertEqual(self.walk()["steps_taken"], expected["steps_taken"])
        self.assertAlmostEqual(self.walk()["distance"], expected["distance"], delta=1e-4)
        self.assertIn("[IMPORT_GROUND]", self.converted(turned("y", 90, (2, 0, 3))))
        self.assertAlmostEqual(self.walk()["distance"], expected["distance"], delta=0.05)


if __name__ == "__main__":
    main()
