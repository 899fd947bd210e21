"""Imports texture coordinates, normals, materials, weights and shape keys of a mesh."""

import numpy


def fill_uv_sets(mesh, record, corners):
    for number, uv_set in enumerate(record.uv_sets):
        layer = mesh.uv_layers.new(name=uv_set.name or f"UV{number}", do_init=False)
        coordinates = numpy.array(uv_set.coordinates, dtype=numpy.float32).reshape(-1, 2)
        which = uv_set.corners if len(uv_set.corners) else record.mesh.polygon_points
        layer.data.foreach_set("uv", coordinates[numpy.array(which, dtype=numpy.int64)[corners.corner]].ravel())


def fill_normals(mesh, record, space, corners):
    """Sets the file's normals. A mesh whose normals agree along every edge gets smooth shading."""
    normals = numpy.array(record.normals, dtype=numpy.float32).reshape(-1, 3)
    if not len(normals):
        return
    which = numpy.array(record.normal_corners if len(record.normal_corners) else record.mesh.polygon_points, dtype=numpy.int64)
    if not len(record.normal_corners) or len(normals) != len(record.mesh.polygon_sizes):
        mesh.polygons.foreach_set("use_smooth", numpy.ones(len(mesh.polygons), dtype=bool))
    turned = space.offsets_back(normals[which[corners.corner]]) * space.unit_m
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set(turned.tolist())


def fill_materials(mesh, record, materials, corners):
    for slot in record.material_slots:
        mesh.materials.append(materials.get(slot.material))
    if len(record.polygon_materials):
        mesh.polygons.foreach_set("material_index", numpy.array(record.polygon_materials, dtype=numpy.int32)[corners.polygon])


def fill_skin(made, record, bone_names):
    """Makes one vertex group for each bone, with its weights."""
    groups, first = {}, 0
    for vertex, count in enumerate(record.skin.influence_counts):
        for at in range(first, first + count):
            name = bone_names[record.skin.bones[at]]
            group = groups.get(name) or groups.setdefault(name, made.vertex_groups.new(name=name))
            group.add([vertex], record.skin.weights[at], "REPLACE")
        first += count


def fill_shape_keys(made, record, space):
    if not record.shape_keys:
        return
    made.shape_key_add(name="Basis", from_mix=False)
    for key in record.shape_keys:
        block = made.shape_key_add(name=key.name, from_mix=False)
        offsets = space.offsets_back(key.offsets)
        for point, offset in zip(key.points, offsets.tolist()):
            for axis in range(3):
                block.data[point].co[axis] += offset[axis]
