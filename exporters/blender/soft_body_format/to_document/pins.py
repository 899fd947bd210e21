"""Writes the pin sets of the panel, and finds the bone that a pinned point follows."""

import numpy

from ..sbfmt.document import Record


def group_by_bone(writer, source, mesh, points):
    """[(bone id or None for the world, points)]: the bone that a mesh is parented to, or each point's bone of largest weight."""
    bone_of_object = writer.bone_of_object(source)
    armature = writer.armatures[source.name]
    if bone_of_object is not None or armature is None:
        return [(bone_of_object, numpy.asarray(points, dtype=numpy.uint32))]
    bones = {group.index: writer.skeleton.id(armature, group.name) for group in source.vertex_groups}
    sets = {}
    for point in numpy.asarray(points).tolist():
        influences = [(one.weight, bones.get(one.group)) for one in mesh.vertices[point].groups if bones.get(one.group)]
        sets.setdefault(max(influences)[1] if influences else None, []).append(point)
    return sorted(((bone, numpy.array(found, dtype=numpy.uint32)) for bone, found in sets.items()),
                  key=lambda pair: pair[0] or "")


def fill_pins(writer, body, source, mesh):
    """Writes the pin sets of the panel. A missing group or bone is an error, because the pins would do nothing."""
    for pin in source.soft_body_format.pins:
        group = source.vertex_groups.get(pin.group)
        if pin.group and group is None:
            writer.findings.error(f"the pin set of vertex group {pin.group} has lost its group: choose another one in Object > "
                                  "Soft body format > Pins, or remove the set", object_name=source.name)
            continue
        points, weights = weighted_points(mesh, group)
        if not points:
            writer.findings.warning(f"vertex group {pin.group} holds no vertex, so its pins do nothing", object_name=source.name)
            continue
        bone = writer.skeleton.id(pin.armature, pin.bone) if pin.armature is not None and pin.bone else None
        if pin.bone and bone is None:
            writer.findings.error(f"the pin set {pin.group} names the bone {pin.bone}, which is not exported: export its armature "
                                  "too, or choose another bone", object_name=source.name)
            continue
        body.pins.append(Record("pin_set", name=pin.group or "All", bone=bone, points=points,
                                weights=[] if set(weights) == {1.0} else weights, minimum=pin.minimum, maximum=pin.maximum,
                                stiffness=pin.stiffness, damping=pin.damping))


def weighted_points(mesh, group):
    """(vertices, weights) of a group; without a group all vertices, with weight 1."""
    if group is None:
        return list(range(len(mesh.vertices))), [1.0] * len(mesh.vertices)
    found = [(vertex.index, one.weight) for vertex in mesh.vertices for one in vertex.groups
             if one.group == group.index and one.weight > 0]
    return [index for index, _ in found], [weight for _, weight in found]


def fill_weight_maps(writer, body, source, mesh):
    """Painted attributes: a factor between the panel's two for each point."""
    for entry in source.soft_body_format.weight_maps:
        group = source.vertex_groups.get(entry.group)
        if group is None:
            writer.findings.error(f"the painted attribute {entry.attribute} names no vertex group: choose one in Object > Soft body "
                                  "format > Painted attributes, or remove the entry", object_name=source.name)
            continue
        weights = numpy.zeros(len(mesh.vertices))
        points, values = weighted_points(mesh, group)
        weights[points] = values
        body.add("weight_maps", property=entry.attribute,
                 values=(entry.low + (entry.high - entry.low) * weights).astype(numpy.float32))
