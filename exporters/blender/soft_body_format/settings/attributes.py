"""Physical attributes with their units, and presets that fill them."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty

from ..sbfmt.document.material_presets import MATERIALS

CUSTOM = "CUSTOM"
# The schema's defaults, for bodies without a modulus.
LAYER_FIELDS = ("area_density", "thickness", "bending_stiffness")


def preset_items():
    yield (CUSTOM, "Custom", "Numbers of your own")
    for name, numbers in MATERIALS.items():
        kind = "cloth" if "area_density" in numbers else "solid"
        yield (name, name.capitalize(), f"{kind}, {numbers['young_modulus']:g} Pa, {numbers['density']:g} kg/m³")


def apply_preset(self, _context):
    if self.preset == CUSTOM:
        return
    numbers = MATERIALS[self.preset]
    for name, value in numbers.items():
        setattr(self, name, value)
    self.layer = "area_density" in numbers


class SBFMT_PG_attributes(bpy.types.PropertyGroup):
    """Attributes of one body, with the names and meanings of `attributes` in spec/sbf.md."""

    preset: EnumProperty(name="Material", items=list(preset_items()), default=CUSTOM, update=apply_preset,
                         description="Fills in the numbers below, which can be changed afterwards")
    layer: BoolProperty(name="Layer", default=False,
                        description="A sheet or bag of cloth, with mass per area and thickness, even where it is closed")
    density: FloatProperty(name="Density (kg/m³)", default=1000, min=1e-3, soft_max=10000,
                           description="Of the matter inside")
    mass: FloatProperty(name="Mass (kg)", default=0, min=0, soft_max=1000, description="Mass of the whole body; 0: from the density")
    area_density: FloatProperty(name="Mass per area (kg/m²)", default=0.15, min=1e-6, soft_max=10, precision=4,
                                description="Of a layer")
    thickness: FloatProperty(name="Thickness (m)", default=0.001, min=1e-6, soft_max=0.1, precision=5,
                             description="Of a layer")
    bending_stiffness: FloatProperty(name="Bending (N·m)", default=0, min=0, soft_max=1, precision=7,
                                     description="Flexural rigidity of a layer; 0: from modulus and thickness")
    young_modulus: FloatProperty(name="Young's modulus (Pa)", default=80000, min=1, soft_max=1e8, step=100000, precision=0,
                                 description="Stiffness: jelly 3,000, flesh 20,000, rubber 1,200,000")
    poisson_ratio: FloatProperty(name="Poisson's ratio", default=0.4, min=-0.99, max=0.499, soft_min=0, precision=3,
                                 description="Sideways contraction when stretched; bodies of springs always behave like 0.25")
    damping_ratio: FloatProperty(name="Damping ratio", default=0.2, min=0, soft_max=1,
                                 description="Damping of the body's lowest mode: 0 oscillates forever, 1 does not oscillate")
    friction: FloatProperty(name="Friction", default=0.6, min=0, soft_max=2, description="Coulomb coefficient")
    restitution: FloatProperty(name="Restitution", default=0, min=0, max=1, description="Fraction of the speed kept in a bounce")
    media_friction: FloatProperty(name="Media friction (1/s)", default=0, min=0, soft_max=10,
                                  description="Rate of slowing down relative to the air")
    gravity_scale: FloatProperty(name="Gravity", default=1, soft_min=-1, soft_max=2, description="Factor on gravity")
    pressure_mode: EnumProperty(name="Pressure", default="none", items=(
        ("none", "None", "Nothing inside"), ("gas", "Gas", "Pressure times volume stays the same"),
        ("volume", "Keep volume", "The volume stays the same")))
    pressure: FloatProperty(name="Pressure (Pa)", default=0, soft_min=0, soft_max=10000,
                            description="Excess pressure of the gas inside, at rest")
    yields: BoolProperty(name="Yields", default=False, description="Keeps a dent")
    yield_strain: FloatProperty(name="Yield strain", default=0.2, min=1e-4, soft_max=1, description="Strain above which the shape flows")
    yield_flow: FloatProperty(name="Flow (1/s)", default=5, min=0, soft_max=100, description="Rate of that flow")
    tears: BoolProperty(name="Tears", default=False, description="Tears where it is stretched too far")
    tear_strain: FloatProperty(name="Tear strain", default=1, min=1e-4, soft_max=5, description="Strain above which it tears")
    sag_free: BoolProperty(name="Bears its own weight", default=False,
                           description="Rests in the modelled shape instead of sagging below it")


FIELDS = ("density", "mass", "young_modulus", "poisson_ratio", "damping_ratio", "friction", "restitution", "media_friction",
          "gravity_scale", "pressure_mode", "sag_free")


def fill_attributes(record, settings):
    """Copies the panel's numbers to a document's `attributes`."""
    for name in FIELDS:
        setattr(record, name, getattr(settings, name))
    if settings.layer:
        for name in LAYER_FIELDS:
            setattr(record, name, getattr(settings, name))
    if settings.pressure_mode != "none":
        record.pressure = settings.pressure
    if settings.yields:
        record.yield_strain, record.yield_flow = settings.yield_strain, settings.yield_flow
    if settings.tears:
        record.tear_strain = settings.tear_strain


def read_attributes(settings, record):
    """Copies a document's `attributes` to the panel's numbers, for an import."""
    for name in FIELDS:
        setattr(settings, name, getattr(record, name))
    settings.layer = record.area_density > 0
    if settings.layer:
        for name in LAYER_FIELDS:
            setattr(settings, name, getattr(record, name))
    settings.pressure = record.pressure
    settings.yields, settings.tears = record.yield_strain > 0, record.tear_strain > 0
    if settings.yields:
        settings.yield_strain, settings.yield_flow = record.yield_strain, record.yield_flow
    if settings.tears:
        settings.tear_strain = record.tear_strain


CLASSES = (SBFMT_PG_attributes, )
