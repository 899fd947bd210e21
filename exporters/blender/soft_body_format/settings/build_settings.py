"""Build settings: the options of `sbfmt build` for the button, the preview and the export."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from .attributes import SBFMT_PG_attributes

INTERIORS = (
    ("automatic", "Automatic", "Springs on a lattice in sections cut from a skin, by the centre in sections of your own, tetrahedra "
     "in bodies without a bone, surface springs in sheets"),
    ("centroid", "Springs to the centre", "A centre and a point for each polygon; cheap, for round parts"),
    ("lattice", "Springs on a lattice", "Points on a regular grid; for parts of any shape"),
    ("tetrahedra", "Tetrahedra", "The most accurate material; keeps its shape; the highest cost"),
    ("shape_matching", "Shape matching", "Regions of a lattice that keep their shape: never bursts, does not thin when stretched"),
    ("none", "Surface alone", "Springs over the surface and nothing inside"),
    ("brute", "All to all", "Springs between all points of the surface; to compare with"),
)

SIZES = (
    ("AUTOMATIC", "Automatic", "As many elements as the shape needs"),
    ("CELL", "Cell", "Set the edge of the lattice's cubes"),
    ("ELEMENTS", "Elements", "Set the approximate number of tetrahedra of a body"),
    ("ERROR", "Error", "The coarsest lattice whose error under gravity is at most this"),
)


class SBFMT_PG_build(bpy.types.PropertyGroup):
    """Scene > Soft body format > What a build makes."""

    interior: EnumProperty(name="Inside", items=INTERIORS, default="automatic", description="Interior of the bodies")
    size_by: EnumProperty(name="Size", items=SIZES, default="AUTOMATIC", description="How the resolution of lattices is chosen")
    cell: FloatProperty(name="Cell", default=0.05, min=1e-6, soft_max=1, unit="LENGTH", precision=4,
                        description="Edge of the lattice's cubes")
    elements: IntProperty(name="Elements", default=2000, min=1, soft_max=50000, description="Approximate number of tetrahedra of a body")
    error: FloatProperty(name="Error", default=0.001, min=1e-6, soft_max=0.1, unit="LENGTH", precision=4,
                         description="Largest error of a surface point under gravity")
    flexion: BoolProperty(name="Bending springs", default=True, description="Add springs between second neighbours")
    calibration: BoolProperty(name="Calibrate", default=True,
                              description="Adjust the modulus of coarse bodies so that they deform like fine ones")
    sections: BoolProperty(name="Split by bones", default=True, description="Cut skinned meshes into soft sections, one for each bone")
    overlap: FloatProperty(name="Overlap", default=0, min=0, soft_max=0.2, unit="LENGTH",
                           description="How far a section extends over its cuts; 0: half the limb's radius there")
    levels: IntProperty(name="Levels", default=1, min=1, max=8, description="Simulated levels of a body, each coarser than the last")
    render_levels: IntProperty(name="Render levels", default=0, min=0, max=8,
                               description="Coarser meshes for far away, each with half the triangles")
    use_material: BoolProperty(name="Own material", default=False,
                               description="Material of sections cut from a skin; off: as stiff as they must be to stand")
    attributes: PointerProperty(type=SBFMT_PG_attributes)


def build_arguments(scene, unit_m):
    """What `Asset.build` takes. `unit_m` is the length of a scene unit."""
    build = scene.soft_body_format.build
    size = {"CELL": {"cell": build.cell * unit_m}, "ELEMENTS": {"elements": build.elements},
            "ERROR": {"error": build.error * unit_m}}.get(build.size_by, {})
    return {"interior": build.interior, "flexion": build.flexion, "calibration": build.calibration, "sections": build.sections,
            "overlap": build.overlap * unit_m, "levels": build.levels, "render_levels": build.render_levels, **size}


CLASSES = (SBFMT_PG_build, )
