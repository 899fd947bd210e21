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
