"""Checks objects before anything is written: scale, type, geometry, libraries, weights."""

import os

import bpy
import numpy

from .armatures import parent_in_file
from .chosen import is_instance
from .roles import IGNORE, SURFACES

NO_SURFACES = {"CURVES": "hair", "POINTCLOUD": "point cloud", "VOLUME": "volume", "GPENCIL": "drawing", "GREASEPENCIL": "drawing"}
MIN_VOLUME = 1e-18  # of a cube of side one, in metres


def find_sound_objects(writer):
    """Reports faults and returns the objects that can be written."""
    report_missing_libraries(writer)
    return [one for one in writer.objects if sound(writer, one)]


def sound(writer, source):
    findings, world = writer.findings, source.matrix_world
    if source.type in SURFACES and not writer.options.apply_modifiers:
        findings.warning(f"is a {SURFACES[source.type]} and is left out: turn on Apply Modifiers, or make a mesh of it (Object > Convert > "
                         "Mesh)", object_name=source.name)
    elif source.type in NO_SURFACES:
        findings.warning(f"is a {NO_SURFACES[source.type]}, of which no mesh can be made: it is left out", object_name=source.name)
    if source.type not in ("MESH", "ARMATURE", *SURFACES) or writer.roles.get(source.name) == IGNORE:
        return True
    volume = world.to_3x3().determinant()
    if abs(volume) < MIN_VOLUME or volume != volume:
        findings.error("its scale is zero along an axis, which leaves nothing of it: set it to 1 in Object > Transform",
                       object_name=source.name)
        return False
    if source.type == "ARMATURE":
        return sound_armature(findings, source, volume)
    if volume < 0:
        findings.warning("its scale is negative, so it is mirrored: its polygons are turned round to face outwards. Apply the scale "
                         "(Ctrl+A > Scale) and recalculate the normals (Shift+N) to see what is written", object_name=source.name,
                         code="MESH_MIRRORED")
    return True


def without_faces(writer, source):
    """Reports why the object is not exported."""
    if source.type == "META":
        writer.findings.info("is a metaball that belongs to another one's family, and is exported with that one", object_name=source.name)
    elif source.type in SURFACES and source != writer.scene.soft_body_format.preview.curve:
        writer.findings.info(f"is a {SURFACES[source.type]} without a surface, so it is not visible; it is left out. Geometry > Bevel "
                             "gives it one", object_name=source.name)
    elif source.type == "MESH":
        writer.findings.warning("has no faces, so it is neither visible nor simulated; it is left out", object_name=source.name)


def instances_left_out(writer):
    """Reports objects that instance others on particles, vertices or faces."""
    counts, names = {}, {one.name for one in writer.objects if writer.roles.get(one.name) != IGNORE}
    for one in writer.depsgraph.object_instances:
        parent = one.parent.original if one.is_instance and one.parent is not None else None
        if parent is not None and parent.name in names and not is_instance(parent) and one.object.original != parent:
            counts[parent.name] = counts.get(parent.name, 0) + 1
    for name, count in counts.items():
        writer.findings.warning(f"shows {count} instances of other objects, which are left out: make them real (Object > Apply > Make "
                                "Instances Real)", object_name=name)


def sound_armature(findings, source, volume):
    if volume < 0:
        findings.error("its scale is negative, and bones can't be mirrored: apply the scale (Ctrl+A > Scale)",
                       object_name=source.name)
        return False
    for bone in source.data.bones:
        wanted = bone.soft_body_format.hangs_on
        if wanted and (parent_in_file(bone) is None or parent_in_file(bone).name != wanted):
            findings.warning(f"has {wanted!r} under Hangs on, which does not exist or is its descendant: it keeps its parent. Choose another in "
                             "Bone > Soft body format", object_name=source.name, bone_name=bone.name)
    scale = source.matrix_world.to_scale()
    if max(scale) > 1.001 * min(scale):
        findings.warning("its scale differs by axis, which bones can't show: their lengths take the middle one. Apply the scale "
                         "(Ctrl+A > Scale)", object_name=source.name)
    return True


def report_missing_libraries(writer):
    """Reports missing libraries. Objects linked from them are empty."""
    missing = {one for one in bpy.data.libraries if not one.packed_file and
            not os.path.isfile(bpy.path.abspath(one.filepath, library=one.parent))}
    for source in writer.objects:
        found = {one.library for one in (source, source.data, source.instance_collection) if one is not None} & missing
        for library in found:
            writer.findings.error(f"is linked from {library.filepath}, which is not there: find it with File > External Data > Find "
                                  "Missing Files, or remove the object", object_name=source.name)


def finite(findings, source, positions):
    """Whether all vertices have finite coordinates."""
    lost = numpy.flatnonzero(~numpy.isfinite(positions).all(axis=1))
    if len(lost):
        findings.error(f"{len(lost)} vertices have coordinates that are not finite: move or remove them", object_name=source.name,
                       vertices=lost.tolist())
    return not len(lost)


def bones_without_section(writer, armature):
    """Reports deforming bones without a part or a weight below a bone that has one. Bones above all others, such as roots and
    controls, are not reported."""
    ids = {bone.name: writer.skeleton.id(armature, bone.name) for bone in armature.data.bones}
    used = {body.bone for body in writer.asset.soft_bodies} | {body.bone for body in writer.asset.rigid_bodies if body.hull}
    used |= {mesh.bone for mesh in writer.asset.render_meshes}
    for mesh in writer.asset.render_meshes:
        if mesh.skin is not None:
            used |= {writer.asset.bones[number].id for number in set(mesh.skin.bones)}
    if not used & set(ids.values()):
        return
    empty = [bone.name for bone in armature.data.bones if bone.use_deform and bone.children and ids[bone.name] not in used and
             any(ids[one.name] in used for one in bone.parent_recursive)]
    if empty:
        writer.findings.warning(f"no section hangs on {', '.join(empty)}, and no vertex has a weight of theirs: parent parts to them "
                                "(Ctrl+P > Bone), paint weights, or turn off Deform in the bones' properties",
                                object_name=armature.name, bone_name=empty[0])
