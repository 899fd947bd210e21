"""Tests the characters of examples/: they convert without a warning, are valid, and move as their scripts state."""

import math
import os
import re
import statistics
import subprocess
import sys
import unittest

from bundle_file import Bundle
from motion_files import PointCache, read_poses, rotated
from sbfmt_program import PROGRAM, ROOT, ProgramTest, main

# legs; limits at half a leg length a second: change of a knee's speed (degrees), slip (m)
WALKERS = {"pup": (4, 5, 0.0015), "yeti": (2, 5, 0.001), "spider": (8, 5, 0.002), "caterpillar": (14, 12, 0.0005)}
# kind of gait, bones of the wave from the head to the tail, driven as fast as `walk_speed`
WAVES = {"snake": ("slither", 19), "koi": ("swim", 9), "dragon": ("swim", 18)}


class Characters(ProgramTest):
    def bundle(self, name):
        path = self.path(name + ".sbf")
        printed = self.good("convert", os.path.join(ROOT, "examples", name, name + ".glb"), "-o", path).err
        self.assertNotIn("warning", printed)
        self.assertNotIn("error", printed)
        report = self.json_of("validate", path)
        self.assertEqual((report["errors"], report["warnings"]), (0, 0))
        return path

    def script_of(self, name):
        return os.path.join(ROOT, "examples", name, "walk.txt")

    def test_scripts_play(self):
        for name in (*WALKERS, *WAVES):
            report = self.json_of("run", self.bundle(name), "--seconds", "8", "--script", self.script_of(name))
            self.assertTrue(report["valid"], name)
            if name in WALKERS:
                self.assertGreater(report["distance"], 0.3, name)
                self.assertGreaterEqual(min(report["steps_taken"].values()), 3, name)
                self.assertEqual(len(report["steps_taken"]), WALKERS[name][0])
                self.assertLessEqual(report["limit_excess"], 0.02, name)

    def test_a_body_on_two_legs_does_not_sway_on_slopes_and_stairs(self):
        """To the side, by more than a tenth of a leg: the foot that is ahead stands higher there, and that is no roll."""
        path, out = self.bundle("yeti"), self.path("p.csv")
        leg = self.json_of("run", path, "--seconds", "0")["leg_length"]
        for ground in ("slope:25", "slope:-25", f"stairs:{0.1 * leg},{0.3 * leg}"):
            self.good("run", path, "--seconds", "6", "--drive", f"{leg},0", "--ground", ground, "--pose", out)
            aside = [bones["spine"][0] for bones in read_poses(out)[0].values()]
            self.assertLess(max(aside) - min(aside), 0.1 * leg, ground)

    def test_the_lizard_is_one_skin_without_seams(self):
        path, lizard = self.path("lizard.sbf"), os.path.join(ROOT, "examples", "lizard", "lizard_skin")
        self.assertNotIn("warning", self.good("convert", lizard + ".obj", "--rig", lizard + ".glb", "-o", path).err)
        report = self.json_of("run", path, "--seconds", "6", "--drive", "0.4,-0.12", "--ground", "noise:0.25,7")
        self.assertTrue(report["valid"])
        self.assertLess(report["seam_gap"], 1e-4)
        self.assertGreater(report["volume_ratio_least"], 0.9)
        self.assertLess(report["max_strain"], 0.5)
        self.assertGreater(report["distance"], 2)
        self.assertEqual(len(report["steps_taken"]), 4)

    def test_a_ragdoll_of_sections_keeps_its_joints(self):
        report = self.json_of("run", self.bundle("lizard"), "--seconds", "3", "--ragdoll")
        self.assertTrue(report["valid"])
        self.assertLess(report["limit_excess"], math.degrees(1e-5))
        self.assertLess(report["joint_gap"], 2e-5)  # m
        self.assertLess(report["rest_time"], 2.5)

    def test_waves_run_along_the_body_and_keep_its_joints_together(self):
        for name, (kind, count) in WAVES.items():
            path, out = self.bundle(name), self.path("p.csv")
            root = Bundle(path).root
            gait = next(root.iter("gait"))
            bones = [int(n) for n in gait.find("undulation/bones").text.split()]
            names = [bone.get("name") for bone in root.iter("bone")]
            self.assertEqual((gait.get("kind"), [names[n] for n in bones]),
                             (kind, ["head", *(f"body{i + 1}" for i in range(count - 1))]))
            self.json_of("run", path, "--seconds", "4", "--drive", gait.get("walk_speed") + ",0.3", "--pose", out)
            poses, maximum = read_poses(out)[0], 0
            spacing = [math.dist(poses[0][names[a]][:3], poses[0][names[b]][:3]) for a, b in zip(bones, bones[1:])]
            aside = []  # of the last bone against the first, across the body
            for frame in range(60, 240, 5):
                links = [poses[frame][names[bone]] for bone in bones]
                ways = [rotated(link[3:], (0, 1, 0)) for link in links]
                for i in range(1, count):
                    self.assertAlmostEqual(math.dist(links[i - 1][:3], links[i][:3]), spacing[i - 1], places=3)
                    if i > 1:  # the head's bone points ahead and those of the body back
                        maximum = max(maximum, math.acos(min(1, sum(a * b for a, b in zip(ways[i - 1], ways[i])))))
                aside.append(rotated((*(-n for n in links[1][3:6]), links[1][6]),
                                     [a - b for a, b in zip(links[-1][:3], links[1][:3])])[0])
            self.assertGreater(maximum, 0.08, name)
            self.assertLess(maximum, 0.8, name)
            self.assertLess(min(aside), -0.01, name)
            self.assertGreater(max(aside), 0.01, name)

    def test_swimmers_are_carried(self):
        """Without gravity on its flesh a swimmer keeps its shape and its height."""
        for name, (kind, _) in WAVES.items():
            bodies = list(Bundle(self.bundle(name)).root.iter("soft_body"))
            self.assertGreater(len(bodies), 4)
            scales = {body.find("attributes").get("gravity_scale", "1") if body.find("attributes") is not None else "1"
                      for body in bodies}
            self.assertEqual(scales, {"0" if kind == "swim" else "1"}, name)

    def test_the_yeti_swings_its_arms_against_its_legs(self):
        path, out = self.path("yeti.sbf"), self.path("p.csv")
        maker = os.path.join(ROOT, "examples", "yeti", "make_bundle.py")
        subprocess.run([sys.executable, "-B", maker, PROGRAM, path], capture_output=True, check=True)
        report = self.json_of("validate", path)
        self.assertEqual((report["errors"], report["warnings"]), (0, 0))
        for speed, minimum in ((0.6, 0.5), (0.9, 0.5)):
            report = self.json_of("run", path, "--seconds", "6", "--drive", f"{speed},0", "--pose", out)
            self.assertTrue(report["valid"])
            self.assertEqual(report["skate_ratio"], 0)
            poses = read_poses(out)[0]
            # how far the left one is ahead of the right one, of hands and of feet, along +Z
            hands, feet = ([poses[i][f"{bone}.L"][2] - poses[i][f"{bone}.R"][2] for i in range(150, 360)]
                           for bone in ("hand", "foot"))
            self.assertGreater(max(hands) - min(hands), minimum)
            self.assertLess(statistics.correlation(hands, feet), -0.7)

    def test_the_yeti_leans_back_as_it_sets_off_and_dives_as_it_stops(self):
        heavy, light, script, out = (self.path(name) for name in ("heavy.sbf", "light.sbf", "stop.txt", "p.csv"))
        maker = os.path.join(ROOT, "examples", "yeti", "make_bundle.py")
        subprocess.run([sys.executable, "-B", maker, PROGRAM, heavy], capture_output=True, check=True)
        with open(heavy, encoding="utf-8") as stream:
            text, count = re.subn(r"<followers>.*</followers>", "", stream.read(), flags=re.DOTALL)
        self.assertEqual(count, 1)
        with open(light, "w", encoding="utf-8") as stream:
            stream.write(text)
        with open(script, "w", encoding="utf-8") as stream:
            stream.write("0 drive 0.8 0\n3 drive 0 0\n")
        leans, heights = [], []
        for path in (heavy, light):
            report = self.json_of("run", path, "--seconds", "6", "--script", script, "--pose", out)
            self.assertTrue(report["valid"])
            self.assertEqual(report["skate_ratio"], 0)
            poses = read_poses(out)[0]
            # how far the trunk, half a metre of it, is ahead of its foot, along +Z; and how far above it
            leans.append([pose["neck"][2] - pose["spine"][2] for pose in poses.values()])
            heights.append([pose["spine"][1] - pose["hips"][1] for pose in poses.values()])
        leans, heights = ([one - other for one, other in zip(*both)] for both in (leans, heights))
        self.assertLess(min(leans[:60]), -0.01)
        self.assertGreater(max(leans[180:240]), 0.01)
        self.assertLess(min(heights), -0.01)
        self.assertGreater(max(heights), 0.01)
        self.assertAlmostEqual(leans[-1], 0, delta=0.008)

    def test_the_pudding_is_flat_where_it_lands_and_long_in_the_air(self):
        path, out, poses = (self.path(name) for name in ("pudding.sbf", "p.pc2", "p.csv"))
        maker = os.path.join(ROOT, "examples", "pudding", "make_pudding_bundle.py")
        subprocess.run([sys.executable, "-B", maker, PROGRAM, path], capture_output=True, check=True)
        self.assertEqual(self.json_of("validate", path)["errors"], 0)
        report = self.json_of("run", path, "--seconds", "6", "--script", self.script_of("pudding"), "--cache", out, "--pose", poses)
        self.assertTrue(report["valid"])
        self.assertGreater(report["volume_ratio_least"], 0.95)
        skin, bones = PointCache(out), read_poses(poses)[0]
        heights = [max(ys) - min(ys) for ys in ([skin.place(frame, i)[1] for i in range(skin.point_count)]
                                                for frame in range(skin.sample_count))]
        ups = [bones[i]["body"][1] for i in range(len(heights))]
        landings = [i for i in range(30, len(ups)) if ups[i] < 1e-3 < ups[i - 1]]
        self.assertGreaterEqual(len(landings), 4)
        for i in landings[:-1]:
            self.assertLess(min(heights[i:i + 12]), 0.8 * heights[0])
            self.assertGreater(max(heights[i - 20:i + 1]), 1.15 * heights[0])
            self.assertGreater(max(ups[i - 20:i]), 0.145)

    def test_walks_on_flat_ground_stay_within_the_figures(self):
        for name, (_, knee, slip) in WALKERS.items():
            path = self.bundle(name)
            leg = self.json_of("run", path, "--seconds", "0")["leg_length"]
            report = self.json_of("run", path, "--seconds", "5", "--drive", f"{0.5 * leg},0")
            self.assertLessEqual(report["stance_slip"], slip, name)
            self.assertLessEqual(report["penetration"], 0.001, name)
            self.assertEqual(report["skate_ratio"], 0, name)
            self.assertEqual(report["opposite_feet_in_air"], 0, name)
            self.assertLessEqual(report["knee_speed_step"], knee, name)
            self.assertGreaterEqual(report["distance"], 0.85 * 5 * 0.5 * leg, name)


if __name__ == "__main__":
    unittest.TestCase.longMessage = True
    main()
