"""What Blender's sliders mean: measured in Blender itself, against the formulas of to_document/blender_units.py."""

import bpy
import fixtures
from soft_body_format.to_document import blender_units

GRAVITY = 9.81


def square(mass, **settings):
    """A square of a metre-half that hangs by two corners; (object, soft body settings)."""
    made = fixtures.mesh_object("m", [(0, 0, 0), (0, 0, -.5), (.5, 0, -.5), (.5, 0, 0)], [(0, 1, 2, 3)])
    made.vertex_groups.new(name="held").add([0, 3], 1.0, "REPLACE")
    made.modifiers.new("s", "SOFT_BODY")
    soft = made.soft_body
    soft.mass, soft.friction, soft.bend, soft.damping, soft.goal_friction = mass, 5, 0, 5, 5
    soft.vertex_group_goal, soft.goal_min, soft.goal_max, soft.use_goal = "held", 0, 1, True
    for name, value in settings.items():
        setattr(soft, name, value)
    return made


def settle(made, first=1, last=240):
    """Heights of the vertices at the last frame."""
    scene = bpy.context.scene
    for frame in range(first, last + 1):
        scene.frame_set(frame)
        bpy.context.view_layer.update()
    mesh = made.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return [vertex.co.z for vertex in mesh.vertices]


class SoftBody(fixtures.SceneTest):
    def test_an_edge_stretches_by_weight_over_stiffness(self):
        for mass, pull in ((1, 0.5), (2, 0.8)):
            heights = settle(square(mass, use_edges=True, pull=pull, push=pull))
            wanted = mass * GRAVITY / blender_units.edge_stiffness(pull, 0.5)
            self.assertAlmostEqual(heights[0] - heights[1] - 0.5, wanted, delta=0.02 * wanted)
            fixtures.fresh_scene()

    def test_a_goal_gives_by_weight_over_stiffness(self):
        for spring, default in ((0.9, 0.7), (0.5, 0.9)):
            made = square(1, use_edges=False, goal_spring=spring, goal_default=default)
            wanted = GRAVITY / blender_units.goal_stiffness(1.0, made.soft_body)
            self.assertAlmostEqual(-settle(made)[0], wanted, delta=0.01 * wanted)
            fixtures.fresh_scene()

    def test_friction_bounds_the_fall(self):
        made = square(1, use_goal=False, use_edges=False)
        way_of_a_frame = settle(made)[0] - settle(made, 241, 241)[0]
        speed = way_of_a_frame / blender_units.TIME_UNIT_S
        self.assertAlmostEqual(speed, GRAVITY / blender_units.friction(5), delta=0.02 * speed)


    def test_aerodynamics_bound_the_fall(self):
        made = square(1, use_goal=False, use_edges=True, friction=0, damping=0, aero=2000, aerodynamics_type="SIMPLE")
        way_of_a_frame = settle(made)[0] - settle(made, 241, 241)[0]
        speed = way_of_a_frame / blender_units.TIME_UNIT_S
        density = blender_units.air_density(2000, 4, 0.25)
        self.assertAlmostEqual(speed, (2 * 4 * GRAVITY / (density * 0.25))**0.5, delta=0.02 * speed)


    def test_balls_of_self_collision_are_as_large_as_they_say(self):
        for apart in (0.19, 0.21):
            made = fixtures.mesh_object("m", [(0, 0, 0), (apart, 0, 0), (0, 3, 0), (apart, 3, 0)], [], [(0, 2), (1, 3)])
            made.modifiers.new("s", "SOFT_BODY")
            soft = made.soft_body
            soft.use_goal, soft.use_self_collision, soft.collision_type, soft.ball_size = False, True, "MANUAL", 0.1
            bpy.context.scene.use_gravity = False
            settle(made, last=20)
            mesh = made.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
            self.assertEqual((mesh.vertices[1].co - mesh.vertices[0].co).length > apart + 1e-4, apart < 0.2)
            fixtures.fresh_scene()


class Fields(fixtures.SceneTest):
    """How far a wind of strength 3 blows in 80 frames, against acceleration t²/2."""

    def blow(self, made, wanted):
        scene = bpy.context.scene
        scene.use_gravity, scene.render.fps = False, 30
        bpy.ops.object.effector_add(type="WIND")
        bpy.context.object.field.strength, bpy.context.object.field.flow = 3, 0
        before = made.data.vertices[0].co.z
        seconds = 80 * blender_units.TIME_UNIT_S
        self.assertAlmostEqual(settle(made, last=81)[0] - before, 3 * wanted * seconds**2 / 2, delta=0.02 * abs(3 * wanted * seconds**2 / 2))

    def test_on_soft_bodies(self):
        self.blow(square(2, use_goal=False, use_edges=False, friction=0), blender_units.field_on_soft_body(2, 30))

    def test_on_cloth(self):
        made = fixtures.mesh_object("m", [(0, 0, 0), (.5, 0, 0), (.5, .5, 0), (0, .5, 0)], [(0, 1, 2, 3)])
        found = made.modifiers.new("c", "CLOTH")
        found.settings.mass, found.settings.air_damping, found.settings.quality = 0.5, 0, 10
        found.collision_settings.use_collision = False
        self.blow(made, blender_units.field_on_cloth(0.5 * 4 / 0.25, 30))


class Cloth(fixtures.SceneTest):
    def test_tension_and_air(self):
        made = fixtures.mesh_object("m", [(0, 0, 0), (0, 0, -.5), (.5, 0, -.5), (.5, 0, 0)], [(0, 1, 2, 3)])
        made.vertex_groups.new(name="held").add([0, 3], 1.0, "REPLACE")
        found = made.modifiers.new("c", "CLOTH")
        cloth = found.settings
        found.collision_settings.use_collision = False
        cloth.mass, cloth.tension_stiffness, cloth.quality, cloth.vertex_group_mass = 0.6, 15, 10, "held"
        cloth.bending_stiffness = cloth.shear_stiffness = 0
        wanted = 0.6 * GRAVITY / blender_units.cloth_stiffness(15, 0.5)
        self.assertAlmostEqual(-settle(made)[1] - 0.5, wanted, delta=0.02 * wanted)

    def test_shear_makes_a_weave_stiffer_and_thinner(self):
        """A hanging strip, against a sheet of the modulus and ratio with one thread more, since its rims have cells at one side alone."""
        wide, high, cell, mass = 8, 24, 0.1, 0.05
        places = [(cell * i, 0, -cell * j) for j in range(high + 1) for i in range(wide + 1)]
        faces = [(at, at + 1, at + wide + 2, at + wide + 1) for j in range(high) for at in range(j * (wide + 1), j * (wide + 1) + wide)]
        made = fixtures.mesh_object("m", places, faces)
        made.vertex_groups.new(name="held").add(list(range(wide + 1)), 1.0, "REPLACE")
        found = made.modifiers.new("c", "CLOTH")
        cloth = found.settings
        found.collision_settings.use_collision = False
        cloth.mass, cloth.tension_stiffness, cloth.shear_stiffness, cloth.quality = mass, 4, 2, 10
        cloth.compression_stiffness, cloth.bending_stiffness, cloth.vertex_group_mass = 4, 0, "held"
        stiffness, _ = blender_units.cloth_layer(4, 2, cell)
        fallen = -cell * high - settle(made)[-1 - wide // 2]
        borne = (wide + 1) * mass * GRAVITY * high * (high + 1) / 2  # summed over the rows of cells, each bears what is below it
        self.assertAlmostEqual(fallen, borne / (stiffness * wide + blender_units.cloth_stiffness(4, cell)), delta=0.02 * fallen)
