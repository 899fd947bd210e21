"""An OBJ with a skeleton that has no mesh: weights computed from the bones, shells given to bones, and what is refused."""

import math
import os

from rigged_weights import weights_by_vertex
from sbfmt_program import ProgramTest, main

BONES = (("upper", 0.0), ("fore", 1.0), ("hand", 2.0))


def tube(lines, start, end, radius, rings, height, base):
    """Appends a closed tube along x of 12 sides; returns the number of the next point, from 1."""
    sides = 12
    for i in range(rings + 1):
        for k in range(sides):
            angle = 2 * math.pi * k / sides
            lines.append(f"v {start + (end - start) * i / rings:.6f} {height + radius * math.cos(angle):.6f} "
                         f"{radius * math.sin(angle):.6f}")
    for i in range(rings):
        for k in range(sides):
            a, b = base + i * sides + k, base + i * sides + (k + 1) % sides
            lines.append(f"f {b} {b + sides} {a + sides} {a}")
    lines.append("f " + " ".join(str(base + k) for k in range(sides)))
    lines.append("f " + " ".join(str(base + rings * sides + k) for k in reversed(range(sides))))
    return base + (rings + 1) * sides


def write_arm(path):
    """An arm of 372 points from x = 0 to 3, and an object of two buttons of 36 beside it."""
    lines = ["o arm"]
    after = tube(lines, 0, 3, 0.2, 30, 0, 1)
    lines.append("o buttons")
    after = tube(lines, 0.45, 0.55, 0.04, 2, 0.3, after)
    tube(lines, 1.45, 1.55, 0.04, 2, 0.3, after)
    with open(path, "w", encoding="ascii") as stream:
        stream.write("\n".join(lines) + "\n")


def write_bones(path, shift=0.0):
    text, pad = ["HIERARCHY"], ""
    for i, (name, x) in enumerate(BONES):
        offset = (x - BONES[i - 1][1]) if i else x
        text += [f"{pad}{'JOINT' if i else 'ROOT'} {name}", pad + "{", f"{pad} OFFSET {offset} {shift if not i else 0} 0",
                 f"{pad} CHANNELS 3 Zrotation Xrotation Yrotation"]
        pad += " "
    text += [pad + "End Site", pad + "{", f"{pad} OFFSET 0.9 0 0", pad + "}"] + ["}"] * len(BONES)
    text += ["MOTION", "Frames: 1", "Frame Time: 0.04", " ".join(["0"] * 3 * len(BONES)), ""]
    with open(path, "w", encoding="ascii") as stream:
        stream.write("\n".join(text))


class ComputedWeights(ProgramTest):
    def setUp(self):
        super().setUp()
        self.obj, self.rig = self.path("arm.obj"), self.path("arm.bvh")
        write_arm(self.obj)
        write_bones(self.rig)

    def weights(self, *options):
        out = self.path("arm.sbf")
        done = self.good("convert", self.obj, "--rig", self.rig, "--no-build", "-o", out, *options)
        return {i: weight for i, (weight, _) in weights_by_vertex(out).items()}, done.err

    def test_each_bone_holds_its_part(self):
        weights, told = self.weights()
        self.assertIn("computed from 3 bones: 2 of 3 shells move with one bone each", told)
        self.assertEqual(len(weights), 372 + 72)
        for i in range(372):
            x = 0.1 * (i // 12)
            for name, start in BONES:
                if abs(x - start - 0.5) < 0.25:
                    self.assertGreater(weights[i].get(name, 0), 0.9, (x, weights[i]))
        for i in range(372, 444):
            self.assertEqual(weights[i], {"upper": 1} if i < 408 else {"fore": 1})

    def test_shells_follow_the_bones_they_are_given_to(self):
        weights, _ = self.weights("--shell", "buttons#2=hand")
        for i in range(372, 444):
            self.assertEqual(weights[i], {"upper": 1} if i < 408 else {"hand": 1})
        weights, _ = self.weights("--shell", "buttons=fore")
        for i in range(372, 444):
            self.assertEqual(weights[i], {"fore": 1})

    def test_shells_and_bones_that_are_not_there(self):
        for wish, word in (("hat=hand", "'hat'"), ("buttons#3=hand", "consists of 2"), ("buttons=tail", "'tail'"),
                           ("buttons", "--shell takes"), ("buttons#0=hand", "'buttons#0'")):
            status = 2 if wish == "buttons" else 1
            done = self.fails(status, "convert", self.obj, "--rig", self.rig, "-o", self.path("no.sbf"), "--shell", wish)
            self.assertIn(word, done)
        done = self.fails(2, "convert", self.obj, "-o", self.path("no.sbf"), "--shell", "arm=hand")
        self.assertIn("--rig", done)
        self.assertFalse(os.path.exists(self.path("no.sbf")))

    def test_a_mesh_of_one_triangle(self):
        with open(self.obj, "w", encoding="ascii") as stream:
            stream.write("v 0 0 0\nv 3 0 0\nv 0 0.1 0\nf 1 2 3\n")
        self.fails(1, "convert", self.obj, "--rig", self.rig, "-o", self.path("no.sbf"), "--weights", "compute")
        self.assertFalse(os.path.exists(self.path("no.sbf")))


if __name__ == "__main__":
    main()
