"""Draws the material settings in the panels of objects, of all sections and of one bone's section."""


def draw_matter(layout, numbers):
    layout.use_property_split = True
    layout.prop(numbers, "preset")
    layout.prop(numbers, "layer")
    column = layout.column(align=True)
    for name in ("area_density", "thickness", "bending_stiffness") if numbers.layer else ("density", "mass"):
        column.prop(numbers, name)
    for name in ("young_modulus", "poisson_ratio", "damping_ratio", "friction", "restitution"):
        column.prop(numbers, name)
    column = layout.column(align=True)
    column.prop(numbers, "media_friction")
    column.prop(numbers, "gravity_scale")
    column.prop(numbers, "sag_free")
