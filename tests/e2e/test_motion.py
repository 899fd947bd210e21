"""`sbfmt convert --motion`: clips of another skeleton, carried over to the one at hand."""

import math
import os
import subprocess
import sys
import unittest

from bundle_file import Bundle
from bvh_file import Bvh
from sbfmt_program import PROGRAM, ProgramTest, ROOT, SHARED, call, main, read_bytes, shared, write_bytes

CMU = shared("mocap", "cmu_01_01.bvh")
FRAMES = (0, 600, 1200, 2400)


def direction(frame):
    return tuple(row[1] for row in frame)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def place(frame):
    return tuple(row[3] for row in frame)


@unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
class MotionCapture(ProgramTest):
    def moved(self, path):
        said = self.good("convert", "--no-build", path, "--motion", CMU, "-o", self.path("out.sbf")).err
        bundle = Bundle(self.path("out.sbf"))
        return bundle, bundle.tracks(bundle.clips[-1]), said

    def source(self):
        self.good("convert", "--no-build", CMU, "-o", self.path("source.sbf"))
        bundle = Bundle(self.path("source.sbf"))
        return bundle, bundle.tracks(bundle.clips[0])

    def test_motion_retargeted_to_its_own_skeleton_is_unchanged(self):
        bundle, tracks, said = self.moved(CMU)
        own = bundle.tracks(bundle.clips[0])
        self.assertNotIn("UNMATCHED", said)
        time_s = Bvh(CMU).frame_time
        first = place(bundle.pose(own, 0)[0])
        for frame in FRAMES:
            ours, theirs = bundle.pose(tracks, frame * time_s), bundle.pose(own, frame * time_s)
            for a, b in zip(ours, theirs):
                for k, start in ((0, first[0] - bundle.rest[0][0][3]), (2, first[2] - bundle.rest[0][2][3])):
                    self.assertAlmostEqual(a[k][3], b[k][3] - start, delta=0.01)
                self.assertGreater(dot(direction(a), direction(b)), 1 - 1e-5)

    def check_limbs(self, bundle, tracks, pairs, minimum=1 - 1e-4):
        source, own = self.source()
        time_s = Bvh(CMU).frame_time
        names, theirs = bundle.bone_names(), source.bone_names()
        for frame in FRAMES:
            here, there = bundle.pose(tracks, frame * time_s), source.pose(own, frame * time_s)
            for name, other in pairs:
                a, b = direction(here[names.index(name)]), direction(there[theirs.index(other)])
                self.assertGreater(dot(a, b), minimum, f"{name} in frame {frame}")

    def test_a_human_of_the_same_names(self):
        bundle, tracks, _ = self.moved(shared("walk-dae", "walk.dae"))
        limbs = [side + limb for side in ("Left", "Right") for limb in ("UpLeg", "Leg", "Arm", "ForeArm")]
        self.check_limbs(bundle, tracks, [(limb, limb) for limb in limbs])

    def test_a_figure_of_other_names_and_another_pose(self):
        bundle, tracks, said = self.moved(shared("greenman", "greenman.glb"))
        self.assertEqual(len(bundle.clips), 5)
        self.assertIn("IMPORT_MOTION_UNMATCHED", said)
        self.assertIn("9 bones were transferred", said)
        self.check_limbs(bundle, tracks, [("leg_L", "LeftUpLeg"), ("leg_R", "RightUpLeg")])
        bvh = Bvh(CMU)
        names = bundle.bone_names()
        legs = [names.index("leg_L"), names.index("leg_R")]
        there = [bvh.names.index("LeftUpLeg"), bvh.names.index("RightUpLeg")]

        def middle(frames, bones):
            return [sum(frames[b][k][3] for b in bones) / 2 for k in range(3)]

        start, origin = middle(bvh.worlds(0), there), middle(bundle.pose(tracks, 0), legs)
        for frame in FRAMES[1:]:
            theirs = middle(bvh.worlds(frame), there)
            ours = middle(bundle.pose(tracks, frame * bvh.frame_time), legs)
            way, gone = theirs[2] - start[2], ours[2] - origin[2]
            self.assertAlmostEqual(gone / way, 0.0249, delta=0.002)

    def test_a_kenney_character_keeps_its_bones_lengths(self):
        bundle, tracks, _ = self.moved(shared("kenney-fbx", "kenney_character.fbx"))
        frames = bundle.pose(tracks, 5)
        for bone, name in enumerate(bundle.bone_names()):
            parent = bundle.parents[bone]
            if parent is None or name == "Hips":
                continue
            lengths = [sum((a - b) ** 2 for a, b in zip(place(pose[bone]), place(pose[parent])))
                       for pose in (frames, bundle.rest)]
            self.assertAlmostEqual(lengths[0], lengths[1], places=5)


