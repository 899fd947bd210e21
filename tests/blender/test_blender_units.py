"""Compares the effect of Blender's sliders, measured in Blender, with the formulas of to_document/blender_units.py."""

import math

import bpy
import fixtures
from soft_body_format.to_document import blender_units

GRAVITY = 9.81


def square(mass, **settings):
    """A square of a metre-half that hangs by two corners; (object, soft body settings)."""
    made = fixtures.mesh_object("m", [(0, 0, 0), (0, 0, -.5), (.5, 0, -.5), (.5, 0, 0)], [(0, 1, 2, 3)])
    return soften(made, [0, 3], mass=mass, **settings)


def soften(made, held, **settings):
    made.vertex_groups.new(name="held").add(held, 1.0, "REPLACE")
    made.modifiers.new("s", "SOFT_BODY")
    soft = made.soft_body
    soft.friction, soft.bend, soft.damping, soft.goal_friction = 5, 0, 5, 5
    soft.vertex_group_goal, soft.goal_min, soft.goal_max, soft.use_goal = "held", 0, 1, True
    for name, value in settings.items():
        setattr(soft, name, value)
    return made


def woven(made, held, **settings):
    """Cloth that collides with nothing."""
    made.vertex_groups.new(name="held").add(held, 1.0, "REPLACE")
    found = made.modifiers.new("c", "CLOTH")
    found.collision_settings.use_collision, found.settings.quality, found.settings.vertex_group_mass = False, 10, "held"
    for name, value in settings.items():
        setattr(found.settings, name, value)
    return made


