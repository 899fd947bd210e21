"""Tests complete characters: they export and build without errors, and their fields match the script. They stay equal after an import
and another export, as text and packed."""

import math

import bpy
import characters
import fixtures
from characters import asset_space
from mathutils import Matrix, Quaternion, Vector
from soft_body_format import sbfmt
from soft_body_format.sbfmt.document import from_xml


class Characters(fixtures.RoundTripTest):
    def whole(self, name):
        """The document of a built character that has no errors and comes back equal."""
        characters.ALL[name]()
        path = self.path(f"{name}.sbf")
        self.assertEqual(bpy.ops.export_scene.soft_body_format(filepath=path, textures="EMBED"), {"FINISHED"})
        self.assertEqual(bpy.ops.export_scene.soft_body_format(filepath=f"{path}z", textures="EMBED"), {"FINISHED"})
        gltf = self.path(f"{name}.glb")
        self.assertEqual(bpy.ops.export_scene.soft_body_format(filepath=gltf), {"FINISHED"})
        with sbfmt.load(path) as text, sbfmt.load(f"{path}z") as packed, sbfmt.load(gltf) as shown:
            found = text.validate()
            self.assertEqual([one.message for one in found.findings if one.severity == "error"], [])
            self.assertIsNone(text.equals(packed))
            self.assertIsNone(text.equals(shown))
            document = from_xml(text.to_xml())
        for source, ending in ((path, ".sbf"), (f"{path}z", ".sbfz"), (gltf, ".glb")):
            fixtures.fresh_scene()
            self.comes_back_equal(source, ending)
        return document

    def bones_are(self, asset, bones, offset=(0, 0, 0)):
        """Ids apart, parents, heads, lengths, and both the way along and the roll, against Blender's own of a fresh armature."""
        rig = fixtures.armature("compare", bones)
        by_name = {bone.name: bone for bone in asset.bones}
        self.assertEqual(len({bone.id for bone in asset.bones}), len(asset.bones))
        for name, parent, head, tail, _ in bones:
            found = by_name[name]
            self.assertEqual(found.parent, by_name[parent].id if parent else None)
            self.assert_near(found.head, asset_space(Vector(head) + Vector(offset)), 1e-5)
            self.assertAlmostEqual(found.length, (Vector(tail) - Vector(head)).length, places=5)
            x, y, z, w = found.rotation
            frame = rig.data.bones[name].matrix_local.to_3x3()
            for axis in range(3):
                self.assert_near(Quaternion((w, x, y, z)) @ Matrix.Identity(3)[axis], asset_space(frame.col[axis]), 1e-5)

    def limits(self, joint):
        return [(one.target, round(one.min, 5), round(one.max, 5)) for one in joint.limits]

    def test_biped(self):
        asset = self.whole("biped")
        self.bones_are(asset, characters.BIPED_BONES)
        joints, names = {joint.name: joint for joint in asset.joints if not joint.derived}, {bone.id: bone.name for bone in asset.bones}
        self.assertEqual(set(joints), {f"{name}.{side}" for name in ("thigh", "shin", "hand") for side in "LR"})
        for side in "LR":
            self.assertEqual((joints[f"thigh.{side}"].kind, self.limits(joints[f"thigh.{side}"])),
                             ("spherical", [("swing", 0, characters.BIPED_CONE)]))
            self.assertEqual((joints[f"shin.{side}"].kind, self.limits(joints[f"shin.{side}"])),
                             ("revolute", [("twist", *characters.BIPED_KNEE)]))
            self.assertEqual((joints[f"hand.{side}"].kind, self.limits(joints[f"hand.{side}"])),
                             ("revolute", [("twist", *characters.BIPED_ELBOW)]))
        bodies = {body.name: body for body in asset.rigid_bodies}
        self.assertEqual([bodies[f"thigh.{side}"].mass for side in "LR"], [8, 8])
        skin = asset.find("render_meshes", "mesh.skin")
        self.assertEqual(set(skin.skin.influence_counts), {1, 2})
        self.assertEqual({round(weight, 5) for weight in skin.skin.weights}, {0.375, 0.625, 1})
        self.assertEqual(len(skin.mesh.positions), 3 * 16 * len(characters.BIPED_BONES))
        self.assertEqual([one.name for one in asset.materials], ["skin", "cloth"])
        self.assertEqual([index for index, one in enumerate(skin.polygon_materials) if one], [3])
        self.assert_near((*asset.materials[0].base_color, asset.materials[0].roughness), (0.5, 0.25, 0.125, 1, 0.75))
        gait = asset.gaits[0]
        self.assertEqual([(leg.name, leg.group) for leg in gait.legs], [("foot.L", 0), ("foot.R", 1)])
        self.assert_near(gait.legs[0].home, asset_space((0.12, 0.02, 0.12)))
        self.assertAlmostEqual(gait.legs[0].sole, 0.12 - min(skin.mesh.positions[1::3]), places=5)
        self.assertEqual((names[gait.body], names[gait.chest], names[gait.head.bone]), ("hips", "chest", "head"))
        self.assertEqual((gait.step_height, gait.step_duration, gait.walk_speed), (0.0625, 0.375, 0.75))
        follower = asset.followers[0]
        self.assertEqual((names[follower.bone], follower.frequency, follower.damping_ratio, follower.response), ("head", 3, 0.5, -0.5))
        weight = asset.followers[1]
        self.assertEqual((names[weight.bone], weight.channel, weight.response, weight.strength, weight.limit),
                         ("hips", "weight", 2, 0.25, 0.125))
        self.assertGreater(sum(1 for body in asset.soft_bodies if body.derived), 8)

    def test_quadruped(self):
        asset = self.whole("quadruped")
        self.bones_are(asset, characters.QUADRUPED_BONES)
        names = {bone.id: bone.name for bone in asset.bones}
        self.assertEqual({body.name: names[body.bone] for body in asset.soft_bodies},
                         {f"part of {bone[0]}": bone[0] for bone in characters.QUADRUPED_BONES})
        for body in asset.soft_bodies:
            _, _, head, tail, _ = next(bone for bone in characters.QUADRUPED_BONES if f"part of {bone[0]}" == body.name)
            middle = [sum(body.surface.positions[axis::3]) / 16 for axis in range(3)]
            self.assert_near(middle, asset_space((Vector(head) + Vector(tail)) / 2), 1e-5)
            self.assertEqual(body.attributes.young_modulus, 20000)
            self.assertGreater(len(body.levels), 0)
        gait = asset.gaits[0]
        self.assertEqual([(leg.name, leg.group) for leg in gait.legs], [("hind3.L", 0), ("hind3.R", 1), ("fore3.L", 1), ("fore3.R", 0)])
        chain = asset.find("ik_chains", gait.legs[2].ik)
        self.assertEqual((names[chain.root], names[chain.end], chain.has_pole), ("fore1.L", "fore3.L", True))
        self.assert_near(chain.pole, asset_space((0.15, -2, 0.3)))
        tail = asset.find("chains", gait.tails[0].chain)
        self.assertEqual([asset.bones[number].name for number in tail.bones], ["tail1", "tail2", "tail3"])
        self.assertEqual(gait.tails[0].frequency, 1.5)

    def test_cape(self):
        asset = self.whole("cape")
        cape = next(body for body in asset.soft_bodies if body.name == "cape")
        names = {bone.id: bone.name for bone in asset.bones}
        self.assert_near(cape.surface.positions[:3], asset_space((-0.4, 0.15, 1.5)), 1e-5)
        self.assertEqual([(names[one.bone], list(one.points)) for one in cape.pins if not one.derived], [("neck", list(range(9)))])
        numbers = cape.attributes
        area = 0.8 * 12 * math.hypot(0.1, 0.01)
        self.assertAlmostEqual(numbers.area_density, 0.005 * 117 / area, places=5)
        self.assertAlmostEqual(numbers.poisson_ratio, 0.25, places=6)
        self.assertTrue(cape.collision.self)
        level = cape.levels[0]
        self.assertLessEqual({"structural", "shear"}, {one.kind for one in level.springs})

    def test_blob(self):
        asset = self.whole("blob")
        body = asset.soft_bodies[0]
        level = body.levels[0]
        self.assertFalse(level.derived)
        self.assertEqual({one.kind: len(one.ends) // 2 for one in level.springs if one.kind != "flexion"},
                         {"structural": 12 * 7 + 12 * 8, "shear": 2 * 12 * 6})
        self.assertEqual(len(level.masses), 86)
        self.assertAlmostEqual(body.attributes.mass, 86 * 0.02, places=5)
        goal = next(one for one in body.pins if one.name == "Goal")
        heights = [body.surface.positions[3 * point + 1] for point in goal.points]
        for height, weight in zip(heights, goal.weights):
            final = 0.75 * max(0.0, min(1.0, 0.9 - height))
            self.assertAlmostEqual(goal.stiffness * weight, 1000 * (1 / (1 - final**4 * 0.5) - 1), delta=0.02)

    def test_ragdoll(self):
        asset = self.whole("ragdoll")
        bodies = {body.name: body for body in asset.rigid_bodies}
        self.assertEqual(set(bodies), set(characters.RAGDOLL_PARTS))
        for name, (size, center, mass) in characters.RAGDOLL_PARTS.items():
            body = bodies[name]
            self.assertEqual((body.motion, body.mass, body.friction), ("dynamic", mass, 0.625))
            self.assert_near(body.center, asset_space(center), 1e-5)
            extent = [max(body.hull.positions[axis::3]) - min(body.hull.positions[axis::3]) for axis in range(3)]
            self.assert_near(extent, (size[0], size[2], size[1]), 1e-5)
        joints = {joint.name: joint for joint in asset.joints}
        for name, (kind, above, below, place) in characters.RAGDOLL_JOINTS.items():
            joint = joints[name]
            self.assertEqual((joint.kind, joint.body_a, joint.body_b),
                             ({"POINT": "spherical", "HINGE": "revolute", "GENERIC": "six_dof"}[kind], bodies[above].id, bodies[below].id))
            at = [a + b for a, b in zip(joint.frame_b.position, bodies[below].center)]
            self.assert_near(at, asset_space(place), 1e-5)
            wanted = {"POINT": [], "HINGE": [("twist", *characters.RAGDOLL_BOUNDS)],
                      "GENERIC": [bound for linear, angular in (("linear_x", "twist"), ("linear_y", "swing_y"), ("linear_z", "swing_z"))
                                  for bound in ((linear, 0, 0), (angular, *characters.RAGDOLL_BOUNDS))]}[kind]
            self.assertEqual(self.limits(joint), wanted)

    def test_names_beyond_ascii(self):
        asset, names = self.whole("names"), characters.NAMES
        mesh = asset.render_meshes[0]
        self.assertEqual((asset.bones[0].name, mesh.name, asset.materials[0].name, mesh.uv_sets[0].name, mesh.shape_keys[0].name),
                         tuple(names[key] for key in ("bone", "mesh", "material", "uv", "key")))
        self.assertEqual([one.name for one in asset.soft_bodies[0].pins if not one.derived], [names["group"]])

    def test_two_armatures(self):
        asset = self.whole("two_armatures")
        self.assertEqual([bone.name for bone in asset.bones], ["root", "top", "root", "top"])
        self.assertEqual([bone.parent for bone in asset.bones], [None, asset.bones[0].id, None, asset.bones[2].id])
        held = {body.name: body.bone for body in asset.soft_bodies}
        self.assertEqual(held, {"mount root": asset.bones[0].id, "mount top": asset.bones[1].id, "rider root": asset.bones[2].id,
                                "rider top": asset.bones[3].id})
        self.assert_near(asset.bones[3].head, asset_space((0.25, 0.75, 1)), 1e-6)

    def test_linked_duplicates(self):
        asset = self.whole("duplicates")
        first = asset.find("soft_bodies", "body.one").surface
        places = [Vector((first.positions[i], -first.positions[i + 2], first.positions[i + 1])) for i in range(0, len(first.positions), 3)]
        for name, (place, turn, scale) in characters.DUPLICATES.items():
            surface = asset.find("soft_bodies", f"body.{name}").surface
            self.assertEqual(surface.polygon_points, first.polygon_points)
            turned = [Matrix.Rotation(turn, 3, "Z") @ one * scale + Vector(place) for one in places]
            self.assert_near(surface.positions, [number for one in turned for number in asset_space(one)], 1e-5)

    def test_mirrored_objects(self):
        asset = self.whole("mirrored")
        for name, low, high, volume in (("half", -1, 1, 2), ("mirrored", 2.25, 3.25, 2), ("turned", 4.25, 5.25, 2)):
            mesh = asset.find("render_meshes", f"mesh.{name}").mesh
            self.assert_near((min(mesh.positions[::3]), max(mesh.positions[::3])), (low, high), 1e-6)
            self.assertAlmostEqual(characters.closed_volume(mesh.positions, mesh.polygon_sizes, mesh.polygon_points), volume, places=5)