CHAINS = {"spine": ("Hips", "LowerBack", "Spine", "Spine1"), "head": ("Neck1", "Head"),
          **{f"arm_{side.lower()}": (side + "Arm", side + "ForeArm", side + "Hand") for side in ("Left", "Right")},
          **{f"leg_{side.lower()}": (side + "UpLeg", side + "Leg", side + "Foot") for side in ("Left", "Right")}}


@unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
class NamedChains(ProgramTest):
    """A recorded walk on the example yeti, twice as broad and with legs a third as long for its height, whose bones have
    names that mean nothing: chains of one name are all that the two skeletons share."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        if not PROGRAM:
            return
        cls.recorded, cls.yeti = (os.path.join(cls.class_folder.name, name) for name in ("recorded.sbf", "yeti.sbf"))
        call("convert", "--no-build", CMU, "-o", cls.recorded)
        source = Bundle(cls.recorded)
        names = source.bone_names()
        chains = "".join(f'<retarget_chain id="c{i}" name="{name}"><bones>{" ".join(str(names.index(b)) for b in bones)}'
                         "</bones></retarget_chain>" for i, (name, bones) in enumerate(CHAINS.items()))
        cls.rewrite(cls.recorded, "</sbf>", f"<retarget_chains>{chains}</retarget_chains></sbf>")
        plain = os.path.join(cls.class_folder.name, "plain.sbf")
        maker = os.path.join(ROOT, "examples", "yeti", "make_bundle.py")
        subprocess.run([sys.executable, "-B", maker, PROGRAM, plain], capture_output=True, check=True)
        cls.names = Bundle(plain).bone_names()
        for i, name in enumerate(cls.names):
            cls.rewrite(plain, f'<bone id="bone.{name}" name="{name}"', f'<bone id="bone.{name}" name="b{i}"')
        cls.said = call("convert", plain, "--motion", cls.recorded, "-o", cls.yeti).err

    @staticmethod
    def rewrite(path, old, new):
        with open(path, encoding="utf-8") as stream:
            text = stream.read()
        with open(path, "w", encoding="utf-8") as stream:
            stream.write(text.replace(old, new))

    def at(self, moved, recorded, name, other):
        return moved[self.names.index(name)], recorded[1][recorded[0].index(other)]

    def frames(self):
        ours, theirs = Bundle(self.yeti), Bundle(self.recorded)
        tracks, own = ours.tracks(ours.clips[-1]), theirs.tracks(theirs.clips[0])
        for frame in range(0, 2700, 60):
            time_s = frame * Bvh(CMU).frame_time
            yield ours.pose(tracks, time_s), (theirs.bone_names(), theirs.pose(own, time_s))

    def test_joints_point_where_the_recorded_ones_point(self):
        pairs = [(f"{bone}.{side[0]}", side + other) for side in ("Left", "Right") for bone, other in
                 (("upper_arm", "Arm"), ("forearm", "ForeArm"), ("thigh", "UpLeg"), ("shin", "Leg"))]
        for moved, recorded in self.frames():
            for name, other in pairs:
                a, b = self.at(moved, recorded, name, other)
                self.assertGreater(dot(direction(a), direction(b)), 1 - 1e-4, name)

    def test_planted_feet_stay_planted(self):
        ours, theirs = Bundle(self.yeti), Bundle(self.recorded)
        tracks, own, names = ours.tracks(ours.clips[-1]), theirs.tracks(theirs.clips[0]), theirs.bone_names()
        tick, stood = Bvh(CMU).frame_time, 0
        for frame in range(0, 2700, 30):
            moved = [ours.pose(tracks, (frame + k) * tick) for k in (0, 8)]
            recorded = [theirs.pose(own, (frame + k) * tick) for k in (0, 8)]
            for side in ("Left", "Right"):
                def gone(poses, bones, foot, thigh, knee):
                    positions = [[place(pose[bones.index(b)]) for b in (foot, thigh, knee)] for pose in poses]
                    leg = math.dist(positions[0][0], positions[0][2]) + math.dist(positions[0][1], positions[0][2])
                    return math.dist(positions[0][0], positions[1][0]) / leg
                if gone(recorded, names, side + "Foot", side + "UpLeg", side + "Leg") < 0.008:
                    stood += 1
                    self.assertLess(gone(moved, self.names, *(f"{b}.{side[0]}" for b in ("foot", "thigh", "shin"))), 0.05)
        self.assertGreaterEqual(stood, 30)

    def test_under_the_gait_its_feet_stand(self):
        clip = len(Bundle(self.yeti).clips) - 1
        script = write_bytes(self.path("s.txt"), f"0 play {clip} 1 0.3\n0.5 drive 0.3 0.2\n".encode())
        report = self.json_of("run", self.yeti, "--seconds", "5", "--script", script)
        self.assertTrue(report["valid"])
        self.assertGreaterEqual(min(report["steps_taken"].values()), 2)
        self.assertLessEqual(report["stance_slip"], 0.008)  # of soft feet, under a wild clip
        self.assertEqual(report["skate_ratio"], 0)

    def test_names_would_not_have_done(self):
        self.assertIn("bones were transferred", self.said)
        plain = self.path("plain.sbf")
        with open(self.yeti, encoding="utf-8") as stream:
            text = stream.read()
        start, end = text.index("<retarget_chains>"), text.index("</retarget_chains>") + len("</retarget_chains>")
        write_bytes(plain, (text[:start] + text[end:]).encode())
        self.assertIn("IMPORT_MOTION_NONE", self.fails(1, "convert", "--no-build", plain, "--motion", self.recorded, "-o",
                                                      self.path("out.sbf")))


class Calls(ProgramTest):
    LIZARD = os.path.join(ROOT, "examples", "lizard", "lizard.glb")

    def test_wrong_files_give_no_output(self):
        self.fails(2, "convert", self.LIZARD, "--motion", self.path("absent.bvh"), "-o", self.path("out.sbf"))
        message = self.fails(1, "convert", os.path.join(ROOT, "examples", "lizard", "lizard.obj"), "--motion",
                             self.LIZARD, "-o", self.path("out.sbf"))
        self.assertIn("IMPORT_MOTION_NONE", message)
        self.assert_empty_folder()

    @unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
    def test_several_files_and_a_bundle(self):
        fox = shared("fox", "fox.glb")
        self.good("convert", "--no-build", fox, "-o", self.path("fox.sbf"))
        self.good("convert", "--no-build", self.path("fox.sbf"), "--motion", fox, "--motion", self.path("fox.sbf"), "-o",
                  self.path("more.sbf"))
        bundle = Bundle(self.path("more.sbf"))
        self.assertEqual([c.get("name") for c in bundle.clips], ["Survey", "Walk", "Run"] * 3)
        self.good("validate", self.path("more.sbf"))
        old, new = bundle.tracks(bundle.clips[1]), bundle.tracks(bundle.clips[4])
        for bone in range(len(bundle.bones)):
            a, b = bundle.pose(old, 0.3)[bone], bundle.pose(new, 0.3)[bone]
            self.assertGreater(dot(direction(a), direction(b)), 1 - 1e-5)

    @unittest.skipUnless(os.path.isdir(SHARED), "the files of ../shared/data are not there")
    def test_the_same_call_gives_the_same_bytes(self):
        arguments = ("convert", "--no-build", self.LIZARD, "--motion", shared("fox", "fox.glb"))
        self.good(*arguments, "-o", self.path("a.sbf"))
        self.good(*arguments, "-o", self.path("b.sbf"))
        self.assertEqual(read_bytes(self.path("a.sbf")), read_bytes(self.path("b.sbf")))


if __name__ == "__main__":
    main()
