"""Tests scenes in other units than metres, unevenly scaled objects, and points with weights of several bones."""

import math

import bpy
import fixtures
from mathutils import Vector

FORCE = 1000  # N of a unit of Blender's cloth and soft bodies


class OtherUnits(fixtures.SceneTest):
    """A scene of centimetres, as long as the same one in metres."""

    def units(self, system, length):
        self.scene.unit_settings.system = system
        self.scene.unit_settings.scale_length = length

    def extent(self, positions):
        return [max(positions[k::3]) - min(positions[k::3]) for k in range(3)]

    def test_lengths_are_in_metres_for_any_unit(self):
        for system, length, size in (("METRIC", 0.01, 100), ("METRIC", 1, 1), ("IMPERIAL", 0.3048, 1 / 0.3048), ("NONE", 0.01, 1)):
            with self.subTest(system=system, length=length):
                self.scene = fixtures.fresh_scene()
                self.units(system, length)
                made = fixtures.box("b", (size, 2 * size, 3 * size), (size, 0, 0))
                made.modifiers.new("s", "SOFT_BODY")
                asset = self.export(build=False)
                self.assert_near(self.extent(asset.soft_bodies[0].surface.positions), (1, 3, 2), 1e-5)
                self.assertAlmostEqual(max(asset.soft_bodies[0].surface.positions[0::3]), 1.5, places=5)

    def cloth(self, made, **settings):
        found = made.modifiers.new("c", "CLOTH")
        for name, value in settings.items():
            setattr(found.settings, name, value)
        return found

    def cape(self, length, **settings):
        """A sheet of a metre, of four cells a side; distances are two hundredths of it."""
        self.scene = fixtures.fresh_scene()
        self.units("METRIC", length)
        found = self.cloth(fixtures.sheet("cape", 4, 1 / length), mass=0.01, **settings)
        found.collision_settings.use_self_collision = True
        found.collision_settings.self_distance_min, found.collision_settings.distance_min = 0.02 / length, 0.03 / length
        return self.export(build=False).soft_bodies[0]

    def test_cloth_is_as_heavy_and_thick(self):
        for length in (1, 0.5):
            body = self.cape(length, tension_stiffness=20, compression_stiffness=20, shear_stiffness=5)
            self.assertAlmostEqual(body.attributes.area_density, 0.01 * 25, places=4)
            self.assert_near((body.collision.particle_radius, body.collision.outer_thickness), (0.02, 0.03), 1e-6)
            self.assertAlmostEqual(body.attributes.young_modulus * body.attributes.thickness, 25 * FORCE / 0.25 * (1 - 0.04), delta=1)

    def test_springs_of_cloth(self):
        """Stiffness goes by edges in metres; the ratio of pressing has no unit."""
        for length in (1, 0.01):
            body = self.cape(length, tension_stiffness=20, compression_stiffness=5, shear_stiffness=10, tension_damping=3)
            edges, diagonals = body.levels[0].springs
            self.assert_near(set(edges.stiffness), {20 * FORCE / 0.25}, 0.5)
            self.assert_near(set(diagonals.stiffness), {10 * FORCE / 0.25}, 0.5)
            self.assert_near((*edges.compression_ratio, *diagonals.compression_ratio), (0.25, 0))
            self.assertAlmostEqual(edges.damping[0], 3 / math.sqrt(0.001), places=3)
            self.assert_near(self.extent(body.levels[0].positions), (1, 0, 1), 1e-5)

    def test_inner_springs_of_cloth_are_as_long(self):
        """The pillow is half a metre thick and 1.5 m from corner to corner: springs of 1.6 m go through it, of 0.4 m do not."""
        for length in (1, 0.1):
            for longest, kinds in ((1.6, ["structural", "shear", "internal"]), (0.4, ["structural", "shear"])):
                self.scene = fixtures.fresh_scene()
                self.units("METRIC", length)
                made = fixtures.box("pillow", (1 / length, 1 / length, 0.5 / length))
                self.cloth(made, use_internal_springs=True, internal_tension_stiffness=12, tension_stiffness=20, shear_stiffness=5,
                           internal_spring_max_length=longest / length)
                found = [one.kind for one in self.export(build=False).soft_bodies[0].levels[0].springs]
                self.assertEqual(found, kinds, (length, longest))

    def test_limits_of_a_slide(self):
        self.units("METRIC", 0.01)
        parts = []
        for name, x in (("a", 0), ("b", 200)):
            made = fixtures.box(name, (100, 100, 100), (x, 0, 0))
            bpy.context.view_layer.objects.active = made
            bpy.ops.rigidbody.object_add()
            parts.append(made)
        joint = fixtures.link(bpy.data.objects.new("slide", None))
        joint.location = (100, 0, 0)
        bpy.context.view_layer.objects.active = joint
        bpy.ops.rigidbody.constraint_add(type="SLIDER")
        settings = joint.rigid_body_constraint
        settings.object1, settings.object2 = parts
        settings.use_limit_lin_x, settings.limit_lin_x_lower, settings.limit_lin_x_upper = True, -20, 30
        asset = self.export(build=False)
        limit, = asset.joints[0].limits
        self.assertEqual(limit.target, "linear_x")
        self.assert_near((limit.min, limit.max), (-0.2, 0.3), 1e-6)
        ends = [[a + b for a, b in zip(frame.position, body.center)] for frame, body in
                zip((asset.joints[0].frame_a, asset.joints[0].frame_b), asset.rigid_bodies)]
        self.assert_near((*ends[0], *ends[1]), (1, 0, 0, 1, 0, 0), 1e-5)


