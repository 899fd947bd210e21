"""Tests objects that are exported as meshes: curves, NURBS surfaces, texts, metaballs, instances of geometry nodes. Tests reports of
objects that cannot be exported."""

import bpy
import fixtures
from soft_body_format.findings import Findings
from soft_body_format.to_document import Options, SceneWriter


def reported(**options):
    """{object's name: (severity, message)}."""
    found = Findings()
    SceneWriter(bpy.context, Options(textures="EMBED", **options), found).write()
    return {one.object_name: (one.severity, one.message) for one in found}


def tube(name="tube", bevel=0.1):
    data = bpy.data.curves.new(name, "CURVE")
    data.dimensions, data.bevel_depth, data.bevel_resolution = "3D", bevel, 0
    spline = data.splines.new("POLY")
    spline.points.add(1)
    spline.points[0].co, spline.points[1].co = (0, 0, 1, 1), (2, 0, 1, 1)
    return fixtures.link(bpy.data.objects.new(name, data))


class Surfaces(fixtures.SceneTest):
    def bounds(self, record):
        return [pick(record.mesh.positions[axis::3]) for axis in range(3) for pick in (min, max)]

    def test_a_curve_with_a_bevel(self):
        """A tube along X at the height of 1 m, with the material of its slot."""
        made = tube()
        material, _ = fixtures.shaded("rubber")
        made.data.materials.append(material)
        made.location = (0, 0, 3)
        asset = self.export(build=False)
        record = asset.render_meshes[0]
        self.assertEqual((record.name, list(record.mesh.polygon_sizes), len(asset.soft_bodies)), ("tube", [4] * 4, 1))
        self.assert_near(self.bounds(record), (0, 2, 3.9, 4.1, -0.1, 0.1), 1e-5)
        self.assertEqual(asset.find("materials", record.material_slots[0].material).name, "rubber")

    def test_a_curve_with_a_soft_body_modifier_and_one_with_a_role(self):
        soft = tube("soft").modifiers.new("Softbody", "SOFT_BODY")
        soft.settings.pull = 0.5
        tube("seen").soft_body_format.role = "RENDER"
        tube("part").soft_body_format.role = "COLLISION"
        tube("hidden").soft_body_format.role = "IGNORE"
        asset = self.export(build=False)
        self.assertEqual([one.name for one in asset.render_meshes], ["part", "seen", "soft"])
        self.assertEqual([one.name for one in asset.soft_bodies], ["soft"])
        self.assertEqual([one.name for one in asset.rigid_bodies], ["part"])
        self.assertGreater(len(asset.soft_bodies[0].levels[0].springs[0].ends), 0)

    def test_a_text_a_surface_and_metaballs(self):
        data = bpy.data.curves.new("word", "FONT")
        data.body, data.extrude = "A", 0.1
        fixtures.link(bpy.data.objects.new("word", data))
        bpy.ops.surface.primitive_nurbs_surface_sphere_add(radius=1, location=(5, 0, 0))
        for index in range(2):
            bpy.ops.object.metaball_add(type="BALL", radius=1, location=(10 + index, 0, 0))
        names = [one.name for one in bpy.data.objects]
        asset = self.export(build=False)
        found = {one.name: one for one in asset.render_meshes}
        self.assertEqual(set(found), set(names) - {"Mball.001"})
        self.assertAlmostEqual(max(found["word"].mesh.positions[1::3]), 0.1, places=5)
        low, high = self.bounds(found["Mball"])[:2]
        self.assertTrue(low < 9.5 and high > 11.5, (low, high))
        self.assertEqual(reported()["Mball.001"][0], "INFO")

    def test_curves_without_a_surface_and_unevaluated_curves_are_reported(self):
        fixtures.box("b")
        tube("way", bevel=0)
        tube("hose")
        self.assertEqual({name: severity for name, (severity, _) in reported().items()}, {"way": "INFO"})
        found = reported(apply_modifiers=False)
        self.assertEqual({name: severity for name, (severity, _) in found.items()}, {"way": "WARNING", "hose": "WARNING"})
        self.assertIn("Convert", found["hose"][1])

    def test_objects_without_a_mesh_are_reported(self):
        fixtures.box("b")
        fixtures.link(bpy.data.objects.new("smoke", bpy.data.volumes.new("smoke")))
        self.assertEqual(reported()["smoke"][0], "WARNING")


class Instances(fixtures.SceneTest):
    def nodes(self, shown):
        """A group that shows an object at each vertex, beside the mesh itself."""
        made = bpy.data.node_groups.new("scatter", "GeometryNodeTree")
        for name in ("INPUT", "OUTPUT"):
            if hasattr(made, "interface"):
                made.interface.new_socket("Geometry", in_out=name, socket_type="NodeSocketGeometry")
            else:
                getattr(made, f"{name.lower()}s").new("NodeSocketGeometry", "Geometry")
        begin, at, which, join, end = (made.nodes.new(kind) for kind in (
            "NodeGroupInput", "GeometryNodeInstanceOnPoints", "GeometryNodeObjectInfo", "GeometryNodeJoinGeometry", "NodeGroupOutput"))
        which.inputs["Object"].default_value = shown
        for one, other in ((begin.outputs[0], at.inputs["Points"]), (which.outputs["Geometry"], at.inputs["Instance"]),
                           (begin.outputs[0], join.inputs[0]), (at.outputs[0], join.inputs[0]), (join.outputs[0], end.inputs[0])):
            made.links.new(one, other)
        return made

    def test_geometry_of_nodes_is_part_of_the_mesh(self):
        leaf = fixtures.box("leaf", (0.1, 0.1, 0.1))
        green, _ = fixtures.shaded("green")
        leaf.data.materials.append(green)
        leaf.hide_render = True
        tree = fixtures.box("tree")
        brown, _ = fixtures.shaded("brown")
        tree.data.materials.append(brown)
        tree.modifiers.new("scatter", "NODES").node_group = self.nodes(leaf)
        asset = self.export(build=False)
        record = asset.render_meshes[0]
        self.assertEqual([one.name for one in asset.render_meshes], ["tree"])
        self.assertEqual((len(record.mesh.positions) // 3, len(record.mesh.polygon_sizes)), (8 + 8 * 8, 6 + 8 * 6))
        names = [asset.find("materials", slot.material).name for slot in record.material_slots]
        counts = {name: list(record.polygon_materials).count(index) for index, name in enumerate(names)}
        self.assertEqual(counts, {"brown": 6, "green": 48})
        self.assertEqual(reported(), {})
        self.assertEqual([one.name for one in tree.modifiers], ["scatter"])
        self.assertEqual([one.name for one in bpy.data.node_groups], ["scatter"])

    def test_other_instances_are_reported(self):
        leaf, tree = fixtures.box("leaf"), fixtures.box("tree")
        leaf.parent, tree.instance_type = tree, "VERTS"
        severity, message = reported()["tree"]
        self.assertEqual(severity, "WARNING")
        self.assertIn("8 instances", message)
