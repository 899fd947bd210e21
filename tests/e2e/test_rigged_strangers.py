"""Tests third-party meshes with our skeletons: a cow, an armadillo at three resolutions, a person with captured motion."""

import json
import math
import os
import unittest

import obj_variants as variants
from bundle_file import Bundle
from bvh_file import write_bvh
from posed_inputs import write_bones
from rigged_weights import Original, weights_by_vertex
from sbfmt_program import SOURCE_PARTS, ProgramTest, call, main, shared, write_bytes


def mirrored(joints):
    """Joints of the left side with those of the right, whose x is turned."""
    return joints + [(name.replace("Left", "Right"), parent and parent.replace("Left", "Right"), (-x, y, z))
                     for name, parent, (x, y, z) in joints if "Left" in name]


# Joints by name, parent and position in the units of the meshes. Both face -Z: left is -X.
SPOT = mirrored([
    ("Hips", None, (0, -0.05, 0.75)), ("Spine", "Hips", (0, -0.05, 0.4)), ("Chest", "Spine", (0, -0.05, 0.1)),
    ("Neck", "Chest", (0, 0.15, -0.12)), ("Head", "Neck", (0, 0.4, -0.3)), ("Head_end", "Head", (0, 0.4, -0.6)),
    ("LeftUpLeg", "Hips", (-0.2, -0.2, 0.75)), ("LeftLeg", "LeftUpLeg", (-0.2, -0.42, 0.8)),
    ("LeftFoot", "LeftLeg", (-0.2, -0.64, 0.8)), ("LeftFoot_end", "LeftFoot", (-0.2, -0.7, 0.72)),
    ("LeftArm", "Chest", (-0.22, -0.2, 0.08)), ("LeftForeArm", "LeftArm", (-0.23, -0.42, 0.06)),
    ("LeftHand", "LeftForeArm", (-0.24, -0.64, 0.04)), ("LeftHand_end", "LeftHand", (-0.24, -0.7, -0.06))])
ARMADILLO = [
    ("Hips", None, (-0.2, 1.3, 1.2)), ("Spine", "Hips", (-0.2, 2.6, 1.2)), ("Chest", "Spine", (0, 4.6, 1.2)),
    ("Neck", "Chest", (0, 6.3, 0.3)), ("Head", "Neck", (0, 7.4, -0.5)), ("Head_end", "Head", (0, 7.4, -3)),
    ("LeftUpLeg", "Hips", (-2.2, 0.3, 1.2)), ("LeftLeg", "LeftUpLeg", (-3.2, -2, 1.1)),
    ("LeftFoot", "LeftLeg", (-3.2, -4.2, 1.4)), ("LeftFoot_end", "LeftFoot", (-3.9, -4.9, 0)),
    ("RightUpLeg", "Hips", (1.6, 0.3, 1.2)), ("RightLeg", "RightUpLeg", (2.4, -2, 1.2)),
    ("RightFoot", "RightLeg", (2.35, -4.3, 1.7)), ("RightFoot_end", "RightFoot", (2.8, -4.9, 0.3)),
    ("LeftArm", "Chest", (-2.4, 5.4, 0.6)), ("LeftForeArm", "LeftArm", (-4, 5.7, -0.6)),
    ("LeftHand", "LeftForeArm", (-4.9, 6.1, -2.2)), ("LeftHand_end", "LeftHand", (-5.5, 7, -4.2)),
    ("RightArm", "Chest", (2.4, 5.4, 0.6)), ("RightForeArm", "RightArm", (4, 5.6, -0.4)),
    ("RightHand", "RightForeArm", (4.8, 6.5, -1.6)), ("RightHand_end", "RightHand", (5.4, 7.8, -3.4)),
    ("Tail1", "Hips", (-0.2, 0.6, 2.8)), ("Tail2", "Tail1", (-0.2, -0.4, 4.1)), ("Tail2_end", "Tail2", (-0.2, -0.4, 5.2))]

# Fractions of points: 95.4 % and 97.7 % measured.
LEAST_4K, LEAST_1K = 0.94, 0.96


def strongest(weights):
    return max(weights, key=weights.get)


MOCAP = shared("mocap", "cmu_01_01.bvh")
PEOPLE = [shared("..", "zoo", *path) for path in (("modular_men", "Punk.glb"), ("modular_women", "Formal.glb"),
                                                  ("godot_demos", "mannequiny.glb"))]
PERSON = shared("..", "zoo", "modular_men", "Casual.glb")
LONG_COW = shared("..", "zoo", "animals_pack", "Cow.glb")
FROG = shared("..", "zoo", "easy_enemies_pack", "Frog.glb")


