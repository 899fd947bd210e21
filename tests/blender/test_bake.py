"""Tests bakes of the preview: point caches and shape keys play the same motion as the preview, and can be cut and removed."""

import glob
import math
import os

import bpy
import fixtures
import numpy
from soft_body_format.preview import baked, handlers
from soft_body_format.preview.point_cache import CacheWriter, cut_cache, read_cache


def shown(name):
    """Points of an object as they are seen, in the world."""
    source = bpy.data.objects[name].evaluated_get(bpy.context.evaluated_depsgraph_get())
    return numpy.array([source.matrix_world @ vertex.co for vertex in source.data.vertices])


class Bakes(fixtures.SceneTest):
    def setUp(self):
        super().setUp()
        self.addCleanup(handlers.stop)
        self.settings = self.scene.soft_body_format.preview
        self.settings.bake_folder = self.path("cache")
        self.settings.bake_start, self.settings.bake_end = 5, 20
        self.blob = fixtures.ball("blob", 0.3)
        self.blob.location, self.blob.rotation_euler, self.blob.scale = (0.5, 0, 1), (0.4, 0.3, 0.2), (1, -1.2, 1)
        bpy.context.view_layer.update()

    def watched(self, name="blob"):
        """{frame: places} of the preview over the bake's range."""
        self.scene.frame_set(self.settings.bake_start)
        bpy.ops.sbfmt.preview_start()
        found = {}
        for frame in range(self.settings.bake_start, self.settings.bake_end + 1):
            self.scene.frame_set(frame)
            found[frame] = shown(f"{name} (preview)")
        bpy.ops.sbfmt.preview_stop()
        return found

    def bake(self, to):
        self.settings.bake_to = to
        self.assertEqual(bpy.ops.sbfmt.bake(), {"FINISHED"})

    def assert_plays(self, name, watched, frames):
        for frame in frames:
            self.scene.frame_set(frame)
            self.assertLess(float(abs(shown(name) - watched[frame]).max()), 1e-4, f"frame {frame}")

    def test_point_caches_play_the_preview(self):
        watched = self.watched()
        for kind in ("PC2", "MDD"):
            with self.subTest(kind):
                self.bake(kind)
                self.assertEqual(os.listdir(self.path("cache"))[-1].lower()[-3:], kind.lower())
                self.assert_plays("blob", watched, range(5, 21))
                self.assertEqual([one.name for one in self.blob.modifiers], [baked.NAME])
                os.unlink(glob.glob(self.path("cache/*"))[0])
                bpy.ops.sbfmt.bake_free()
        self.assertEqual(len(self.blob.modifiers), 0)

    def test_a_point_cache_is_cut_at_its_ends(self):
        watched = self.watched()
        self.bake("PC2")
        self.assertEqual(bpy.ops.sbfmt.bake_cut(start=8, end=15), {"FINISHED"})
        self.assert_plays("blob", watched, range(8, 16))
        self.scene.frame_set(20)
        self.assertLess(float(abs(shown("blob") - watched[15]).max()), 1e-4)
        with self.assertRaisesRegex(RuntimeError, "exchange"):
            bpy.ops.sbfmt.bake_cut(start=8, end=5)

    def test_shape_keys_play_the_preview_and_are_cut(self):
        watched = self.watched()
        self.bake("SHAPE_KEYS")
        self.assert_plays("blob (baked)", watched, range(5, 21))
        self.assertTrue(self.blob.hide_get())
        self.assertEqual(bpy.ops.sbfmt.bake_cut(start=8, end=15), {"FINISHED"})
        keys = bpy.data.objects["blob (baked)"].data.shape_keys
        self.assertEqual([block.name for block in keys.key_blocks][1:], [baked.key_name(frame) for frame in range(8, 16)])
        self.assertEqual(sum(len(curves) for curves in baked.curve_lists(keys)), 8)
        self.assert_plays("blob (baked)", watched, range(8, 16))
        self.assertEqual([mesh.name for mesh in self.export(build=False).render_meshes], ["blob"])
        bpy.ops.sbfmt.bake_free()
        self.assertFalse(self.blob.hide_get())
        self.assertEqual([one.name for one in bpy.data.objects], ["blob"])

    def test_fewer_shape_keys(self):
        watched = self.watched()
        self.settings.key_every = 4
        self.bake("SHAPE_KEYS")
        keys = bpy.data.objects["blob (baked)"].data.shape_keys
        self.assertEqual(len(keys.key_blocks) - 1, 5)
        self.assert_plays("blob (baked)", watched, (5, 9, 13, 17, 20))
        self.scene.frame_set(11)
        self.assertLess(float(abs(shown("blob (baked)") - (watched[9] + watched[13]) / 2).max()), 1e-4)

    def test_meshes_missing_from_the_scene_play_as_copies(self):
        """What a collection instance shows, and a curve."""
        inside = bpy.data.collections.new("inside")
        self.scene.collection.objects.unlink(self.blob)
        inside.objects.link(self.blob)
        instance = fixtures.link(bpy.data.objects.new("instance", None))
        instance.instance_type, instance.instance_collection, instance.location = "COLLECTION", inside, (3, 0, 0)
        data = bpy.data.curves.new("ring", "CURVE")
        data.dimensions, data.bevel_depth, data.bevel_resolution = "3D", 0.1, 1
        spline = data.splines.new("POLY")
        spline.points.add(5)
        for index, point in enumerate(spline.points):
            point.co = (0.4 * math.cos(index * math.pi / 3), 0.4 * math.sin(index * math.pi / 3), 1, 1)
        spline.use_cyclic_u = True
        ring = fixtures.link(bpy.data.objects.new("ring", data))
        ring.location = (-2, 0, 0)
        for name, owner in (("instance/blob", instance), ("ring", ring)):
            watched = self.watched(name)
            self.assertGreater(float((watched[5] - watched[20])[:, 2].max()), 0.05)
            for kind in ("PC2", "SHAPE_KEYS"):
                with self.subTest(f"{name}, {kind}"):
                    self.bake(kind)
                    self.assert_plays(f"{name} (baked)", watched, (5, 11, 20))
                    self.assertTrue(owner.hide_get())
                    bpy.ops.sbfmt.bake_cut(start=8, end=12)
                    self.assert_plays(f"{name} (baked)", watched, (8, 12))
                    bpy.ops.sbfmt.bake_free()
                    self.assertFalse(owner.hide_get())
                    self.settings.bake_start, self.settings.bake_end = 5, 20

    def test_invalid_bakes_are_refused(self):
        self.settings.bake_folder = "//cache"
        with self.assertRaisesRegex(RuntimeError, "save it"):
            bpy.ops.sbfmt.bake()
        self.settings.bake_folder = self.path("file")
        with open(self.path("file"), "w", encoding="utf-8") as file:
            file.write("not a folder")
        with self.assertRaisesRegex(RuntimeError, "file"):
            bpy.ops.sbfmt.bake()
        self.settings.bake_end = 1
        with self.assertRaisesRegex(RuntimeError, "exchange"):
            bpy.ops.sbfmt.bake()
        self.assertFalse(bpy.ops.sbfmt.bake_cut.poll())
        self.assertFalse(bpy.ops.sbfmt.bake_free.poll())
        self.assertEqual(len(self.blob.modifiers), 0)


class Files(fixtures.SceneTest):
    def test_written_read_and_cut(self):
        frames = numpy.arange(5 * 4 * 3, dtype=numpy.float32).reshape(5, 4, 3)
        for name in ("a.pc2", "a.mdd"):
            writer = CacheWriter(self.path(name), 4, 5, 1, 24.0)
            for positions in frames:
                writer.write(positions)
            writer.close()
            numpy.testing.assert_array_equal(read_cache(self.path(name)), frames)
            cut_cache(self.path(name), self.path(f"cut_{name}"), 1, 3, 2, 24.0)
            numpy.testing.assert_array_equal(read_cache(self.path(f"cut_{name}")), frames[1:4])

    def test_dropped(self):
        writer = CacheWriter(self.path("a.pc2"), 4, 5, 1, 24.0)
        writer.drop()
        self.assertEqual(os.listdir(self.folder), [])
