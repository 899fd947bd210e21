"""Tests dense skins: soft parts are chosen on fewer vertices to save memory, and the result keeps all vertices."""

import resource
import subprocess

import large_inputs
from sbfmt_program import PROGRAM, ProgramTest, main

VERTICES, BONES = 40000, 30
LIMIT = 300 << 20  # bytes; trials on the whole skin need more than 400 MB


class Dense(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.source = large_inputs.character(cls.made("dense.glb"), VERTICES, BONES)

    def test_a_dense_skin_is_chosen_for_in_little_memory(self):
        out = self.path("dense.sbfz")

        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (LIMIT, LIMIT))

        done = subprocess.run([PROGRAM, "convert", self.source, "-o", out], capture_output=True, text=True, check=False,
                              preexec_fn=limit)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("element visits a tick", done.stderr)
        mesh, = self.json_of("info", out)["render_meshes"]
        self.assertGreater(mesh["vertices"], 0.95 * VERTICES)


if __name__ == "__main__":
    main()