class UnevenScale(fixtures.SceneTest):
    def test_custom_normals_stay_perpendicular(self):
        """Of a plane through the normal's tangents: M maps these, and the normal by its inverse transpose."""
        made = fixtures.mesh_object("m", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)])
        wanted = [Vector(v).normalized() for v in ((1, 0, 2), (0, 1, 2), (-1, 1, 1), (0, -2, 1))]
        if hasattr(made.data, "use_auto_smooth"):
            made.data.use_auto_smooth = True
        made.data.normals_split_custom_set_from_vertices(wanted)
        made.scale, made.rotation_euler = (1, 3, 0.5), (0.3, -0.2, 0.7)
        bpy.context.view_layer.update()
        matrix = made.matrix_world.to_3x3()
        record = self.export(build=False).render_meshes[0]
        corners = list(record.normal_corners) or list(record.mesh.polygon_points)
        for point, corner in zip(record.mesh.polygon_points, corners):
            x, y, z = record.normals[3 * corner:3 * corner + 3]
            found = Vector((x, -z, y))  # back from +Y up
            self.assertAlmostEqual(found.length, 1, places=4)
            for across in (wanted[point].orthogonal(), wanted[point].cross(wanted[point].orthogonal())):
                self.assertAlmostEqual(found.dot((matrix @ across).normalized()), 0, delta=3e-3)
            self.assertGreater(found.dot(matrix.inverted().transposed() @ wanted[point]), 0)


class SeveralBones(fixtures.SceneTest):
    def held(self, kind):
        """A strip of four points, two of them held more by the one bone and two by the other."""
        made = fixtures.mesh_object("strip", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)])
        rig = fixtures.armature("Rig", [("left", None, (0, 0, 0), (0, 0, 1), 0), ("right", None, (1, 0, 0), (1, 0, 1), 0)])
        fixtures.bind(made, rig, {"left": {0: 0.9, 1: 0.3, 2: 0.4, 3: 0.6}, "right": {0: 0.1, 1: 0.7, 2: 0.6, 3: 0.4}})
        made.vertex_groups.new(name="goal").add([0, 1, 2], 1.0, "REPLACE")
        if kind == "SOFT_BODY":
            made.modifiers.new("s", "SOFT_BODY")
            soft = made.soft_body
            soft.vertex_group_goal, soft.goal_default, soft.goal_min, soft.use_goal, soft.goal_friction = "goal", 1.0, 0, True, 0
        else:
            made.modifiers.new("c", "CLOTH").settings.vertex_group_mass = "goal"
        asset = self.export(build=False)
        names = {bone.id: bone.name for bone in asset.bones}
        return {names.get(pins.bone): sorted(pins.points) for pins in asset.soft_bodies[0].pins}

    def test_each_point_follows_its_strongest_bone(self):
        for kind in ("SOFT_BODY", "CLOTH"):
            self.scene = fixtures.fresh_scene()
            self.assertEqual(self.held(kind), {"left": [0], "right": [1, 2]}, kind)


class Placement(fixtures.SceneTest):
    def test_the_ground_is_at_height_zero(self):
        self.scene.soft_body_format.ground = 0.25
        fixtures.box("b", (1, 1, 1), (0, 0, 0.75)).modifiers.new("s", "SOFT_BODY")
        self.assertAlmostEqual(min(self.export(build=False).soft_bodies[0].surface.positions[1::3]), 0, places=6)

    def test_mirrored_objects_keep_uvs_at_their_vertices(self):
        for mirror in (1, -1):
            self.scene = fixtures.fresh_scene()
            made = fixtures.mesh_object("m", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)])
            layer = made.data.uv_layers.new(name="uv")
            for loop in made.data.loops:
                layer.data[loop.index].uv = made.data.vertices[loop.vertex_index].co[:2]
            made.scale = (mirror, 1, 1)
            bpy.context.view_layer.update()
            record = self.export(build=False).render_meshes[0]
            uv = record.uv_sets[0]
            for point, corner in zip(record.mesh.polygon_points, uv.corners):
                x, _, z = record.mesh.positions[3 * point:3 * point + 3]
                self.assert_near(uv.coordinates[2 * corner:2 * corner + 2], (mirror * x, -z))
