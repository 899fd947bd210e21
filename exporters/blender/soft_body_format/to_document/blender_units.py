"""Converts settings of Blender's soft body and cloth to SI units.

Both simulations measure time in frames and take a thousandth of the scene's gravity: 0.00981 a frame and a frame. The time unit
at which that is 9.81 m/s² is the square root of 0.001 s², 31.6 ms, whatever the frame rate. In this unit forces are kg m/unit²,
of which one is 1000 N, and rates are 1/unit. tests/blender/test_blender_units.py measures each of these in Blender itself.
"""

import math

TIME_UNIT_S = math.sqrt(0.001)
FORCE_UNIT_N = 1.0 / TIME_UNIT_S**2
FRICTION_SCALE = 0.01  # Blender's factor on friction settings
PINNED_GOAL = 0.999


def stiff(slider):
    """A slider of 0..1 as a strength of 0..infinity: Blender's rule for edges and goals."""
    slider = min(max(slider, 0.0), 0.999)
    return 1.0 / (1.0 - slider) - 1.0


def edge_stiffness(pull, length_m):
    """N/m of a soft body's edge: the force is stiff(pull) times the strain."""
    return FORCE_UNIT_N * stiff(pull) / length_m


def push_ratio(soft):
    """An edge's resistance to compression over its resistance to tension; infinite if it does not resist tension."""
    return stiff(soft.push) / stiff(soft.pull) if stiff(soft.pull) > 0 else math.inf if soft.push > 0 else 1.0


def goal_of(weight, soft):
    """0..1, f = default · weight within the bounds. From PINNED_GOAL on Blender pins the vertex rigidly."""
    return min(abs(weight * soft.goal_default * (soft.goal_max - soft.goal_min)) + soft.goal_min, 1.0)


def goal_stiffness(weight, soft):
    """N/m of a soft body's goal at a vertex of that weight: stiff(f⁴ · goal spring)."""
    return FORCE_UNIT_N * stiff(goal_of(weight, soft)**4 * soft.goal_spring)


def friction(slider):
    """N·s/m of a friction setting of Blender."""
    return FRICTION_SCALE * slider / TIME_UNIT_S


def air_density(aero, edges, area_m2):
    """kg/m³ of the medium with the same drag as a soft body's aerodynamics. Blender's drag on each edge is 0.0001 · aero · (twice its
    speed)², in SI units 0.0004 · aero · v² newtons. The drag of a medium is density/2 · v² · area."""
    return 8e-4 * aero * edges / area_m2


def field_on_soft_body(mass_kg, rate):
    """m/s² that a field of strength 1 gives a vertex at `rate` frames a second: a hundredth of it, opposite to the field."""
    return -FRICTION_SCALE * FORCE_UNIT_N / (rate * mass_kg)


def field_on_cloth(area_density, rate):
    """m/s² that a field of strength 1 gives a cloth of that mass per area in kg/m². The field acts on areas, by a fiftieth of it."""
    return FORCE_UNIT_N / 50 / (rate * area_density)


def drag_on_soft_body(mass_kg):
    """Deceleration rate, 1/s, of a vertex in a drag field of linear strength 1. (In Blender the field accelerates it, because every
    field acts on soft bodies with the opposite sign.)"""
    return FRICTION_SCALE / (TIME_UNIT_S * mass_kg)


def drag_on_cloth(area_density):
    """Deceleration rate, 1/s, of a cloth of that mass per area, kg/m², in a drag field of linear strength 1."""
    return 1 / (50 * TIME_UNIT_S * area_density)


def cloth_damping(slider):
    """N·s/m of a cloth's spring."""
    return slider / TIME_UNIT_S


def hinge_torque(bending, side_m, distance_m):
    """N·m/rad: a polygon's stiffness against rotation about a side, for the distance from the mean of its corners to the side. The
    force is a tenth of the bending stiffness times the side, in equal parts at the corners."""
    return 0.1 * FORCE_UNIT_N * bending * side_m * distance_m


def cloth_layer(tension, shear, edge_m):
    """(modulus times thickness in N/m, Poisson's ratio) of a square weave. Threads of stiffness t along both edges of a cell and s
    along its diagonals give C11 = t + s and C12 = s. The ratio is C12/C11, and the modulus is C11 (1 - ratio²)."""
    t, s = cloth_stiffness(tension, edge_m), cloth_stiffness(shear, edge_m)
    ratio = min(s / max(t + s, 1e-12), 0.499)
    return (t + s) * (1 - ratio**2), ratio


def cloth_stiffness(tension, length_m):
    """N/m of a cloth's spring: the force is the tension times the strain."""
    return FORCE_UNIT_N * tension / length_m
