"""Tests that builds, overlays and exports use the settings of the build panel."""

import bpy
import fixtures
from soft_body_format.overlay import structure
from soft_body_format.settings.build_settings import build_arguments


class Options(fixtures.SceneTest):
    def setUp(self):
        super().setUp()
        self.build = self.scene.soft_body_format.build

    def limb(self):
        """A skin over two bones."""
        rig = fixtures.armature("rig", [("upper", None, (0, 0, 0), (0, 0, 1), 0), ("lower", "upper", (0, 0, 1), (0, 0, 2), 0)])
        made = fixtures.ball("limb", 0.5, segments=16, rings=16)
        for vertex in made.data.vertices:
            vertex.co.z = (vertex.co.z + 0.5) * 2
        fraction = {vertex.index: min(max(vertex.co.z - 0.5, 0), 1) for vertex in made.data.vertices}
        fixtures.bind(made, rig, {"upper": {i: 1 - s for i, s in fraction.items()}, "lower": dict(fraction)})
        return rig

    def test_sizes(self):
        fixtures.ball("blob")
        counts = []
        for size, value in (("ELEMENTS", 300), ("ELEMENTS", 3000)):
            self.build.size_by, self.build.elements = size, value
            counts.append(len(self.export().soft_bodies[0].levels[0].lattice.tetrahedra) // 4)
        self.assertLess(counts[0], 1000)
        self.assertGreater(counts[1], 1500)
        self.build.size_by, self.build.cell = "CELL", 0.25
        self.assertLess(len(self.export().soft_bodies[0].levels[0].lattice.tetrahedra) // 4, counts[1])
        self.build.size_by, self.build.error = "ERROR", 0.01
        self.export()

    def test_lengths_are_the_scenes(self):
        self.scene.unit_settings.scale_length = 0.01
        self.build.size_by, self.build.cell, self.build.overlap = "CELL", 5, 2
        arguments = build_arguments(self.scene, 0.01)
        self.assertAlmostEqual(arguments["cell"], 0.05)
        self.assertAlmostEqual(arguments["overlap"], 0.02)

    def test_interior_and_number_of_levels(self):
        fixtures.ball("blob")
        for interior, model in (("none", "springs"), ("lattice", "springs"), ("tetrahedra", "tetrahedra")):
            self.build.interior = interior
            self.assertEqual(self.export().soft_bodies[0].levels[0].model, model)
        self.build.levels, self.build.size_by, self.build.elements = 2, "ELEMENTS", 3000  # a coarse level is left out where it is off
        self.assertEqual(len(self.export().soft_bodies[0].levels), 2)

    def test_bending_springs_may_be_left_out(self):
        fixtures.ball("blob")
        self.build.interior, self.build.flexion = "none", False
        bpy.ops.sbfmt.build()
        self.assertNotIn("flexion", structure.summary(self.scene))

    def test_split_by_bones(self):
        self.limb()
        self.assertEqual(len(self.export().soft_bodies), 2)
        self.build.sections = False
        self.assertEqual(len(self.export().soft_bodies), 0)

    def test_render_levels(self):
        fixtures.ball("blob", segments=32, rings=16)
        self.build.render_levels = 2
        self.assertEqual(len(self.export().render_meshes[0].levels), 2)

    def test_material_of_sections_and_of_one_bones(self):
        rig = self.limb()
        self.build.use_material, self.build.attributes.preset = True, "rubber"
        lower = rig.data.bones["lower"].soft_body_format
        lower.use_material, lower.attributes.preset = True, "jelly"
        asset = self.export()
        bones = {bone.id: bone.name for bone in asset.bones}
        self.assertEqual({bones[body.bone]: body.attributes.young_modulus for body in asset.soft_bodies},
                         {"upper": 1.2e6, "lower": 3000})
        fixtures.fresh_scene()
        bpy.ops.import_scene.soft_body_format(filepath=self.path("out.sbf"))
        build = bpy.context.scene.soft_body_format.build
        self.assertTrue(build.use_material)
        self.assertAlmostEqual(build.attributes.young_modulus, 1.2e6)
        again = next(one for one in bpy.data.objects if one.type == "ARMATURE").data.bones["lower"].soft_body_format
        self.assertAlmostEqual(again.attributes.young_modulus, 3000)

    def test_rigid_parts_and_tetrahedra_of_a_section_come_back(self):
        rig = self.limb()
        for name, rigid, elements in (("upper", True, 0), ("lower", False, 30)):
            bone = rig.data.bones[name].soft_body_format
            bone.use_material, bone.rigid, bone.elements = True, rigid, elements
        asset = self.export()
        bones = {bone.id: bone.name for bone in asset.bones}
        self.assertEqual([bones[body.bone] for body in asset.soft_bodies], ["lower"])
        fixtures.fresh_scene()
        bpy.ops.import_scene.soft_body_format(filepath=self.path("out.sbf"))
        rig = next(one for one in bpy.data.objects if one.type == "ARMATURE")
        settings = {bone.name: bone.soft_body_format for bone in rig.data.bones}
        self.assertEqual([(settings[name].rigid, settings[name].elements) for name in ("upper", "lower")], [(True, 0), (False, 30)])
