"""`sbfmt run`: its report, the files it leaves, the same motion for any number of threads, scripts of commands."""

import math
import os
import re
import stat
import threading
import unittest

from motion_files import PointCache, read_poses, read_sections
from sbfmt_program import ProgramTest, call, example, main, read_bytes, write_bytes

KEYS = {"seconds", "steps", "substeps", "us_per_frame", "state_hash", "valid", "recoveries", "energy", "volume_ratio", "max_strain"}
KEYS_OF_WALKERS = {"distance", "steps_taken", "stance_slip", "penetration"}


class Run(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.file = example(cls.class_folder.name)

    def run_json(self, *arguments, seconds=0.5):
        return self.json_of("run", self.file, "--seconds", seconds, *arguments)

    def run_script(self, text, *arguments, seconds=1):
        script = write_bytes(self.path("script.txt"), text.encode())
        return self.run_json("--script", script, *arguments, seconds=seconds)

    # ---- The report ----

    def test_the_report_has_the_keys_of_the_contract(self):
        report = self.run_json()
        self.assertLessEqual(KEYS | KEYS_OF_WALKERS, set(report))
        self.assertEqual((report["seconds"], report["steps"], report["valid"]), (0.5, 30, True))
        self.assertEqual(len(report["steps_taken"]), 4)
        for key in KEYS - {"valid", "state_hash"}:
            self.assertTrue(math.isfinite(report[key]), key)
        self.assertGreaterEqual(report["substeps"], 1)

    def test_the_text_is_equal(self):
        text = self.good("run", self.file, "--seconds", "0.1").out
        for key in KEYS:
            self.assertIn(key, text)

    def test_text_has_units_and_a_line_a_leg(self):
        report = self.run_json("--drive", "0.4,0", seconds=3)
        text = self.good("run", self.file, "--seconds", "3", "--drive", "0.4,0").out
        self.assertRegex(text, r"(?m)^distance +[0-9.]+ m$")
        self.assertRegex(text, r"(?m)^us_per_frame +[0-9.]+ us$")
        self.assertRegex(text, rf"(?m)^state_hash +{report['state_hash']}$")
        self.assertRegex(text, r"(?m)^valid +true$")
        for leg, steps in report["steps_taken"].items():
            self.assertRegex(text, rf"(?m)^steps_taken .*\b{re.escape(leg)} {steps}(,|$)")
            self.assertRegex(text, rf"(?m)^  {re.escape(leg)} +stride [0-9.]+ m, period [0-9.]+ s, ")
        self.assertNotIn("{", text)

    def test_a_ragdoll_is_drawn_too_and_needs_rigid_bodies(self):
        """The options of --ragdoll apply to every verb that moves a character, and to its recording."""
        tape = self.path("fall.sbrec")
        fallen = self.run_json("--ragdoll", "--record", tape)
        self.assertEqual(self.run_json("--replay", tape)["state_hash"], fallen["state_hash"])
        self.assertNotEqual(self.run_json()["state_hash"], fallen["state_hash"])
        self.assertLess(fallen["limit_excess"], 0.1)  # degrees
        still, down, up = (self.path(name) for name in ("still.obj", "down.pc2", "up.pc2"))
        self.good("export", self.file, "-o", down, "--seconds", "1", "--ragdoll")
        self.good("export", self.file, "-o", up, "--seconds", "1")
        self.assertNotEqual(read_bytes(down), read_bytes(up))
        write_bytes(still, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.good("convert", still, "-o", self.path("still.sbf"))
        refused = call("run", self.path("still.sbf"), "--ragdoll")
        self.assertEqual(refused.status, 2)
        self.assertIn("no rigid bodies", refused.err)

    def test_the_same_call_gives_the_same_state(self):
        hashes = {self.run_json("--drive", "0.2,0.1")["state_hash"] for _ in range(2)}
        self.assertEqual(len(hashes), 1)
        self.assertNotIn(self.run_json("--drive", "0.2,0.11")["state_hash"], hashes)

    def test_the_state_does_not_depend_on_threads(self):
        files = []
        for threads in (1, 2, 5):
            out = self.path(f"{threads}.pc2")
            report = self.run_json("--drive", "0.3,0.2", "--threads", threads, "--cache", out)
            files.append((report["state_hash"], read_bytes(out)))
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])

    def test_the_state_does_not_depend_on_frames(self):
        ends = {fps: self.run_json("--drive", "0.3,0.2", "--fps", fps, seconds=1)["state_hash"] for fps in (30, 60, 240)}
        self.assertEqual(len(set(ends.values())), 1, ends)

    def test_both_forms_move_equally(self):
        packed = self.path("a.sbfz")
        self.good("pack", self.file, "-o", packed)
        report = self.json_of("run", packed, "--seconds", "0.5")
        self.assertEqual(report["state_hash"], self.run_json()["state_hash"])

    # ---- Options ----

    def test_bones_stay_at_rest_with_hold(self):
        out = self.path("p.csv")
        self.run_json("--hold", "--drive", "0,0", "--pose", out)
        poses, _, _ = read_poses(out)
        for bone, first in poses[0].items():
            for a, b in zip(first, poses[30][bone]):
                self.assertAlmostEqual(a, b, delta=1e-6)

    def test_freed_sections_fall(self):
        out = self.path("f.pc2")
        self.run_json("--free", "--raise", "1", "--hold", "--cache", out, "--of", "surface", seconds=0.3)
        cache = PointCache(out)
        fall = [cache.place(0, i)[1] - cache.place(18, i)[1] for i in range(0, cache.point_count, 97)]
        expected = 0.5 * 9.81 * 0.3 ** 2
        for distance in fall:
            self.assertAlmostEqual(distance, expected, delta=0.12 * expected)

    def test_gravity_can_be_turned_off(self):
        out = self.path("g.pc2")
        self.run_json("--gravity", "0", "--hold", "--cache", out, "--of", "surface")
        cache = PointCache(out)
        for i in range(0, cache.point_count, 97):
            self.assertLess(math.dist(cache.place(0, i), cache.place(30, i)), 1e-4)

    def test_every_ground_of_the_contract(self):
        for ground in ("flat", "slope:12", "stairs:0.03,0.2", "noise:0.05,7"):
            report = self.run_json("--ground", ground, "--drive", "0.2,0", seconds=2)
            self.assertTrue(report["valid"], ground)

    def test_all_instructions_give_the_same_state(self):
        expected = self.run_json("--instructions", "scalar")["state_hash"]
        ran = [name for name in ("automatic", "sse2", "avx2", "avx512", "neon")
               if call("run", self.file, "--seconds", "0", "--instructions", name).status == 0]
        self.assertGreaterEqual(len(ran), 2)
        for name in ran:
            self.assertEqual(self.run_json("--instructions", name)["state_hash"], expected, name)
        self.assertNotEqual(call("run", self.file, "--instructions", "mmx").status, 0)

    def test_each_scheme_offered_runs_and_others_are_refused(self):
        hashes = {scheme: self.run_json("--scheme", scheme)["state_hash"] for scheme in ("symplectic", "position_based", "relaxation", "explicit_euler", "heun", "block_descent")}
        self.assertEqual(len(set(hashes.values())), 6)
        self.assertEqual(self.run_json("--scheme", "automatic")["state_hash"], hashes["symplectic"])
        result = call("run", self.file, "--scheme", "implicit")
        self.assertNotEqual(result.status, 0)
        self.assertIn("implicit", result.err)

    def test_no_time_is_a_good_run(self):
        report = self.run_json(seconds=0)
        self.assertEqual((report["steps"], report["valid"]), (0, True))

    # ---- Files ----

    def test_the_cache_of_the_surface_is_a_pc2_of_every_section_in_file_order(self):
        out, poses_out = self.path("s.pc2"), self.path("p.csv")
        self.run_json("--cache", out, "--of", "surface", "--pose", poses_out, "--fps", "30")
        cache, sections = PointCache(out), read_sections(self.file)
        self.assertEqual((cache.magic, cache.version), (b"POINTCACHE2\0", 1))
        self.assertEqual((cache.start, cache.frames_a_sample), (0, 1))
        self.assertEqual(cache.point_count, sum(len(s.rest) for s in sections))
        self.assertEqual(cache.sample_count, 16)
        self.assertEqual(len(cache.bytes), cache.expected_size())
        for section in sections:
            for i, place in enumerate(section.rest):
                self.assertLess(math.dist(cache.place(0, section.first + i), place), 1e-4, section.name)

    def test_the_cache_of_the_skin_is_the_render_meshes(self):
        out = self.path("s.pc2")
        self.run_json("--cache", out)
        info = self.json_of("info", self.file)
        cache = PointCache(out)
        self.assertEqual(cache.point_count, sum(m["vertices"] for m in info["render_meshes"]))
        self.assertEqual(cache.sample_count, 31)
        low = [min(cache.place(0, i)[k] for i in range(cache.point_count)) for k in range(3)]
        for here, there in zip(low, info["bounds"]["min"]):
            self.assertAlmostEqual(here, there, delta=2e-3)

    def test_the_pose_file_has_a_row_for_every_bone_of_every_frame(self):
        out = self.path("p.csv")
        self.run_json("--pose", out, "--drive", "0.3,0", "--fps", "30", seconds=1)
        poses, header, times = read_poses(out)
        self.assertEqual(header, "frame,time,bone,px,py,pz,qx,qy,qz,qw".split(","))
        self.assertEqual(sorted(poses), list(range(31)))
        names = {bone["name"] for bone in self.json_of("info", self.file)["bones"]}
        for frame, pose in poses.items():
            self.assertEqual(set(pose), names)
            self.assertAlmostEqual(times[frame], frame / 30, delta=1e-5)
            for row in pose.values():
                self.assertAlmostEqual(sum(n * n for n in row[3:]), 1, delta=1e-5)

    def test_bones_of_any_name_have_their_field(self):
        strange = 'left, or "L"\nof it'
        text = read_bytes(self.file).decode()
        first = next(bone["name"] for bone in self.json_of("info", self.file)["bones"])
        quoted = strange.replace('"', "&quot;").replace("\n", "&#10;")
        self.assertIn(f'name="{first}"', text)
        odd = write_bytes(self.path("odd.sbf"), text.replace(f'name="{first}"', f'name="{quoted}"').encode())
        self.json_of("run", odd, "--seconds", "0", "--pose", self.path("p.csv"))
        self.assertIn(strange, read_poses(self.path("p.csv"))[0][0])

    def test_no_temporary_files_are_left(self):
        self.run_json("--cache", self.path("a.pc2"), "--pose", self.path("b.csv"))
        self.assert_empty_folder(but=["a.pc2", "b.csv"])

    def test_a_pipe_is_written_to_and_not_replaced(self):
        """The same is true for a device, as in `--pose /dev/null` by root."""
        pipe, printed = self.path("pipe"), []
        os.mkfifo(pipe)
        reader = threading.Thread(target=lambda: printed.append(read_bytes(pipe)))
        reader.start()
        self.run_json("--pose", pipe, seconds=0.1)
        reader.join(10)
        self.assertTrue(stat.S_ISFIFO(os.stat(pipe).st_mode))
        self.assertTrue(printed and printed[0].startswith(b"frame,time,bone"))

    # ---- Scripts ----

    def test_a_script_drives(self):
        self.assertEqual(self.run_script("0 drive 0.3 0.1\n")["state_hash"],
                         self.run_json("--drive", "0.3,0.1", seconds=1)["state_hash"])
        self.assertGreater(self.run_script("# go\n\n 0.25 drive 0.3 0 # half the time\n0.75 drive 0 0\n")["distance"],
                           0.05)

    def test_a_script_teleports(self):
        out = self.path("p.csv")
        self.run_script("0.5 teleport 3 0 -2 1.5707963\n", "--pose", out)
        poses, _, _ = read_poses(out)
        root = self.json_of("info", self.file)["bones"][0]["name"]
        before, after = poses[0][root], poses[60][root]
        # Turned by a quarter to the left, +Z became +X.
        self.assertAlmostEqual(after[0], 3 + before[2], delta=0.02)
        self.assertAlmostEqual(after[2], -2 - before[0], delta=0.02)

    def test_a_script_pauses_and_resumes(self):
        out = self.path("p.csv")
        self.run_script("0 drive 0.3 0\n0.3 pause\n0.6 resume\n", "--pose", out)
        poses, _, _ = read_poses(out)
        self.assertEqual(poses[20], poses[34])
        self.assertNotEqual(poses[34], poses[50])

    def test_a_script_resets(self):
        report = self.run_script("0 drive 0.3 0\n0.9 drive 0 0\n0.95 reset\n")
        self.assertTrue(report["valid"])

    def test_a_bad_script_is_refused_with_its_line(self):
        for text, line in (("0 jump\n", 1), ("1 reset\n0 reset\n", 2), ("0 drive 1\n", 1), ("\n# x\n0 teleport 1 2\n", 3),
                           ("0 drive 1 2 3 4 5\n", 1), ("soon reset\n", 1), ("-1 reset\n", 1), ("0 pause now\n", 1),
                           ("0 drive nan 0\n", 1), ("0 teleport 0 inf 0\n", 1), ("nan reset\n", 1), ("0 drive 1e300 0\n", 1),
                           ("0 reset" + " " * 600 + "1 reset\n", 1), ("0 reset\n1 play 99\n", 2), ("0 play 0.5 1 0 4\n", 1),
                           ("0 reach 99 0 0 0\n", 1), ("0 release -1\n", 1), ("0 pivot 4\n", 1)):
            script = write_bytes(self.path("script.txt"), text.encode())
            message = self.fails(1, "run", self.file, "--script", script)
            self.assertIn(f"script.txt:{line}:", message, text)
        self.fails(2, "run", self.file, "--script", self.path("absent.txt"))
        self.assertIn("cannot be read", self.fails(2, "run", self.file, "--script", self.folder))

    def test_a_script_of_zero_bytes_is_refused(self):
        for text, line in ((b"\0\0", 1), (b"0 reset\n \0\n", 2), (b"\0" * 5000 + b"\n0 reset\n", 1)):
            script = write_bytes(self.path("script.txt"), text)
            self.assertIn(f"script.txt:{line}:", self.fails(1, "run", self.file, "--script", script))

    @unittest.skipUnless(os.path.exists("/dev/zero"), "no /dev/zero here")
    def test_a_script_without_end_is_refused(self):
        self.assertIn("/dev/zero:1:", self.fails(1, "run", self.file, "--script", "/dev/zero", timeout=20))

    def test_a_comment_may_be_long(self):
        long = self.run_script("0 drive 0.3 0.1 # " + "0 reset " * 200 + "\n0.1 drive 0 0\n")
        self.assertEqual(long["state_hash"], self.run_script("0 drive 0.3 0.1\n0.1 drive 0 0")["state_hash"])

    def test_too_many_substeps_are_refused(self):
        self.assertIn("--substeps takes a whole number from 1 to 1024",
                      self.fails(2, "run", self.file, "--seconds", "0", "--substeps", "1025"))

    def test_long_runs_stay_in_bounds(self):
        report = self.run_script("0 drive 0.3 0.5\n3 drive -0.2 -0.5\n5 drive 0 0\n", seconds=6)
        self.assertTrue(report["valid"])
        self.assertLess(report["max_strain"], 1.5)
        self.assertGreater(report["volume_ratio"], 0.9)

    def test_the_caches_folder_must_exist(self):
        self.fails(2, "run", self.file, "--cache", os.path.join(self.folder, "no", "a.pc2"))


if __name__ == "__main__":
    main()