def needs(*paths):
    missing = [p for p in paths if not os.path.exists(p)]
    return unittest.skipIf(missing, f"{missing[:1]} is not there")


class Cow(ProgramTest):
    @needs(shared("spot", "spot.obj"))
    def test_it_walks_on_four_legs(self):
        write_bvh(self.path("cow.bvh"), SPOT)
        done = self.good("convert", shared("spot", "spot.obj"), "--rig", self.path("cow.bvh"), "-o", self.path("spot.sbf"))
        self.assertIn("computed from the bones", done.err)
        self.assertEqual(self.json_of("info", self.path("spot.sbf"))["gait"]["legs"], 4)
        run = self.json_of("run", self.path("spot.sbf"), "--seconds", 4, "--drive", "0.3,0")
        self.assertTrue(run["valid"])
        self.assertGreater(run["distance"], 0.9)
        for weights, (_, y, z) in weights_by_vertex(self.path("spot.sbf")).values():
            if y < 0.2:  # hooves, turned to look along +Z
                self.assertIn(strongest(weights)[-4:], ("Hand", "eArm") if z > -0.4 else ("Foot", "tLeg"))

    @needs(shared("spot", "spot.obj"), MOCAP)
    def test_the_skeleton_of_a_person_is_refused(self):
        printed = self.fails(1, "convert", shared("spot", "spot.obj"), "--rig", MOCAP, "--report", self.path("why.json"), "-o",
                          self.path("no.sbf"))
        self.assertRegex(printed, r"not all limbs were found: after '.*' were rotated, \d+ % of the bones' length is inside")
        self.assertIn("IMPORT_RIG_OUTSIDE", printed)
        self.assert_empty_folder(but=["why.json"])
        with open(self.path("why.json"), encoding="utf-8") as stream:
            self.assertEqual(len(json.load(stream)["bundle"]["render_meshes"]), 1)


    @needs(shared("spot", "spot.obj"), LONG_COW)
    def test_parts_without_bones_are_named(self):
        """All bones of a long cow lie in the fat one, but not in its head and legs."""
        printed = self.fails(1, "convert", shared("spot", "spot.obj"), "--rig", LONG_COW, "-o", self.path("no.sbf"))
        self.assertRegex(printed, r"outside are no bones, but (3[5-9]|[4-9]\d) % of the mesh has none near; .*IMPORT_RIG_OUTSIDE")


class Ball(ProgramTest):
    """A ball with 32 limbs from its middle to its surface, and short ones that end deep inside."""

    def convert(self, deep):
        angles = [(math.pi * i / 5, math.pi * j / 4) for i in range(1, 5) for j in range(8)]
        joints = [("Root", None, (0, 0, 0))]
        for k, (a, b) in enumerate(angles):
            joints += chain(f"Limb{k}", (math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)), (0.6, 0.9))
        for k in range(deep):
            joints += chain(f"Deep{k}", (math.cos(2.4 * k), math.sin(2.4 * k), math.cos(1.7 * k)), (0.1, 0.16, 0.22))
        write_bvh(self.path("star.bvh"), joints)
        write_bytes(self.path("ball.obj"), ball(24).encode())
        return call("convert", self.path("ball.obj"), "--rig", self.path("star.bvh"), *SOURCE_PARTS, "-o", self.path("out.sbf"))

    def test_inner_bones_without_skin_are_ignored(self):
        self.assertEqual(self.convert(0).status, 0)
        result = self.convert(60)
        self.assertEqual(result.status, 1)
        self.assertRegex(result.err, r"2\d % is deep inside, where other bones are nearer to the surface: 'Deep\d+.*IMPORT_RIG_OUTSIDE")


def chain(name, direction, distances):
    """Joints of a limb from the root, at these distances; the last is its end."""
    names = [*(f"{name}_{i}" for i in range(len(distances) - 1)), f"{name}_{len(distances) - 2}_end"]
    return [(own, above, tuple(d * x for x in direction)) for own, above, d in zip(names, ["Root", *names], distances)]


def ball(rings):
    """An OBJ of a ball of radius 1."""
    around, lines = 2 * rings, []
    for i in range(rings + 1):
        for j in range(around):
            a, b = math.pi * (i + 0.01 * (i == 0) - 0.01 * (i == rings)) / rings, math.pi * j / rings
            lines.append(f"v {math.sin(a) * math.cos(b):.6f} {math.sin(a) * math.sin(b):.6f} {math.cos(a):.6f}")
    for i in range(rings):
        for j in range(around):
            a, b = i * around + j + 1, i * around + (j + 1) % around + 1
            lines.append(f"f {a} {a + around} {b + around} {b}")
    for i in (0, rings):
        ring = [str(i * around + j + 1) for j in range(around)]
        lines.append("f " + " ".join(ring if i == 0 else reversed(ring)))
    return "\n".join(lines) + "\n"


