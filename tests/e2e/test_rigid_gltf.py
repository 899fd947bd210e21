"""Rigid bodies and joints of glTF files (KHR_physics_rigid_bodies): they become bundles that fall and swing as closed forms
say, are written into every .glb, and go round."""

import csv
import glob
import json
import math
import os
import unittest
from xml.etree import ElementTree

import json_schema
import play_files
from glb_file import Glb
from rigid_scenes import EXTENSION, Scene, glb_bytes
from sbfmt_program import ProgramTest, ROOT, call, example, main, shared, write_bytes

KHRONOS = shared(os.pardir, "khr-physics")
GRAVITY = 9.81
LINEAR, ANGULAR = {"linearAxes": [0, 1, 2], "min": 0, "max": 0}, {"angularAxes": [0, 1, 2], "min": 0, "max": 0}


def numbers(text):
    return [float(word) for word in (text or "").split()]


class RigidTest(ProgramTest):
    def convert(self, scene, name="scene"):
        """The bundle's path, and what was said."""
        source, bundle = self.path(name + ".glb"), self.path(name + ".sbf")
        write_bytes(source, scene if isinstance(scene, bytes) else scene.bytes())
        printed = self.good("convert", source, "-o", bundle).err
        self.good("validate", bundle)
        return bundle, printed

    def refused(self, scene):
        source = self.path("bad.glb")
        write_bytes(source, scene if isinstance(scene, bytes) else scene.bytes())
        printed = self.fails(1, "convert", source, "-o", self.path("bad.sbf"))
        self.assertIn("IMPORT_PHYSICS", printed)
        self.assertFalse(os.path.exists(self.path("bad.sbf")))
        return printed

    def parts(self, bundle):
        """The rigid bodies by name, and the joints in order."""
        root = ElementTree.parse(bundle).getroot()
        return {b.get("name"): b for b in root.find("rigid_bodies")}, list(root.find("joints") or [])

    def motion(self, bundle, seconds, *more):
        """(time, position, rotation) of each bone at each frame."""
        poses = self.path("poses.csv")
        self.good("run", bundle, "--seconds", seconds, "--pose", poses, *more)
        found = {}
        with open(poses, encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                found.setdefault(row["bone"], []).append((float(row["time"]), [float(row[k]) for k in ("px", "py", "pz")],
                                                          [float(row[k]) for k in ("qx", "qy", "qz", "qw")]))
        return found


class ClosedForms(RigidTest):
    def test_a_body_falls_by_its_gravity_factor(self):
        scene = Scene()
        for k, factor in enumerate((1, 0, -0.5, 2)):
            scene.body(f"body {factor}", at=(3 * k, 100, 0), mass=2, gravityFactor=factor)
        moves = self.motion(self.convert(scene)[0], 2)
        for factor in (1, 0, -0.5, 2):
            time, (_, height, _), _ = moves[f"body {factor}"][-1]
            self.assertAlmostEqual(height, 100 - 0.5 * GRAVITY * factor * time**2, delta=2e-3)

    def test_initial_velocities(self):
        scene, half = Scene(), math.sqrt(0.5)
        # Turned by 90 degrees about Y: +X of the node is -Z of the asset.
        scene.body("thrown", mass=1, rotation=(0, half, 0, half), linearVelocity=[3, 4, 0])
        scene.body("turning", at=(9, 50, 0), mass=1, gravityFactor=0, angularVelocity=[0, 0, 1.5],
                   collider=scene.shape("sphere", radius=0.5))
        bundle, _ = self.convert(scene)
        moves = self.motion(bundle, 1)
        for time, at, _ in moves["thrown"]:
            for value, wanted in zip(at, (0, 50 + 4 * time - 0.5 * GRAVITY * time**2, -3 * time)):
                self.assertAlmostEqual(value, wanted, delta=2e-3)
        for time, _, turn in moves["turning"]:
            self.assertAlmostEqual(2 * math.atan2(turn[2], turn[3]), 1.5 * time, delta=2e-3)
        self.assert_velocities_go_round(bundle)

    def assert_velocities_go_round(self, bundle):
        self.good("export", bundle, "-o", self.path("again.glb"))
        self.good("convert", self.path("again.glb"), "-o", self.path("again.sbf"))
        before, after = self.parts(bundle)[0], self.parts(self.path("again.sbf"))[0]
        for name, body in before.items():
            for key in ("velocity", "angular_velocity"):
                for x, y in zip(numbers(body.get(key, "0 0 0")), numbers(after[name].get(key, "0 0 0"))):
                    self.assertAlmostEqual(x, y, delta=1e-5)

    def test_a_hinge_swings_with_the_period_of_a_pendulum(self):
        scene, angle, length = Scene(), 0.4, 1.0
        turn = [0, 0, math.sin(angle / 2), math.cos(angle / 2)]
        # A rod of two cubes' length hangs from a pivot; it starts at an angle about Z.
        body = scene.body("rod", at=(length * math.sin(angle), 50 - length * math.cos(angle), 0), rotation=turn, mass=3,
                          collider=scene.shape("box", size=[0.2, 2, 0.2]))
        scene.joint(body, None, [LINEAR, {"angularAxes": [0, 1], "min": 0, "max": 0}], at=(0, length, 0), other_at=(0, 50, 0))
        bundle, _ = self.convert(scene)
        self.assertEqual([joint.tag for joint in self.parts(bundle)[1]], ["revolute_joint"])
        inertia = 3 * (0.2**2 + 2**2) / 12 + 3 * length**2
        # The first terms of the elliptic integral.
        period = 2 * math.pi * math.sqrt(inertia / (3 * GRAVITY * length)) * (1 + angle**2 / 16 + 11 * angle**4 / 3072)
        swing = [(time, 2 * math.atan2(z, w)) for time, _, (_, _, z, w) in self.motion(bundle, 6)["rod"]]
        zeros = [t + (u - t) * a / (a - b) for (t, a), (u, b) in zip(swing, swing[1:]) if a * b < 0]
        self.assertGreater(len(zeros), 4)
        self.assertAlmostEqual(zeros[0], period / 4, delta=2e-3 * period)
        for before, after in zip(zeros, zeros[1:]):
            self.assertAlmostEqual(after - before, period / 2, delta=2e-3 * period)

    def test_a_slider_stops_at_its_limit(self):
        scene = Scene()
        body = scene.body("block", mass=1)
        scene.joint(body, None, [{"linearAxes": [0, 2], "min": 0, "max": 0}, {"linearAxes": [1], "min": -0.5, "max": 0.75}, ANGULAR],
                    other_at=(0, 50, 0))
        bundle, _ = self.convert(scene)
        joint, = self.parts(bundle)[1]
        self.assertEqual(joint.tag, "prismatic_joint")
        _, at, turn = self.motion(bundle, 2)["block"][-1]
        # The connected node is at -0.5 .. 0.75 as seen from the body's: the body falls by 0.75.
        for value, wanted in zip(at + turn, (0, 49.25, 0, 0, 0, 0, 1)):
            self.assertAlmostEqual(value, wanted, delta=2e-3)

    def test_a_soft_limit_is_a_spring(self):
        scene, mass, stiffness = Scene(), 2, 80
        body = scene.body("weight", mass=mass)
        spring = {"linearAxes": [1], "min": 0, "max": 0, "stiffness": stiffness}
        scene.joint(body, None, [{"linearAxes": [0, 2], "min": 0, "max": 0}, spring, ANGULAR], other_at=(0, 50, 0))
        rate, sag = math.sqrt(stiffness / mass), mass * GRAVITY / stiffness
        heights = [(time, at[1]) for time, at, _ in self.motion(self.convert(scene)[0], 6)["weight"]]
        lows = [(u, b) for (_, a), (u, b), (_, c) in zip(heights, heights[1:], heights[2:]) if b <= a and b < c]
        self.assertAlmostEqual(lows[0][1], 50 - 2 * sag, delta=0.05 * sag)  # steps take some of the energy
        self.assertAlmostEqual((lows[-1][0] - lows[0][0]) / (len(lows) - 1), 2 * math.pi / rate, delta=0.01)

    def test_drives_reach_their_targets(self):
        scene = Scene()
        hinge = [LINEAR, {"angularAxes": [0, 1], "min": 0, "max": 0}]
        wheel = scene.body("wheel", mass=1)
        scene.joint(wheel, None, hinge, [{"type": "angular", "mode": "force", "axis": 2, "velocityTarget": 2, "damping": 5}],
                    other_at=(0, 50, 0))
        fast = scene.body("fast", at=(4, 50, 0), mass=7)
        scene.joint(fast, None, hinge, [{"type": "angular", "mode": "acceleration", "axis": 2, "velocityTarget": 2, "damping": 3}],
                    other_at=(4, 50, 0))
        lift = scene.body("lift", at=(8, 50, 0), mass=1)
        scene.joint(lift, None, [{"linearAxes": [0, 2], "min": 0, "max": 0}, ANGULAR],
                    [{"type": "linear", "mode": "force", "axis": 1, "positionTarget": 0.5, "stiffness": 1000, "damping": 60, "velocityTarget": 0}],
                    other_at=(8, 50, 0))
        moves = self.motion(self.convert(scene)[0], 1.5)
        # The world turns by +2 rad/s as seen from the wheel.
        (before, _, p), (after, _, q) = moves["wheel"][-10], moves["wheel"][-1]
        speed = 2 * math.remainder(math.atan2(q[2], q[3]) - math.atan2(p[2], p[3]), math.pi) / (after - before)
        self.assertAlmostEqual(speed, -2, delta=0.02)
        # w' = 3 (-2 - w): the moment of inertia does not matter.
        for time, _, q in moves["fast"][:60]:
            angle = -2 * (time - (1 - math.exp(-3 * time)) / 3)
            self.assertAlmostEqual(2 * math.atan2(q[2], q[3]), angle, delta=0.04)
        # The world is 0.5 m above the lift, less by its weight.
        self.assertAlmostEqual(moves["lift"][-1][1][1], 49.5 - GRAVITY / 1000, delta=2e-3)

    def test_a_fixed_joint_keeps_the_pose(self):
        scene = Scene()
        body = scene.body("sign", mass=5)
        scene.joint(body, None, [LINEAR, ANGULAR], at=(0, 2, 0), other_at=(0, 52, 0))
        arm = scene.body("arm", at=(1.5, 50, 0), mass=1)
        scene.joint(arm, body, [LINEAR, ANGULAR], at=(-0.75, 0, 0), other_at=(0.75, 0, 0))
        bundle, _ = self.convert(scene)
        self.assertEqual([joint.tag for joint in self.parts(bundle)[1]], ["fixed_joint"] * 2)
        for name, x in (("sign", 0), ("arm", 1.5)):
            _, at, turn = self.motion(bundle, 2)[name][-1]
            for value, wanted in zip(at + turn, (x, 50, 0, 0, 0, 0, 1)):
                self.assertAlmostEqual(value, wanted, delta=1e-3)

    def test_a_body_comes_to_rest_on_a_static_collider(self):
        scene = Scene()
        scene.body("box", at=(0, 52, 0), mass=1)
        scene.body("ball", at=(1.5, 52, 0), mass=1, collider=scene.shape("sphere", radius=0.5))
        scene.node("table", None, {"collider": scene.shape("box", size=[6, 1, 6])}, translation=[0, 50, 0])
        moves = self.motion(self.convert(scene)[0], 3)
        for name in ("box", "ball"):
            self.assertAlmostEqual(moves[name][-1][1][1], 51, delta=5e-3)

    def test_a_distance_and_a_cone(self):
        scene = Scene()
        ball = scene.body("ball", mass=1)
        scene.joint(ball, None, [{"linearAxes": [0, 1, 2], "max": 2}], other_at=(0, 50, 0))
        stick = scene.body("stick", at=(5, 50, 0), mass=1)
        scene.joint(stick, None, [LINEAR, {"angularAxes": [1, 2], "min": 0, "max": 0.5}], at=(-1, 0, 0), other_at=(4, 50, 0))
        bundle, _ = self.convert(scene)
        tags = [joint.tag for joint in self.parts(bundle)[1]]
        self.assertEqual(tags, ["distance_joint", "spherical_joint"])
        moves = self.motion(bundle, 3)
        self.assertAlmostEqual(moves["ball"][-1][1][1], 48, delta=5e-3)
        x, y, z = moves["stick"][-1][1]
        self.assertAlmostEqual(math.dist((x, y, z), (4, 50, 0)), 1, delta=2e-3)
        self.assertAlmostEqual(math.acos(x - 4), 0.5, delta=5e-3)


class Masses(RigidTest):
    SOLIDS = {
        "box": ({"size": [1, 2, 3]}, 6, (6 * 13 / 12, 6 * 10 / 12, 6 * 5 / 12)),
        "sphere": ({"radius": 0.5}, math.pi / 6, (math.pi / 60,) * 3),
        "cylinder": ({"height": 2, "radiusBottom": 0.5, "radiusTop": 0.5}, math.pi / 2,
                     (math.pi / 2 * (3 * 0.25 + 4) / 12, math.pi / 2 * 0.125, math.pi / 2 * (3 * 0.25 + 4) / 12)),
        "cone": ({"height": 2, "radiusBottom": 1, "radiusTop": 0}, 2 * math.pi / 3, None),
        "capsule": ({"height": 1, "radiusBottom": 0.25, "radiusTop": 0.25}, math.pi / 16 + math.pi / 48, None),
    }

    def test_of_shapes_without_a_mass(self):
        scene = Scene()
        for k, (name, (values, _, _)) in enumerate(self.SOLIDS.items()):
            scene.body(name, at=(4 * k, 50, 0), collider=scene.shape({"cone": "cylinder"}.get(name, name), **values))
        bodies, _ = self.parts(self.convert(scene)[0])
        for name, (_, volume, moments) in self.SOLIDS.items():
            self.assertAlmostEqual(float(bodies[name].get("mass")) / 1000, volume, delta=1e-5 * volume, msg=name)
            if moments:
                for have, want in zip(sorted(numbers(bodies[name].get("inertia"))), sorted(moments)):
                    self.assertAlmostEqual(have / 1000, want, delta=1e-5 * want, msg=name)
        # A cone's center of mass is at a quarter of its height: 1/2 m below the middle.
        self.assertAlmostEqual(numbers(bodies["cone"].get("center"))[1], 49.5, places=5)

    def test_scale_and_mirror(self):
        scene = Scene()
        scene.body("scaled", scale=(1, -2, 3))
        mass = float(self.parts(self.convert(scene)[0])[0]["scaled"].get("mass"))
        self.assertAlmostEqual(mass, 6000, delta=0.1)

    def test_a_compound_is_summed(self):
        scene = Scene()
        body = scene.body("dumbbell", collider=False)
        for side in (-1, 1):
            scene.node("weight", body, {"collider": scene.shape("sphere", radius=0.5)}, translation=[2 * side, 0, 0])
        bundle, printed = self.convert(scene)
        self.assertIn("1 of KHR_physics_rigid_bodies: bodies of several colliders", printed)
        found = self.parts(bundle)[0]["dumbbell"]
        ball = 1000 * math.pi / 6
        self.assertAlmostEqual(float(found.get("mass")), 2 * ball, delta=0.02)
        moments = sorted(numbers(found.get("inertia")))
        for have, want in zip(moments, (2 * ball * 0.1, 2 * ball * (0.1 + 4), 2 * ball * (0.1 + 4))):
            self.assertAlmostEqual(have, want, delta=1e-4 * want)

    def test_stated_values_are_used(self):
        scene, half = Scene(), math.sqrt(0.5)
        scene.body("stated", rotation=(0, half, 0, half), mass=4, centerOfMass=[0, 0, 0.5], inertiaDiagonal=[1, 2, 3],
                   inertiaOrientation=[0, 0, 0, 1])
        found = self.parts(self.convert(scene)[0])[0]["stated"]
        self.assertEqual(float(found.get("mass")), 4)
        for have, want in zip(numbers(found.get("center")), (0.5, 50, 0)):  # node +Z is asset +X
            self.assertAlmostEqual(have, want, places=5)
        self.assertEqual(numbers(found.get("inertia")), [1, 2, 3])
        for have, want in zip(numbers(found.get("inertia_rotation")), (0, half, 0, half)):
            self.assertAlmostEqual(have, want, places=6)


class Surroundings(RigidTest):
    def test_materials_and_filters(self):
        scene = Scene()
        scene.materials = [{"staticFriction": 0.9, "dynamicFriction": 0.7, "restitution": 0.3, "frictionCombine": "minimum"}]
        scene.filters = [{"collisionSystems": ["a"], "collideWithSystems": ["b"]}, {"collisionSystems": ["b"]},
                         {"collisionSystems": ["a", "b"], "notCollideWithSystems": ["b"]}]
        for k in range(3):
            scene.body(f"body {k}", at=(3 * k, 50, 0), collider={**scene.shape("sphere", radius=1), "collisionFilter": k, "physicsMaterial": 0})
        bundle, printed = self.convert(scene)
        found = [self.parts(bundle)[0][f"body {k}"] for k in range(3)]
        self.assertEqual({(float(b.get("friction")), float(b.get("restitution"))) for b in found}, {(0.7, 0.3)})
        layers = [(int(b.get("layer", "1")), int(b.get("mask", str(2**32 - 1)))) for b in found]
        meet = [[bool(a[0] & b[1] and b[0] & a[1]) for b in layers] for a in layers]
        self.assertEqual(meet, [[False, True, False], [True, True, False], [False, False, True]])
        for what in ("3 of KHR_physics_rigid_bodies: static frictions", "3 of KHR_physics_rigid_bodies: rules of combining"):
            self.assertIn(what, printed)

    def test_lost_parts_are_counted(self):
        scene = Scene()
        scene.node("ground", None, {"collider": scene.shape("plane")})
        scene.node("door", None, {"trigger": scene.shape("box", size=[1, 1, 1])})
        scene.body("turning", mass=1, isKinematic=True, angularVelocity=[0, 1, 0])
        scene.body("heavy", at=(4, 50, 0), mass=0)
        scene.body("nothing", at=(8, 50, 0), collider=False)
        tube = scene.body("tube", at=(12, 50, 0))
        scene.joint(tube, None, [{"linearAxes": [0, 1], "max": 1}, {"angularAxes": [0, 1, 2], "max": 0.3}], other_at=(12, 50, 0))
        scene.joint(scene.node("a"), None, [LINEAR])
        _, printed = self.convert(scene)
        for what in ("planes", "static colliders", "triggers", "velocities of kinematic bodies", "infinite masses", "neither mass nor shape",
                     "distance from a line", "rotation about all axes", "static nodes"):
            self.assertRegex(printed, f"1 of KHR_physics_rigid_bodies: [^:]*{what}")

    def test_with_another_rig_they_are_left_out(self):
        scene = Scene()
        scene.body("box", at=(0, 0.2, 0), mass=1)
        write_bytes(self.path("box.glb"), scene.bytes())
        rig = os.path.join(ROOT, "examples", "lizard", "lizard.glb")
        printed = call("convert", self.path("box.glb"), "--rig", rig, "-o", self.path("box.sbf"), "--no-build").err
        self.assertIn("rigid bodies and joints are left out", printed)

    def test_a_text_file_with_its_buffer_beside(self):
        scene = Scene()
        scene.body("box", collider={"geometry": {"node": 0, "convexHull": True}})
        document = scene.json()
        document["buffers"][0]["uri"] = "box data.bin"
        write_bytes(self.path("box data.bin"), scene.binary)
        write_bytes(self.path("box.gltf"), json.dumps(document).encode())
        self.good("convert", self.path("box.gltf"), "-o", self.path("box.sbf"))
        self.assertAlmostEqual(float(self.parts(self.path("box.sbf"))[0]["box"].get("mass")), 1000, delta=0.01)


class Faults(RigidTest):
    def with_motion(self, **motion):
        scene = Scene()
        scene.body("box", **motion)
        return scene

    def test_numbers(self):
        self.assertIn("`mass`", self.refused(self.with_motion(mass=-1)))
        self.assertIn("`mass`", self.refused(self.with_motion(mass="heavy")))
        self.assertIn("inertia", self.refused(self.with_motion(mass=1, inertiaDiagonal=[1, -1, 1])))
        self.assertIn("`centerOfMass`", self.refused(self.with_motion(centerOfMass=[1, 2])))
        self.assertIn("`gravityFactor`", self.refused(self.with_motion(gravityFactor=1e60)))
        self.assertIn("`isKinematic`", self.refused(self.with_motion(isKinematic=1)))

    def test_shapes(self):
        for kind, values in (("sphere", {"radius": 0}), ("box", {"size": [1, 0, 1]}), ("capsule", {"height": -1}),
                             ("cylinder", {"radiusTop": 0, "radiusBottom": 0}), ("plane", {"sizeX": 0})):
            scene = Scene()
            scene.body("thing", collider=scene.shape(kind, **values))
            self.refused(scene)

    def test_indices(self):
        for collider in ({"geometry": {"shape": 7}}, {"geometry": {"node": 99}}, {"geometry": {}}, {},
                         {"geometry": {"shape": 0}, "physicsMaterial": 0}, {"geometry": {"shape": 0}, "collisionFilter": -1}):
            scene = Scene()
            scene.shape("box", size=[1, 1, 1])
            scene.body("thing", collider=collider or {"x": 1})
            self.refused(scene)

    def test_joints(self):
        def joined(limits=(), drives=(), own=False):
            scene = Scene()
            body = scene.body("box")
            scene.joint(body, body if own else None, limits, drives)
            return scene

        self.assertIn("itself", self.refused(joined(own=True)))
        for limit in ({"linearAxes": [0, 0], "max": 0}, {"linearAxes": [3]}, {"linearAxes": []}, {"max": 1},
                      {"linearAxes": [0], "angularAxes": [0]}, {"linearAxes": [0], "min": 1, "max": 0}, {"linearAxes": [0], "stiffness": -1}):
            self.refused(joined([limit]))
        self.refused(joined((), [{"type": "linear", "mode": "force", "axis": 3}]))
        for joint in ({"connectedNode": 99, "joint": 0}, {"connectedNode": 1}, {"connectedNode": 1, "joint": 5}):
            scene = joined()
            scene.nodes[-1]["extensions"][EXTENSION]["joint"] = joint
            self.refused(scene)


def schemas():
    found = {}
    for path in glob.glob(os.path.join(KHRONOS, "schema", "*.json")):
        with open(path, encoding="utf-8") as file:
            schema = json.load(file)
            found[schema["$id"]] = schema
    return found


class Written(RigidTest):
    def assert_follows_the_schemas(self, path):
        document, known = Glb(path).json, schemas()
        if not known:
            return
        self.assertIn(EXTENSION, document["extensionsUsed"])
        for name, value in document["extensions"].items():
            if name.startswith("KHR_"):
                self.assertEqual(json_schema.faults(value, known[f"glTF.{name}.schema.json"], files=known), [])
        count = 0
        for node in document["nodes"]:
            if EXTENSION in node.get("extensions", ()):
                count += 1
                self.assertEqual(json_schema.faults(node["extensions"][EXTENSION], known[f"node.{EXTENSION}.schema.json"], files=known), [])
        self.assertGreater(count, 0)

    def bundles(self):
        return [example(self.folder), os.path.join(ROOT, "spec", "samples", "valid", "everything.sbf")]

    @unittest.skipUnless(os.path.isdir(KHRONOS), "no texts of Khronos beside the checkout")
    def test_it_follows_the_schemas(self):
        for bundle in self.bundles():
            for verb in ("export", "pack"):
                self.good(verb, bundle, "-o", self.path("made.glb"))
                self.assert_follows_the_schemas(self.path("made.glb"))

    @play_files.needs_node
    def test_the_validator_finds_no_error(self):
        for bundle in self.bundles():
            self.good("pack", bundle, "-o", self.path("made.glb"))
            issues = play_files.node("validate_gltf.mjs", self.path("made.glb"))["issues"]
            self.assertEqual(issues["numErrors"], 0, issues["messages"])

    def assert_goes_round(self, bundle):
        """Exported, without our extension, and converted as a stranger's file."""
        self.good("export", bundle, "-o", self.path("round.glb"))
        self.good("convert", self.path("round.glb"), "-o", self.path("round.sbf"))
        (bodies, joints), (more, others) = self.parts(bundle), self.parts(self.path("round.sbf"))
        names = {b.get("id"): name for name, b in bodies.items()}, {b.get("id"): name for name, b in more.items()}
        self.assertEqual(set(bodies), set(more))
        self.assertEqual(len(joints), len(others))
        for joint, other in zip(joints, others):
            self.assertEqual(joint.tag, other.tag)
            for side in ("body_a", "body_b"):
                self.assertEqual(names[0].get(joint.get(side)), names[1].get(other.get(side)))
            self.assert_same_frames(joint, other, bodies, more, names)
            limits, again = ([{limit.get("target"): limit for limit in one.iter("limit")} for one in (joint, other)])
            self.assertEqual(set(limits), set(again))
            for target, limit in limits.items():
                for key in ("min", "max", "stiffness", "damping"):
                    self.assertAlmostEqual(float(limit.get(key, 0)), float(again[target].get(key, 0)), delta=1e-5)
        return bodies, more

    def assert_same_frames(self, joint, other, bodies, more, names):
        for side in "ab":
            positions = []
            for one, all_bodies, ids in ((joint, bodies, names[0]), (other, more, names[1])):
                body = one.get("body_" + side)
                center = numbers(all_bodies[ids[body]].get("center", "0 0 0")) if body else [0, 0, 0]
                frame = one.find("frame_" + side)
                turn = numbers(frame.get("rotation", "0 0 0 1"))
                positions.append(([c + p for c, p in zip(center, numbers(frame.get("position", "0 0 0")))], turn))
            (p, q), (r, s) = positions
            for x, y in zip(p, r):
                self.assertAlmostEqual(x, y, delta=1e-5)
            self.assertAlmostEqual(abs(sum(x * y for x, y in zip(q, s))), 1, delta=1e-5)

    def test_the_lizard_round_trips(self):
        self.assert_goes_round(example(self.folder))

    def test_simulated_bodies_round_trip(self):
        scene = Scene()
        base = scene.body("base", mass=3, centerOfMass=[0, 0.1, 0], gravityFactor=0.5)
        tip = scene.body("tip", at=(0, 52, 0), mass=1)
        scene.joint(base, None, [LINEAR, {"angularAxes": [1, 2], "min": 0, "max": 0.5}, {"angularAxes": [0], "min": -1, "max": 1}],
                    other_at=(0, 50, 0))
        scene.joint(tip, base, [LINEAR, {"angularAxes": [0, 1], "min": 0, "max": 0}, {"angularAxes": [2], "min": -0.2, "max": 0.4, "stiffness": 9, "damping": 1}],
                    [{"type": "angular", "mode": "force", "axis": 2, "positionTarget": 0.1, "stiffness": 2, "damping": 1, "velocityTarget": 0}],
                    at=(0, -1, 0), other_at=(0, 1, 0), enableCollision=True)
        scene.node("wall", None, {"collider": scene.shape("box", size=[1, 2, 0.1])}, translation=[0, 40, 0], rotation=[0.5, 0.5, -0.5, 0.5])
        bodies, more = self.assert_goes_round(self.convert(scene)[0])
        document = Glb(self.path("round.glb")).json
        self.assertEqual({tuple(sorted(round(side, 5) for side in shape["box"]["size"])) for shape in document["extensions"]["KHR_implicit_shapes"]["shapes"]},
                         {(1, 1, 1), (0.1, 1, 2)})
        self.assertIn("KHR_implicit_shapes", document["extensionsUsed"])
        self.assert_follows_the_schemas(self.path("round.glb"))
        for name, body in bodies.items():
            for key in ("mass", "center", "inertia", "gravity_scale"):
                for x, y in zip(numbers(body.get(key)), numbers(more[name].get(key))):
                    self.assertAlmostEqual(x, y, delta=1e-5 * max(1, abs(x)), msg=f"{key} of {name}")

    def test_our_reader_does_not_need_it(self):
        bundle = example(self.folder)
        self.good("pack", bundle, "-o", self.path("made.glb"))
        glb = Glb(self.path("made.glb"))
        del glb.json["extensions"][EXTENSION]
        glb.json["extensionsUsed"].remove(EXTENSION)
        for node in glb.json["nodes"]:
            node.get("extensions", {}).pop(EXTENSION, None)
        write_bytes(self.path("bare.glb"), glb_bytes(glb.json, glb.binary))
        self.good("diff", bundle, self.path("bare.glb"))


@unittest.skipUnless(os.path.isdir(KHRONOS), "no samples of Khronos beside the checkout")
class Samples(RigidTest):
    COUNTS = {"JointTypes.glb": (14, 6, 11), "MotionProperties.glb": (7, 3, 0), "ShapeTypes.glb": (9, 1, 0), "Robot_skinned.gltf": (17, 1, 19)}

    def bundle(self, name):
        out = self.path(os.path.splitext(name)[0] + ".sbf")
        self.good("convert", os.path.join(KHRONOS, "samples", name), "-o", out)
        return out

    def test_counts(self):
        for name, (moving, static, joints) in self.COUNTS.items():
            bodies, found = self.parts(self.bundle(name))
            self.assertEqual(len(found), joints, name)
            self.assertEqual(len([b for b in bodies.values() if b.get("bone")]), moving, name)
            self.assertEqual(len([b for b in bodies.values() if not b.get("bone")]), static, name)

    def test_kinds_of_joints(self):
        _, joints = self.parts(self.bundle("JointTypes.glb"))
        self.assertEqual([joint.tag.removesuffix("_joint") for joint in joints],
                         ["spherical", "spherical", "revolute", "revolute", "prismatic", "six_dof", "fixed", "six_dof", "revolute",
                          "revolute", "prismatic"])

    def test_joints_move_as_defined(self):
        moves = self.motion(self.bundle("JointTypes.glb"), 6)
        for value, wanted in zip(moves["Cube.011"][-1][1], (0.25, 2.3, 0)):  # fixed
            self.assertAlmostEqual(value, wanted, delta=1e-3)
        self.assertAlmostEqual(moves["Cube.007"][-1][1][1], 2.5, delta=2e-3)  # slides down to its limit
        for _, at, _ in moves["Cube.005"]:
            self.assertAlmostEqual(at[2], 0, delta=1e-3)  # hinges about Z
        (t, _, p), (u, _, q) = moves["Cube.017"][-10], moves["Cube.017"][-1]
        speed = 2 * math.remainder(math.atan2(q[2], q[3]) - math.atan2(p[2], p[3]), math.pi) / (u - t)
        self.assertAlmostEqual(speed, -1.57, delta=0.12)  # its weight is 0.3 mm off the hinge

    def test_motions_are_as_stated(self):
        bundle = self.bundle("MotionProperties.glb")
        bodies, _ = self.parts(bundle)
        center = numbers(bodies["WobbyToy_ModifiedCOM"].get("center"))
        self.assertAlmostEqual(math.dist(center, (3.0006042, 2.5743825, 0)), 0.35, delta=1e-5)
        moves = self.motion(bundle, 2)
        for name in ("Balloon_GravityFactor", "Balloon_GravityFactor.001"):
            (_, start, _), (time, end, _) = moves[name][0], moves[name][30]  # before it touches another
            self.assertAlmostEqual(end[1] - start[1], 0.25 * GRAVITY * time**2, delta=5e-3)
        wheel = moves["Wheel_InfiniteMassFiniteInertia"]
        self.assertLess(math.dist(wheel[0][1], wheel[-1][1]), 1e-4)

    def test_the_robot_stands_without_bursting(self):
        bundle = self.bundle("Robot_skinned.gltf")
        result = self.json_of("run", bundle, "--seconds", "4")
        self.assertTrue(result["valid"])
        for name, poses in self.motion(bundle, 4).items():
            for _, at, _ in poses:
                self.assertLess(math.dist(at, poses[0][1]), 0.3, name)


if __name__ == "__main__":
    main()