def simulate(made, first=1, last=240):
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
            heights = simulate(square(mass, use_edges=True, pull=pull, push=pull))
            wanted = mass * GRAVITY / blender_units.edge_stiffness(pull, 0.5)
            self.assertAlmostEqual(heights[0] - heights[1] - 0.5, wanted, delta=0.02 * wanted)
            fixtures.fresh_scene()

    def line(self, up, count=2, **settings):
        """Vertices one above the other, half a metre in all; the first is pinned."""
        step = 0.5 * up / (count - 1)
        made = fixtures.mesh_object("m", [(0, 0, step * i) for i in range(count)], [], [(i, i + 1) for i in range(count - 1)])
        return soften(made, [0], mass=1, **settings)

    def test_an_edge_is_pressed_by_weight_over_the_stiffness_of_push(self):
        for pull, push in ((0.5, 0.8), (0.8, 0.5)):
            made = self.line(1, pull=pull, push=push)
            heights = simulate(made)
            wanted = GRAVITY / blender_units.edge_stiffness(pull, 0.5) / blender_units.push_ratio(made.soft_body)
            self.assertAlmostEqual(0.5 + heights[0] - heights[1], wanted, delta=0.02 * wanted)
            fixtures.fresh_scene()

    def test_bending_is_a_fraction_of_pull(self):
        """Three vertices in a line: the lower edge and the spring past it carry the lowest."""
        for bend, pull in ((5, 0.5), (2, 0.8)):
            heights = simulate(self.line(-1, 3, pull=pull, push=pull, bend=bend))
            low, middle = 0.25 - heights[2] + heights[1] - 0.5, heights[0] - heights[2] - 0.5
            edge = blender_units.edge_stiffness(pull, 0.25)
            wanted = bend * blender_units.edge_stiffness(pull, 0.5)
            self.assertAlmostEqual(edge * low + wanted * middle, GRAVITY, delta=0.02 * GRAVITY)
            fixtures.fresh_scene()

    def test_stiff_quads_pull_by_the_square_of_shear(self):
        for shear, pull in ((1, 0.5), (0.5, 0.8)):
            made = square(1, use_edges=True, pull=pull, push=pull, shear=shear, use_stiff_quads=True)
            simulate(made)
            at = [vertex.co for vertex in made.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.vertices]
            side, across = at[0] - at[1], at[0] - at[2]
            rest = 0.5 * 2**0.5
            borne = blender_units.edge_stiffness(pull, 0.5) * (side.length - 0.5) * side.z / side.length
            borne += shear**2 * blender_units.edge_stiffness(pull, rest) * (across.length - rest) * across.z / across.length
            self.assertAlmostEqual(borne, GRAVITY, delta=0.02 * GRAVITY)
            fixtures.fresh_scene()

    def test_a_group_weakens_springs_by_its_fourth_power(self):
        made = self.line(-1, pull=0.5, push=0.5)
        made.vertex_groups.new(name="weak").add([0], 0.4, "REPLACE")
        made.vertex_groups["weak"].add([1], 0.6, "REPLACE")
        made.soft_body.vertex_group_spring = "weak"
        heights = simulate(made)
        wanted = GRAVITY / (blender_units.edge_stiffness(0.5, 0.5) * 0.5**4)
        self.assertAlmostEqual(heights[0] - heights[1] - 0.5, wanted, delta=0.02 * wanted)

    def test_damping_of_edges_bounds_how_fast_they_lengthen(self):
        made = self.line(-1, pull=0, push=0, damping=50, friction=0, goal_friction=0, goal_default=1)
        displacement_of_a_frame = simulate(made, last=40)[1] - simulate(made, 41, 41)[1]
        wanted = GRAVITY / blender_units.friction(50)
        self.assertAlmostEqual(displacement_of_a_frame / blender_units.TIME_UNIT_S, wanted, delta=0.02 * wanted)

    def test_goal_friction_damps_points_without_a_goal(self):
        made = self.line(-1, use_edges=False, friction=0, goal_friction=50)
        displacement_of_a_frame = simulate(made, last=40)[1] - simulate(made, 41, 41)[1]
        wanted = GRAVITY / blender_units.friction(50)
        self.assertAlmostEqual(displacement_of_a_frame / blender_units.TIME_UNIT_S, wanted, delta=0.02 * wanted)

    def test_a_goal_of_weight_one_pins(self):
        self.assertEqual(simulate(self.line(-1, use_edges=False, goal_default=1, goal_spring=0.1), last=60)[0], 0)

    def test_a_goal_yields_by_weight_over_stiffness(self):
        for spring, default in ((0.9, 0.7), (0.5, 0.9)):
            made = square(1, use_edges=False, goal_spring=spring, goal_default=default)
            wanted = GRAVITY / blender_units.goal_stiffness(1.0, made.soft_body)
            self.assertAlmostEqual(-simulate(made)[0], wanted, delta=0.01 * wanted)
            fixtures.fresh_scene()

    def test_friction_bounds_the_fall(self):
        made = square(1, use_goal=False, use_edges=False)
        displacement_of_a_frame = simulate(made)[0] - simulate(made, 241, 241)[0]
        speed = displacement_of_a_frame / blender_units.TIME_UNIT_S
        self.assertAlmostEqual(speed, GRAVITY / blender_units.friction(5), delta=0.02 * speed)


    def test_aerodynamics_bound_the_fall(self):
        made = square(1, use_goal=False, use_edges=True, friction=0, damping=0, aero=2000, aerodynamics_type="SIMPLE")
        displacement_of_a_frame = simulate(made)[0] - simulate(made, 241, 241)[0]
        speed = displacement_of_a_frame / blender_units.TIME_UNIT_S
        density = blender_units.air_density(2000, 4, 0.25)
        self.assertAlmostEqual(speed, (2 * 4 * GRAVITY / (density * 0.25))**0.5, delta=0.02 * speed)


    def test_self_collision_balls_have_the_stated_size(self):
        for apart in (0.19, 0.21):
            made = fixtures.mesh_object("m", [(0, 0, 0), (apart, 0, 0), (0, 3, 0), (apart, 3, 0)], [], [(0, 2), (1, 3)])
            made.modifiers.new("s", "SOFT_BODY")
            soft = made.soft_body
            soft.use_goal, soft.use_self_collision, soft.collision_type, soft.ball_size = False, True, "MANUAL", 0.1
            bpy.context.scene.use_gravity = False
            simulate(made, last=20)
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
        self.assertAlmostEqual(simulate(made, last=81)[0] - before, 3 * wanted * seconds**2 / 2, delta=0.02 * abs(3 * wanted * seconds**2 / 2))

    def test_on_soft_bodies(self):
        self.blow(square(2, use_goal=False, use_edges=False, friction=0), blender_units.field_on_soft_body(2, 30))

    def test_on_cloth(self):
        made = fixtures.mesh_object("m", [(0, 0, 0), (.5, 0, 0), (.5, .5, 0), (0, .5, 0)], [(0, 1, 2, 3)])
        found = made.modifiers.new("c", "CLOTH")
        found.settings.mass, found.settings.air_damping, found.settings.quality = 0.5, 0, 10
        found.collision_settings.use_collision = False
        self.blow(made, blender_units.field_on_cloth(0.5 * 4 / 0.25, 30))


    def slow(self, kind, density, wanted, **settings):
        """A cloth of so many kg/m² that falls through a field, until it is as fast as it may be."""
        made = fixtures.mesh_object("m", [(0, 0, 0), (.5, 0, 0), (.5, .5, 0), (0, .5, 0)], [(0, 1, 2, 3)])
        woven(made, [], mass=density * 0.25 / 4, air_damping=0)
        bpy.ops.object.effector_add(type=kind)
        for name, value in {"strength": 0, **settings}.items():
            setattr(bpy.context.object.field, name, value)
        displacement_of_a_frame = simulate(made)[0] - simulate(made, 241, 241)[0]
        self.assertAlmostEqual(displacement_of_a_frame / blender_units.TIME_UNIT_S, wanted, delta=0.02 * wanted)
        fixtures.fresh_scene()

    def test_flow_brakes_cloth(self):
        for density, flow in ((8, 50), (0.8, 2)):
            self.slow("WIND", density, GRAVITY / (flow * blender_units.drag_on_cloth(density)), flow=flow)

    def test_drag_called_quadratic_is_linear_in_speed(self):
        self.slow("DRAG", 0.8, GRAVITY / (2 * blender_units.drag_on_cloth(0.8)), linear_drag=0, quadratic_drag=2)

    def test_drag_called_linear_is_quadratic_in_speed(self):
        """Of which the square is in frames: the force of a field of that strength, times the way of a frame in seconds, squared."""
        for rate in (24, 30):
            bpy.context.scene.render.fps = rate
            square_of_speed = 2 * blender_units.field_on_cloth(0.8, rate) * (rate * blender_units.TIME_UNIT_S)**2
            self.slow("DRAG", 0.8, (GRAVITY / square_of_speed)**0.5, linear_drag=2, quadratic_drag=0)

    def test_flow_pushes_soft_bodies_on(self):
        """Against its own way, as every field: exp(r t) with a rate that brakes cloth."""
        made = square(1, use_goal=False, use_edges=False, friction=0)
        bpy.context.scene.frame_set(1)
        bpy.ops.object.effector_add(type="WIND")
        bpy.context.object.field.strength, bpy.context.object.field.flow = 0, 5
        rate, seconds = 5 * blender_units.drag_on_soft_body(1), 80 * blender_units.TIME_UNIT_S
        wanted = GRAVITY / rate * ((math.exp(rate * seconds) - 1) / rate - seconds)
        self.assertAlmostEqual(-simulate(made, last=81)[0], wanted, delta=0.02 * wanted)


