"""Joints that export writes, number by number against the bundle: MJCF posed in MuJoCo beside the runtime's poses, USD read again.

MuJoCo comes from npm into the build folder, once (play_files.py); without node, npm or the network its tests skip with a message."""

import csv
import json
import math
import xml.etree.ElementTree as ElementTree

import joint_files
import play_files
import usda_files
from sbfmt_program import ProgramTest, main, read_text, write_bytes

SECONDS = 5
KINDS = {"revolute": "PhysicsRevoluteJoint", "prismatic": "PhysicsPrismaticJoint"}
AXES = {"linear_x": "transX", "linear_y": "transY", "linear_z": "transZ", "twist": "rotX", "swing_y": "rotY", "swing_z": "rotZ"}


def numbers(text):
    return [float(word) for word in text.split()]


class Joints(ProgramTest):
    def close(self, got, want, delta, what):
        self.assertEqual(len(got), len(want), what)
        for a, b in zip(got, want):
            self.assertAlmostEqual(a, b, delta=delta, msg=f"{what}: {got}, not {want}")

    def same_rotation(self, got, want, delta, what):
        """Quaternions of either sign."""
        sign = 1 if sum(a * b for a, b in zip(got, want)) >= 0 else -1
        self.close([sign * x for x in got], want, delta, what)

    def bundle(self, which="drive"):
        path = self.path(f"{which}.sbf")
        write_bytes(path, joint_files.document(which).encode())
        return path, ElementTree.fromstring(read_text(path))

    def exported(self, path, ending):
        self.good("export", path, "-o", self.path("out" + ending))
        return self.path("out" + ending)

    def runtime_pose(self, path):
        """Each bone's position and rotation (x, y, z, w) after its drive has come to rest."""
        self.good("run", path, "--seconds", SECONDS, "--pose", self.path("pose.csv"))
        last = {}
        with open(self.path("pose.csv"), encoding="utf-8") as stream:
            for row in csv.DictReader(stream):
                last[row["bone"]] = ([float(row["p" + k]) for k in "xyz"], [float(row["q" + k]) for k in "xyzw"])
        return last

    def mujoco_pose(self, path, values):
        write_bytes(self.path("poses.json"), json.dumps([values]).encode())
        return play_files.node("pose_mujoco.mjs", path, self.path("poses.json"))[0]

    def compare_poses(self, which, value_of):
        """`value_of` returns the value to which a joint of the MJCF file is set."""
        path, _ = self.bundle(which)
        exported = self.exported(path, ".mjcf")
        joints = list(ElementTree.fromstring(read_text(exported)).iter("joint"))
        self.assertEqual(len(joints), sum(len(case.motions) for case in joint_files.CASES))
        posed = self.mujoco_pose(exported, {joint.get("name"): value_of(joint) for joint in joints})
        moved = 0
        for name, (position, rotation) in self.runtime_pose(path).items():
            x, y, z = posed[name]["position"]
            qw, qx, qy, qz = posed[name]["rotation"]
            self.close((x, z, -y), position, 2e-3, f"{which}: the place of {name}")
            self.same_rotation((qx, qz, -qy, qw), rotation, 2e-3, f"{which}: the rotation of {name}")
            moved += abs(rotation[3]) < 0.999 or name.startswith("slide")
        self.assertEqual(moved, len(joint_files.CASES))

    @play_files.needs_node
    def test_mjcf_where_drives_lead(self):
        self.compare_poses("drive", lambda joint: float(joint.get("springref")))

    @play_files.needs_node
    def test_mjcf_at_the_minimum_of_each_range(self):
        self.compare_poses("min", lambda joint: numbers(joint.get("range", joint.get("springref")))[0])

    @play_files.needs_node
    def test_mjcf_at_the_greatest_of_each_range(self):
        self.compare_poses("max", lambda joint: numbers(joint.get("range", joint.get("springref")))[-1])

    def test_mjcf_numbers(self):
        path, source = self.bundle()
        root = ElementTree.fromstring(read_text(self.exported(path, ".mjcf")))
        joints = {joint.get("name"): joint for joint in root.iter("joint")}
        for case in source.find("joints"):
            name = case.get("id")
            for drive in case.iter("drive"):
                joint = joints[f"{name}:{drive.get('target')}"]
                self.assertEqual(joint.get("type"), "slide" if drive.get("target").startswith("linear") else "hinge")
                for theirs, ours in (("stiffness", "stiffness"), ("damping", "damping"), ("springref", "position")):
                    self.assertAlmostEqual(float(joint.get(theirs)), float(drive.get(ours)), delta=1e-6, msg=f"{name} {theirs}")
            for limit in case.iter("limit"):
                self.close(numbers(joints[f"{name}:{limit.get('target')}"].get("range")), [float(limit.get(k)) for k in ("min", "max")],
                           1e-6, name)
        self.check_mjcf_masses(source, root)

    def check_mjcf_masses(self, source, root):
        """Axes of inertia are turned with all else: a quarter about +X, before them."""
        quarter = (math.sqrt(0.5), 0, 0, math.sqrt(0.5))
        bodies = {body.get("name"): body.find("inertial") for body in root.iter("body")}
        for body in source.find("rigid_bodies"):
            inertial = bodies[body.get("id")]
            self.assertAlmostEqual(float(inertial.get("mass")), float(body.get("mass")), delta=1e-6)
            self.close(numbers(inertial.get("diaginertia")), numbers(body.get("inertia")), 1e-8, "diaginertia")
            self.close(numbers(inertial.get("pos")), (0, 0, 0), 1e-6, "pos")
            w, x, y, z = numbers(inertial.get("quat"))
            want = joint_files.product(quarter, numbers(body.get("inertia_rotation")))
            self.same_rotation((x, y, z, w), want, 1e-6, "quat")

    def test_mjcf_cones_and_distances(self):
        """A cone bounds both swings to either side; a rope's bounds are its tendon's; frames are its sites."""
        text = joint_files.document()
        start = text.index("<joints>")
        joints = ('<spherical_joint id="cone" body_a="base" body_b="hinge"><frame_a position="0.1 0.2 0.3"/>'
                  '<frame_b position="-0.25 -0.2 0.45"/><limits><limit target="swing" min="0" max="0.6"/></limits>'
                  '<drive target="swing" stiffness="3" damping="0.5" position="0.2"/></spherical_joint>'
                  '<distance_joint id="rope" body_a="base" body_b="slide"><frame_a position="0.1 0.2 0.3"/><frame_b position="0.4 0.5 0.6"/>'
                  '<limits><limit target="distance" min="0.25" max="3.5"/></limits></distance_joint>')
        write_bytes(self.path("a.sbf"), (text[:start] + f"<joints>{joints}</joints></sbf>").encode())
        root = ElementTree.fromstring(read_text(self.exported(self.path("a.sbf"), ".mjcf")))
        swings = {joint.get("name"): joint for joint in root.iter("joint")}
        for name in ("cone:swing_y", "cone:swing_z"):
            self.assertEqual(numbers(swings[name].get("range")), [-0.6, 0.6])
            self.assertEqual([float(swings[name].get(k)) for k in ("stiffness", "damping", "springref")], [3, 0.5, 0])
        self.assertIsNone(swings["cone:twist"].get("range"))
        tendon, = root.iter("spatial")
        self.assertEqual(numbers(tendon.get("range")), [0.25, 3.5])
        sites = {site.get("name"): numbers(site.get("pos")) for site in root.iter("site") if site.get("name")}
        self.assertEqual(sites, {"rope:a": [0.1, -0.3, 0.2], "rope:b": [0.4, -0.6, 0.5]})
        _, prims = usda_files.read(self.exported(self.path("a.sbf"), ".usda"))
        rope = prims["/asset/joints/rope"].values
        self.close([rope["physics:minDistance"], rope["physics:maxDistance"]], [0.25, 3.5], 1e-6, "rope")
        cone = prims["/asset/joints/cone"].values
        for axis in ("rotY", "rotZ"):
            self.close([cone[f"limit:{axis}:physics:{end}"] for end in ("low", "high")], [-math.degrees(0.6), math.degrees(0.6)], 1e-4, axis)
            self.assertEqual(cone[f"drive:{axis}:physics:targetPosition"], 0)

    def test_usd_numbers(self):
        path, source = self.bundle()
        _, prims = usda_files.read(self.exported(path, ".usda"))
        for case in source.find("joints"):
            prim = prims["/asset/joints/" + case.get("id")]
            kind = case.tag[:-len("_joint")]
            self.assertEqual(prim.kind, KINDS.get(kind, "PhysicsJoint"))
            self.check_usd_frames(case, prim)
            single = kind in KINDS
            if single:
                self.assertEqual(prim.values["physics:axis"], "X")
            for limit in case.iter("limit"):
                unit = 1 if limit.get("target").startswith("linear") else 180 / math.pi
                names = ("physics:lowerLimit", "physics:upperLimit") if single else tuple(
                    f"limit:{AXES[limit.get('target')]}:physics:{end}" for end in ("low", "high"))
                self.close([prim.values[name] for name in names], [unit * float(limit.get(k)) for k in ("min", "max")], 1e-4, case.get("id"))
            for drive in case.iter("drive"):
                self.check_usd_drive(drive, prim, single)
            held = set(AXES) - {drive.get("target") for drive in case.iter("drive")} if not single else ()
            for axis in held:
                low, high = (prim.values[f"limit:{AXES[axis]}:physics:{end}"] for end in ("low", "high"))
                self.assertGreater(low, high, f"{case.get('id')} holds {axis}")
        self.check_usd_masses(source, prims)

    def check_usd_frames(self, case, prim):
        for end, frame in (("0", case.find("frame_a")), ("1", case.find("frame_b"))):
            self.assertEqual(prim.values["physics:body" + end], f"</asset/rigid/{case.get('body_a' if end == '0' else 'body_b')}>")
            self.close(prim.values["physics:localPos" + end], numbers(frame.get("position")), 1e-6, case.get("id"))
            w, x, y, z = prim.values["physics:localRot" + end]
            self.same_rotation((x, y, z, w), numbers(frame.get("rotation")), 1e-6, case.get("id"))

    def check_usd_drive(self, drive, prim, single):
        """Of angles, stiffness and damping are per degree there."""
        linear = drive.get("target").startswith("linear")
        unit = 1 if linear else 180 / math.pi
        name = ("linear" if linear else "angular") if single else AXES[drive.get("target")]
        value = lambda what: prim.values[f"drive:{name}:physics:{what}"]  # noqa: E731
        for what, want in (("stiffness", float(drive.get("stiffness")) / unit), ("damping", float(drive.get("damping")) / unit),
                           ("targetPosition", float(drive.get("position")) * unit), ("targetVelocity", 0)):
            self.assertAlmostEqual(value(what), want, delta=1e-5 * max(1, abs(want)), msg=f"{prim.path} {what}")
        self.assertIn(f"PhysicsDriveAPI:{name}", prim.schemas)

    def check_usd_masses(self, source, prims):
        for body in source.find("rigid_bodies"):
            reported = prims["/asset/rigid/" + body.get("id")].values
            self.close(reported["xformOp:translate"], numbers(body.get("center")), 1e-6, "place")
            self.assertAlmostEqual(reported["physics:mass"], float(body.get("mass")), delta=1e-6)
            self.close(reported["physics:diagonalInertia"], numbers(body.get("inertia")), 1e-8, "inertia")
            self.close(reported["physics:centerOfMass"], (0, 0, 0), 1e-6, "centre")
            w, x, y, z = reported["physics:principalAxes"]
            self.same_rotation((x, y, z, w), numbers(body.get("inertia_rotation")), 1e-6, "axes")


if __name__ == "__main__":
    main()
