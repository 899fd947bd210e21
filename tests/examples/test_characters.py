"""The modelled characters of examples/: their files are what the scripts make, and a check can fail."""

import os
import subprocess
import sys
import tempfile
import unittest

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, os.pardir, "examples")
sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(EXAMPLES, "modelling"))

from implicit import Body, beyond, mesh_of, paint, refine, within  # noqa: E402
from quad_mesh import check_mirror, check_surface  # noqa: E402
from made_files import where_they_were_made  # noqa: E402
from skin_files import planted, triangles_of  # noqa: E402
from model_files import Bone  # noqa: E402

NAMES = ("caterpillar", "dragon", "koi", "pudding", "pup", "snake", "spider", "yeti")


def make(name, *arguments):
    script = os.path.join(EXAMPLES, name, f"make_{name}.py")
    return subprocess.run([sys.executable, "-B", script, *arguments], capture_output=True, text=True, check=False)


class Files(unittest.TestCase):
    @where_they_were_made
    def test_they_are_up_to_date(self):
        for name in NAMES:
            done = make(name, "--check")
            self.assertEqual((done.returncode, done.stderr), (0, ""), name)

    def test_another_file_is_found_out(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(EXAMPLES, "snake", "snake.glb"), "rb") as stream:
                data = stream.read()
            with open(os.path.join(folder, "snake.glb"), "wb") as stream:
                stream.write(data[:-1])
            done = make("snake", "--check", "-o", folder)
            self.assertEqual(done.returncode, 1)
            self.assertIn("snake.glb is stale", done.stderr)


class Shapes(unittest.TestCase):
    def two_balls(self):
        body = Body()
        body.both(body.ball, (0.08, 0.1, 0.0), 0.1, melt=0.05)
        return body

    def test_parts_melt_into_one_closed_symmetric_surface(self):
        mesh = mesh_of(self.two_balls(), 0.02, "dumb-bell")
        self.assertEqual(check_surface(mesh) + check_mirror(mesh, mesh), [])
        for x, y, z in mesh.points:
            self.assertAlmostEqual(self.two_balls()(abs(x), y, z), 0.0, delta=0.001)

    def test_a_cleft_does_not_join_three_faces_at_an_edge(self):
        body = Body()
        body.ball((0.0, 0.1, 0.0), 0.1)
        body.both(body.cone, (0.013, 0.1, 0.0), (0.013, 0.1, 0.2), 0.012, 0.012, melt=0.0)  # almost touching
        mesh = mesh_of(body, 0.02, "prongs")
        edges = mesh.directed_edges()
        self.assertEqual(max(edges.values()), 1)
        self.assertTrue(all((b, a) in edges for a, b in edges))

    def test_flat_parts_leave_no_hole(self):
        body = Body()
        body.ball((0.0, 0.1, 0.0), (0.06, 0.08, 0.2))
        body.ball((0.0, 0.1, -0.3), (0.012, 0.15, 0.12), melt=0.02, tilt=(35, 0, 0))
        self.assertEqual(check_surface(mesh_of(body, 0.014, "fin")), [])

    def test_colours_have_common_borders(self):
        body, field = self.two_balls(), beyond((0.0, 0.11, 0.0), (0.0, 1.0, 0.0))
        mesh = paint(refine(mesh_of(body, 0.03, "half"), body, within((0.1, 0.2, 0.0), 0.05)), body, [("top", field)], "base")
        self.assertEqual(check_surface(mesh) + check_mirror(mesh, mesh), [])
        self.assertEqual({f.material for f in mesh.faces}, {"top", "base"})
        for face in mesh.faces:
            heights = [mesh.points[c][1] - 0.11 for c in face.corners]
            wrong = min(heights) if face.material == "top" else -max(heights)
            self.assertGreater(wrong, -0.004)

    def test_soles_follow_the_foot_alone(self):
        side = (1.0, 0.0, 0.0)
        bones = [Bone("shin", None, (0, 0.5, 0), (0, 0.1, 0), side), Bone("foot", "shin", (0, 0.1, 0), (0, 0.02, 0.1), side)]
        held = [[(0, 0.6), (1, 0.4)]] * 3
        low, middle, high = planted([(0, 0.01, 0), (0, 0.15, 0), (0, 0.3, 0)], bones, held, 0.1)
        self.assertEqual(low, [(1, 1.0)])
        self.assertEqual([i for i, _ in middle], [1, 0])
        self.assertAlmostEqual(dict(middle)[0], 0.3)
        self.assertEqual(dict(high), {0: 0.6, 1: 0.4})

    def test_polygons_become_triangles_without_slivers(self):
        square = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)]  # the second corner lies on an edge
        order = triangles_of(square)
        for a, b, c in zip(order[::3], order[1::3], order[2::3]):
            (ax, ay, _), (bx, by, _), (cx, cy, _) = square[a], square[b], square[c]
            self.assertGreater((bx - ax) * (cy - ay) - (by - ay) * (cx - ax), 0.5)


if __name__ == "__main__":
    unittest.main()
