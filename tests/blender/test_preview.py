"""Tests that the preview steps with the frames, resets, walks along a curve, and leaves nothing behind."""

import gc
import math
import os

import bpy
import fixtures
import numpy
from soft_body_format.preview import handlers, stage, walk_path
from soft_body_format.preview.session import JUMP
from soft_body_format.sbfmt import Asset, runtime

BUNDLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bundles")


def places(name):
    mesh = bpy.data.objects[name].data
    found = numpy.empty(3 * len(mesh.vertices), dtype=numpy.float32)
    mesh.vertices.foreach_get("co", found)
    return found.reshape(-1, 3)


class PreviewTest(fixtures.SceneTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(handlers.stop)
        self.settings = self.scene.soft_body_format.preview

    def start(self):
        self.assertEqual(bpy.ops.sbfmt.preview_start(), {"FINISHED"})
        return handlers.running()

    def blob(self, height=1.0):
        made = fixtures.ball("blob", 0.3, (0, 0, height))
        made.soft_body_format.attributes.preset = "flesh"
        return made

    def load(self, name):
        path = os.path.join(BUNDLES, name)
        if not os.path.exists(path):
            self.skipTest(f"{name} is not there")
        self.assertEqual(bpy.ops.import_scene.soft_body_format(filepath=path), {"FINISHED"})


class Frames(PreviewTest):
    def test_a_blob_falls_with_the_frames(self):
        self.blob()
        self.scene.frame_set(1)
        self.start()
        rest = places("blob (preview)")
        self.assertAlmostEqual(float(rest[:, 2].min()), 0.7, delta=1e-5)
        for frame in range(2, 8):
            self.scene.frame_set(frame)
        fallen = rest[:, 2].mean() - places("blob (preview)")[:, 2].mean()
        self.assertAlmostEqual(float(fallen), 0.5 * 9.81 * 0.25**2, delta=0.05)  # six frames of 1/24 s
        for frame in range(8, 60):
            self.scene.frame_set(frame)
        self.assertGreater(float(places("blob (preview)")[:, 2].min()), -0.01)
        self.assertLess(float(places("blob (preview)")[:, 2].min()), 0.02)

    def test_steps_backward_and_far_ahead_restart(self):
        self.blob()
        self.scene.frame_set(1)
        self.start()
        rest = places("blob (preview)")
        self.scene.frame_set(1 + JUMP - 1)
        self.assertGreater(float(abs(places("blob (preview)") - rest).max()), 0.1)
        nine = places("blob (preview)")
        self.scene.frame_set(5)
        numpy.testing.assert_array_equal(places("blob (preview)"), rest)
        self.scene.frame_set(14)
        numpy.testing.assert_array_equal(places("blob (preview)"), nine)
        self.scene.frame_set(14 + JUMP)
        numpy.testing.assert_array_equal(places("blob (preview)"), rest)

    def test_ground_of_an_object(self):
        self.blob(2.0)
        table = fixtures.box("table", (4, 4, 0.5), (0, 0, 0.75))
        table.soft_body_format.role = "IGNORE"
        self.settings.ground, self.settings.ground_object = "OBJECT", table
        self.start()
        for frame in range(1, 50):
            self.scene.frame_set(frame)
        self.assertAlmostEqual(float(places("blob (preview)")[:, 2].min()), 1.0, delta=0.02)

    def test_without_ground_it_falls_on(self):
        self.blob(0.0)
        self.settings.ground = "NONE"
        self.scene.frame_set(1)
        self.start()
        self.assertAlmostEqual(float(places("blob (preview)")[:, 2].min()), -0.3, delta=1e-3)
        for frame in range(2, 26):
            self.scene.frame_set(frame)
        self.assertLess(float(places("blob (preview)")[:, 2].max()), -3)

    def test_an_animation_is_followed(self):
        rig = fixtures.armature("rig", [("arm", None, (0, 0, 1), (0, 0, 2), 0)])
        fixtures.hang(fixtures.ball("belly", 0.3, (0, 0, 1.5)), rig, "arm")
        pose = rig.pose.bones["arm"]
        for frame, place in ((1, 0.0), (25, 1.0)):
            pose.location = (place, 0, 0)
            pose.keyframe_insert("location", frame=frame)
        self.scene.frame_set(1)
        self.start()
        for frame in range(2, 26):
            self.scene.frame_set(frame)
        self.assertAlmostEqual(float(places("belly (preview)")[:, 0].mean()), 1.0, delta=0.1)
        copy = bpy.data.objects["rig (preview)"].pose.bones["arm"]
        self.assertAlmostEqual(copy.matrix_basis.translation.x, 1.0, delta=0.05)

    def test_a_mirrored_and_rotated_object_starts_in_place(self):
        made = self.blob()
        made.matrix_world = made.matrix_world.copy()
        made.scale, made.rotation_euler, made.location = (-1, 1, 1), (0.3, 0.2, 0.1), (1, 2, 3)
        bpy.context.view_layer.update()
        wanted = [made.matrix_world @ vertex.co for vertex in made.data.vertices]
        self.start()
        found = places("blob (preview)")
        self.assert_near(numpy.ravel(found), [one for place in wanted for one in place], 1e-4)


    def test_preview_of_a_collection_instance(self):
        made = self.blob()
        inside = bpy.data.collections.new("inside")
        self.scene.collection.objects.unlink(made)
        inside.objects.link(made)
        instance = fixtures.link(bpy.data.objects.new("instance", None))
        instance.instance_type, instance.instance_collection, instance.location = "COLLECTION", inside, (3, 0, 0)
        bpy.context.view_layer.update()
        self.scene.frame_set(1)
        self.start()
        copy = next(one.name for one in bpy.data.objects if one.name.endswith("(preview)"))
        self.assertAlmostEqual(float(places(copy)[:, 0].mean()), 3, delta=0.05)
        self.assertTrue(instance.hide_get())
        before = float(places(copy)[:, 2].mean())
        self.scene.frame_set(6)
        self.assertLess(float(places(copy)[:, 2].mean()), before - 0.1)
        bpy.ops.sbfmt.preview_stop()
        self.assertFalse(instance.hide_get())


class Comings(PreviewTest):
    def test_the_scene_is_as_before(self):
        made = self.blob()
        before = {name: len(getattr(bpy.data, name)) for name in ("objects", "meshes", "collections", "armatures")}
        for _ in range(3):
            self.start()
            self.assertTrue(made.hide_get())
            self.scene.frame_set(self.scene.frame_current + 1)
        self.assertEqual(bpy.ops.sbfmt.preview_stop(), {"FINISHED"})
        self.assertIsNone(handlers.running())
        self.assertFalse(made.hide_get())
        self.assertEqual({name: len(getattr(bpy.data, name)) for name in before}, before)

    def test_stopping_frees_the_runtime(self):
        self.blob()
        for _ in range(3):
            self.start()
            bpy.ops.sbfmt.preview_stop()
        handlers.on_load_pre()
        gc.collect()
        left = [one for one in gc.get_objects() if isinstance(one, (runtime.World, runtime.Model, Asset))]
        self.assertEqual(left, [])

    def test_an_export_while_it_runs_is_the_scenes(self):
        self.blob()
        self.export("before.sbf")
        self.start()
        self.scene.frame_set(self.scene.frame_current + 5)
        self.export("during.sbf")
        with open(self.path("before.sbf"), "rb") as one, open(self.path("during.sbf"), "rb") as other:
            self.assertEqual(one.read(), other.read())

    def test_deleting_a_copy_ends_the_preview(self):
        made = self.blob()
        self.start()
        bpy.data.objects.remove(bpy.data.objects["blob (preview)"])
        self.scene.frame_set(self.scene.frame_current + 1)
        self.assertIsNone(handlers.running())
        self.assertFalse(made.hide_get())

    def test_saving_skips_copies_and_loading_ends_the_preview(self):
        self.blob()
        self.start()
        bpy.ops.wm.save_as_mainfile(filepath=self.path("scene.blend"))
        self.assertIn("blob (preview)", bpy.data.objects)
        self.assertIsNotNone(handlers.running())
        bpy.ops.wm.open_mainfile(filepath=self.path("scene.blend"))
        self.assertIsNone(handlers.running())
        self.assertNotIn("blob (preview)", bpy.data.objects)
        self.assertFalse(bpy.data.objects["blob"].hide_get())
        self.assertEqual(bpy.ops.sbfmt.preview_start(), {"FINISHED"})

    def test_undo(self):
        made = self.blob()
        bpy.ops.ed.undo_push(message="blob")
        self.start()
        bpy.ops.ed.undo_push(message="started")
        bpy.ops.ed.undo()
        self.assertIsNone(handlers.running())
        self.assertNotIn(stage.NAME, bpy.data.collections)
        self.assertFalse(bpy.data.objects["blob"].hide_get())
        bpy.ops.ed.redo()
        self.assertNotIn(stage.NAME, bpy.data.collections)
        self.assertFalse(bpy.data.objects["blob"].hide_get())
        del made

    def test_the_preview_does_not_step_during_a_render(self):
        self.blob()
        session = self.start()
        frame = session.frame
        handlers.on_render_begin()
        self.scene.frame_set(frame + 3)
        self.assertEqual(session.frame, frame)
        handlers.on_render_end()
        self.scene.frame_set(frame + 4)
        self.assertEqual(session.frame, frame + 4)

    def test_unsupported_exports_are_reported(self):
        with self.assertRaisesRegex(RuntimeError, "nothing to export"):
            bpy.ops.sbfmt.preview_start()
        self.assertFalse(bpy.ops.sbfmt.preview_stop.poll())


class Walks(PreviewTest):
    def curve(self, points, cyclic=False):
        data = bpy.data.curves.new("way", "CURVE")
        data.dimensions = "3D"
        spline = data.splines.new("POLY")
        spline.points.add(len(points) - 1)
        for point, place in zip(spline.points, points):
            point.co = (*place, 0, 1)
        spline.use_cyclic_u = cyclic
        self.settings.curve = fixtures.link(bpy.data.objects.new("way", data))

    def test_a_lizard_walks_along_a_curve(self):
        self.load("lizard.sbf")
        self.curve([(0, 0), (0, -1), (1, -2), (2, -2)])
        self.settings.drive, self.settings.speed = "CURVE", 0.5
        self.scene.frame_set(1)
        session = self.start()
        wide = 0.0
        for frame in range(2, 260):
            self.scene.frame_set(frame)
            position, _ = session.ground_position()
            path = session.walker.path
            gaps = [float(numpy.linalg.norm(path.at(along) - position)) for along in numpy.linspace(0, path.length, 200)]
            wide = max(wide, min(gaps))
        end, _ = session.ground_position()
        self.assertLess(float(numpy.linalg.norm(end - (2, 2))), 0.3)
        self.assertLess(wide, 0.3)
        self.assertGreater(session.character.distance, 2.5)
        self.scene.frame_set(1)
        self.assertLess(float(numpy.linalg.norm(session.ground_position()[0])), 0.05)

    def test_a_missing_curve_is_reported_and_the_character_stands(self):
        self.load("lizard.sbf")
        self.settings.drive = "CURVE"
        session = self.start()
        for frame in range(1, 10):
            self.scene.frame_set(frame)
        self.assertLess(session.character.distance, 0.05)

    def test_a_speed_may_be_animated(self):
        self.load("lizard.sbf")
        self.settings.drive = "WALK"
        for frame, speed in ((1, 0.0), (40, 0.0), (41, 0.4)):
            self.settings.speed = speed
            self.settings.keyframe_insert("speed", frame=frame)
        self.scene.frame_set(1)
        session = self.start()
        for frame in range(2, 41):
            self.scene.frame_set(frame)
        stood = session.character.distance
        for frame in range(41, 90):
            self.scene.frame_set(frame)
        self.assertLess(stood, 0.02)
        self.assertGreater(session.character.distance, 0.3)


class Paths(fixtures.SceneTest):
    def test_a_closed_path_continues(self):
        square = walk_path.WalkPath([(0, 0), (1, 0), (1, 1), (0, 1)], True)
        self.assertAlmostEqual(square.length, 4)
        self.assert_near(square.at(4.5), (0.5, 0))
        self.assertAlmostEqual(square.heading(0.5), math.pi / 2)
        line = walk_path.WalkPath([(0, 0), (0, 2)], False)
        self.assert_near(line.at(5), (0, 2))
        self.assertAlmostEqual(line.heading(2.0), 0.0)

    def test_chains_of_edges(self):
        self.assertEqual(walk_path.chain([(0, 1), (1, 2), (5, 6)], 7), ([0, 1, 2], False))
        self.assertEqual(walk_path.chain([(0, 1), (1, 2), (2, 0)], 3), ([0, 1, 2], True))
        self.assertEqual(walk_path.chain([], 0), ([], False))