class Armadillo(ProgramTest):
    def weights(self, obj):
        write_bvh(self.path("armadillo.bvh"), ARMADILLO)
        self.good("convert", obj, "--rig", self.path("armadillo.bvh"), *SOURCE_PARTS, "-o", self.path("out.sbf"))
        points = variants.read(obj).points
        return [(points[vertex], strongest(weights))
                for vertex, (weights, _) in weights_by_vertex(self.path("out.sbf")).items()]

    @needs(shared("armadillo", "armadillo_25k.obj"))
    def test_one_skeleton_moves_three_resolutions_equally(self):
        """Nearest points have the same strongest bone: the coarser the mesh, the wider the steps between them."""
        write_surface(shared("armadillo", "armadillo_4k"), self.path("4k.obj"), 5)
        fine = self.weights(shared("armadillo", "armadillo_25k.obj"))
        self.assertEqual({bone for _, bone in fine}, {name for name, _, _ in ARMADILLO if not name.endswith("_end")})
        for path, points, fraction in ((self.path("4k.obj"), 1000, LEAST_4K),
                                    (shared("armadillo", "armadillo_1k.obj"), 500, LEAST_1K)):
            coarse = self.weights(path)[::3]
            self.assertGreater(3 * len(coarse), points)
            same = sum(bone == min(fine, key=lambda f: math.dist(f[0], position))[1] for position, bone in coarse)
            self.assertGreaterEqual(same / len(coarse), fraction)


def write_surface(path, obj_path, scale):
    """The outer triangles of TetGen's tetrahedra as an OBJ."""
    rows = {}
    for ending in ".node", ".ele":
        with open(path + ending, encoding="ascii") as stream:
            rows[ending] = [line.split() for line in stream if line.strip() and not line.startswith("#")][1:]
    points = [tuple(scale * float(n) for n in row[1:4]) for row in rows[".node"]]
    sides = {}
    for row in rows[".ele"]:
        a, b, c, d = map(int, row[1:5])
        for side in ((a, c, b), (a, b, d), (b, c, d), (a, d, c)):
            sides.setdefault(tuple(sorted(side)), []).append(side)
    faces = [("all", None, [(p, None, None) for p in found[0]]) for found in sides.values() if len(found) == 1]
    surface = sorted({p for _, _, corners in faces for p, _, _ in corners})
    variants.write(variants.renumbered(variants.Obj(points, [], [], faces), surface), obj_path)


class Person(ProgramTest):
    @needs(PERSON, MOCAP)
    def test_captured_motion_moves_a_mesh_without_bones(self):
        original = Original(PERSON, self.class_folder.name)
        self.good("convert", original.obj_path, "--rig", MOCAP, "-o", self.path("person.sbf"))
        self.assertEqual(self.json_of("info", self.path("person.sbf"))["gait"]["legs"], 2)
        run = self.json_of("run", self.path("person.sbf"), "--seconds", 4, "--drive", "0.4,0")
        self.assertTrue(run["valid"])
        self.assertAlmostEqual(run["distance"], 1.48, delta=0.06)
        self.assertEqual(len(Bundle(self.path("person.sbf")).clips), 1)

    @needs(*PEOPLE, MOCAP)
    def test_the_same_motion_moves_other_people(self):
        """Their legs stand together and their arms point aside; those of the motion's rest pose do not."""
        for path in PEOPLE:
            with self.subTest(path):
                original = Original(path, self.folder)
                done = self.good("convert", original.obj_path, "--rig", MOCAP, *SOURCE_PARTS, "-o", self.path("person.sbf"))
                self.assertNotIn("turned by 180", done.err)
                self.assertEqual(self.json_of("info", self.path("person.sbf"))["gait"]["legs"], 2)


class Frog(ProgramTest):
    @needs(FROG)
    def test_bones_outside_the_mesh_are_reported(self):
        """A quarter of its own bones' length lies outside."""
        original = Original(FROG, self.folder)
        write_bones(FROG, self.path("bones.glb"))
        done = self.good("convert", original.obj_path, "--rig", self.path("bones.glb"), *SOURCE_PARTS, "-o", self.path("out.sbf"))
        self.assertRegex(done.err, r"warning: .* only \d+ % of the bones' length is inside the mesh; outside are '.*RIG_OTHER_MESH")


if __name__ == "__main__":
    main()