class Cloth(fixtures.SceneTest):
    def test_cloth_is_pressed_by_its_compression(self):
        for tension, compression in ((15, 5), (5, 15)):
            made = fixtures.mesh_object("m", [(0, 0, 0), (0, 0, .5), (.5, 0, .5), (.5, 0, 0)], [(0, 1, 2, 3)])
            woven(made, [0, 3], mass=0.1, tension_stiffness=tension, compression_stiffness=compression, shear_stiffness=0,
                  bending_stiffness=0)
            wanted = 0.1 * GRAVITY / blender_units.cloth_stiffness(compression, 0.5)
            self.assertAlmostEqual(0.5 - simulate(made)[1], wanted, delta=0.02 * wanted)
            fixtures.fresh_scene()

    def test_diagonals_of_cloth_do_not_push(self):
        """Stood on them alone it falls as if there were none."""
        made = fixtures.mesh_object("m", [(0, 0, 0), (0, 0, .5), (.5, 0, .5), (.5, 0, 0)], [(0, 1, 2, 3)])
        woven(made, [0, 3], mass=0.1, tension_stiffness=0, compression_stiffness=0, shear_stiffness=5, bending_stiffness=0,
              tension_damping=0, compression_damping=0, shear_damping=0, air_damping=0)
        seconds = 4 * blender_units.TIME_UNIT_S
        self.assertAlmostEqual(0.5 - simulate(made, last=5)[1], GRAVITY * seconds**2 / 2, delta=0.2 * GRAVITY * seconds**2 / 2)

    def test_damping_of_tension_bounds_how_fast_it_lengthens(self):
        for side in (0.25, 1):
            made = fixtures.mesh_object("m", [(0, 0, 0), (0, 0, -side), (side, 0, -side), (side, 0, 0)], [(0, 1, 2, 3)])
            woven(made, [0, 3], mass=1, tension_stiffness=0, compression_stiffness=0, shear_stiffness=0, bending_stiffness=0,
                  tension_damping=5, shear_damping=0, compression_damping=0, air_damping=0, quality=40)
            displacement_of_a_frame = simulate(made, last=20)[1] - simulate(made, 21, 21)[1]
            wanted = GRAVITY / blender_units.cloth_damping(5)
            self.assertAlmostEqual(displacement_of_a_frame / blender_units.TIME_UNIT_S, wanted, delta=0.03 * wanted)
            fixtures.fresh_scene()

    def test_a_flap_bends_by_its_weight(self):
        """Rectangles and triangles on a pinned one: the torque of the weight equals the torque of the hinge."""
        for long, wide, mass, corners in ((0.5, 0.5, 1, 4), (0.25, 0.5, 1, 4), (0.5, 0.25, 0.5, 4), (0.5, 0.5, 1, 3)):
            rim = [(2 * long, 0, 0), (2 * long, wide, 0)] if corners == 4 else [(2 * long, wide / 2, 0)]
            made = fixtures.mesh_object("m", [(0, 0, 0), (0, wide, 0), (long, 0, 0), (long, wide, 0), *rim],
                                        [(0, 2, 3, 1), (2, 4, 5, 3) if corners == 4 else (2, 4, 3)])
            woven(made, [0, 1, 2, 3], mass=mass, tension_stiffness=2000, compression_stiffness=2000, shear_stiffness=2000,
                  bending_stiffness=5, bending_damping=5, air_damping=3)
            angle = math.asin(-simulate(made, last=250)[4] / long)
            borne = len(rim) * mass * GRAVITY * long * math.cos(angle)
            hinge = blender_units.hinge_torque(5, wide, long / 2 if corners == 4 else long / 3)
            self.assertAlmostEqual(hinge * angle, borne, delta=0.02 * borne)
            fixtures.fresh_scene()

    def test_tension_and_air(self):
        made = fixtures.mesh_object("m", [(0, 0, 0), (0, 0, -.5), (.5, 0, -.5), (.5, 0, 0)], [(0, 1, 2, 3)])
        made.vertex_groups.new(name="held").add([0, 3], 1.0, "REPLACE")
        found = made.modifiers.new("c", "CLOTH")
        cloth = found.settings
        found.collision_settings.use_collision = False
        cloth.mass, cloth.tension_stiffness, cloth.quality, cloth.vertex_group_mass = 0.6, 15, 10, "held"
        cloth.bending_stiffness = cloth.shear_stiffness = 0
        wanted = 0.6 * GRAVITY / blender_units.cloth_stiffness(15, 0.5)
        self.assertAlmostEqual(-simulate(made)[1] - 0.5, wanted, delta=0.02 * wanted)

    def test_shear_makes_a_weave_stiffer_and_thinner(self):
        """A hanging strip, against a sheet of the modulus and ratio with one thread more, since its rims have cells at one side alone."""
        wide, high, cell, mass = 8, 24, 0.1, 0.05
        positions = [(cell * i, 0, -cell * j) for j in range(high + 1) for i in range(wide + 1)]
        faces = [(at, at + 1, at + wide + 2, at + wide + 1) for j in range(high) for at in range(j * (wide + 1), j * (wide + 1) + wide)]
        made = fixtures.mesh_object("m", positions, faces)
        made.vertex_groups.new(name="held").add(list(range(wide + 1)), 1.0, "REPLACE")
        found = made.modifiers.new("c", "CLOTH")
        cloth = found.settings
        found.collision_settings.use_collision = False
        cloth.mass, cloth.tension_stiffness, cloth.shear_stiffness, cloth.quality = mass, 4, 2, 10
        cloth.compression_stiffness, cloth.bending_stiffness, cloth.vertex_group_mass = 4, 0, "held"
        stiffness, _ = blender_units.cloth_layer(4, 2, cell)
        fallen = -cell * high - simulate(made)[-1 - wide // 2]
        borne = (wide + 1) * mass * GRAVITY * high * (high + 1) / 2  # summed over the rows of cells: each carries the rows below it
        self.assertAlmostEqual(fallen, borne / (stiffness * wide + blender_units.cloth_stiffness(4, cell)), delta=0.02 * fallen)
