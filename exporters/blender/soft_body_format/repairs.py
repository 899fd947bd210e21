"""Repairs faults that have one right answer: in the scene if the fault is there, else in every file that is written."""

from dataclasses import dataclass

import bmesh
import bpy
from mathutils import Matrix


@dataclass
class Repair:
    """A button's label, and its function of the object and bone that a finding names. None: the fault is repaired in files."""

    label: str
    act: object = None


def edit(source, change):
    """Changes a mesh in any mode. A mesh that several objects share changes for all of them."""
    if source.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    made = bmesh.new()
    made.from_mesh(source.data)
    change(made)
    made.to_mesh(source.data)
    made.free()
    source.data.update()


def face_outwards(source, _bone_name):
    edit(source, lambda made: bmesh.ops.recalc_face_normals(made, faces=made.faces))


def remove_loose(source, _bone_name):
    edit(source, lambda made: bmesh.ops.delete(made, geom=[one for one in made.verts if not one.link_faces], context="VERTS"))


def apply_scale(source, _bone_name):
    """Applies the object's world scale, including its parents' mirroring, to the mesh. A shared mesh is copied first. Children keep
    their world position."""
    if source.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    below = [(one, one.matrix_world.copy()) for one in source.children]
    if source.data.users > 1:
        source.data = source.data.copy()
    position, rotation, _ = source.matrix_world.decompose()
    unscaled = Matrix.Translation(position) @ rotation.to_matrix().to_4x4()
    scale = unscaled.inverted() @ source.matrix_world
    source.data.transform(scale, shape_keys=True)
    if scale.determinant() < 0:
        source.data.flip_normals()
    source.matrix_world = unscaled
    bpy.context.view_layer.update()
    for one, world in below:
        one.matrix_world = world


def exchange_limits(source, bone_name):
    """Exchanges reversed limits of the bone's panel and of its constraints."""
    joint = source.data.bones[bone_name].soft_body_format.joint
    owners = [(joint, f"{name}_min", f"{name}_max") for name in ("twist", "swing_y", "swing_z", "slide")]
    for one in source.pose.bones[bone_name].constraints:
        if one.type == "LIMIT_ROTATION":
            owners += [(one, f"min_{axis}", f"max_{axis}") for axis in "xyz"]
    for owner, low, high in owners:
        if getattr(owner, low) > getattr(owner, high):
            minimum, maximum = getattr(owner, high), getattr(owner, low)
            setattr(owner, low, minimum)
            setattr(owner, high, maximum)


def stand_on_ground(source, _bone_name):
    """Sets the ground height to the lowest foot of the gait."""
    from .findings import Findings
    from .to_document import Options
    from .whole import write_whole
    settings = bpy.context.scene.soft_body_format
    whole = write_whole(bpy.context, Options(textures="EMBED"), Findings())
    for gait in whole.document.gaits:
        settings.ground += min(leg.home[1] - leg.sole for leg in gait.legs) / whole.writer.space.unit_m


IN_SCENE = {
    "SURFACE_WINDING": Repair("Turn faces outwards", face_outwards),
    "SURFACE_INSIDE_OUT": Repair("Turn faces outwards", face_outwards),
    "POINT_UNUSED": Repair("Delete loose vertices", remove_loose),
    "MESH_POINT_UNUSED": Repair("Delete loose vertices", remove_loose),
    "LIMIT_ORDER": Repair("Exchange the limits", exchange_limits),
    "GAIT_GROUND": Repair("Stand on the ground", stand_on_ground),
    "MESH_MIRRORED": Repair("Apply the scale", apply_scale),
}
# Codes that only `sbfmt validate --fix` repairs. Their faults come from an imported file or from a combination of panel settings.
IN_FILES = ("TETRAHEDRON_INVERTED", "TETRAHEDRON_DUPLICATE", "SPRING_DUPLICATE", "SPRING_SAME_POINT", "SPRING_INERT", "PIN_REPEATED",
            "SKIN_SUM", "EMBEDDING_SUM", "EMBEDDING_BLEND", "VALUE_OUT_OF_RANGE", "ROTATION_NOT_UNIT", "JOINT_FRAME", "NORMAL_NOT_UNIT")


def repair_of(finding, repairs_files):
    """The Repair of a finding, or None. `repairs_files`: files are repaired already."""
    if finding.code in IN_SCENE and finding.object_name:
        return IN_SCENE[finding.code]
    if finding.code in IN_FILES and not repairs_files:
        return Repair("Repair it in the file")
    return None
