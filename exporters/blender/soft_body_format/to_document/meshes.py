"""Writes polygons, normals, texture coordinates, weights and shape keys of a mesh object."""

import numpy


class Geometry:
    """A mesh object's arrays in asset space. Vertices keep their order."""

    def __init__(self, source, mesh, space):
        world = source.matrix_world
        self.mesh, self.mirrored = mesh, world.is_negative
        self.positions = space.points(gather(mesh.vertices, "co", numpy.float32, 3), world)
        self.polygon_sizes = gather(mesh.polygons, "loop_total", numpy.uint32)
        self.starts = gather(mesh.polygons, "loop_start", numpy.uint32)
        self.order = self.corner_order()
        self.polygon_points = gather(mesh.loops, "vertex_index", numpy.uint32)[self.order]
        self.polygon_materials = gather(mesh.polygons, "material_index", numpy.uint32)

    def corner_order(self):
        """The Blender corner of each written corner, by polygons. A mirrored object's polygons are reversed."""
        sizes = self.polygon_sizes.astype(numpy.int64)
        total = int(sizes.sum())
        first = numpy.repeat(numpy.cumsum(sizes) - sizes, sizes)
        index = numpy.arange(total, dtype=numpy.int64) - first
        if self.mirrored:
            index = (numpy.repeat(sizes, sizes) - index) % numpy.repeat(sizes, sizes)
        return numpy.repeat(self.starts.astype(numpy.int64), sizes) + index


def gather(collection, name, dtype, width=1):
    """A property of all items of a collection, as an array."""
    values = numpy.empty(len(collection) * width, dtype=dtype)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def fill_polygons(record, geometry, target):
    record.target = target
    record.positions = geometry.positions
    record.polygon_sizes = geometry.polygon_sizes
    record.polygon_points = geometry.polygon_points


def distinct(rows):
    """(distinct rows of two or three floats in order of first use, index of each input row's distinct row). Equal rows have equal
    bits."""
    bits = numpy.ascontiguousarray(rows).view(numpy.uint32).astype(numpy.uint64)
    keys = bits[:, 0] << numpy.uint64(32) | bits[:, 1]
    sorting = numpy.argsort(keys, kind="stable") if rows.shape[1] == 2 else numpy.lexsort((bits[:, 2], keys))
    begins = numpy.ones(len(rows), dtype=bool)
    begins[1:] = (bits[sorting[1:]] != bits[sorting[:-1]]).any(axis=1)
    first = sorting[begins]
    order = numpy.argsort(first, kind="stable")
    index = numpy.empty(len(first), dtype=numpy.uint32)
    index[order] = numpy.arange(len(first))
    which = numpy.empty(len(rows), dtype=numpy.uint32)
    which[sorting] = index[numpy.cumsum(begins) - 1]
    return rows[first[order]], which


def fill_normals(record, geometry, source, space):
    """Writes the displayed normals: one per vertex if all its corners agree, else one per corner."""
    normals = space.normals(corner_normals(geometry.mesh)[geometry.order], source.matrix_world)
    points, count = geometry.polygon_points, len(geometry.positions)
    if not len(points):
        return
    of_point = numpy.zeros((count, 3), dtype=numpy.float32)
    of_point[:, 1] = 1.0
    of_point[points[::-1]] = normals[::-1]
    if numpy.array_equal(of_point[points], normals):
        record.normals = of_point
    else:
        record.normals, record.normal_corners = distinct(normals)


def corner_normals(mesh):
    if hasattr(mesh, "corner_normals"):
        return gather(mesh.corner_normals, "vector", numpy.float32, 3)
    mesh.calc_normals_split()
    return gather(mesh.loops, "normal", numpy.float32, 3)


def fill_uv_sets(record, geometry):
    for layer in geometry.mesh.uv_layers:
        attribute = hasattr(layer, "uv")  # Blender 3.5 and later
        corners = gather(layer.uv if attribute else layer.data, "vector" if attribute else "uv", numpy.float32, 2)
        corners = corners[geometry.order]
        uv_set = record.add("uv_sets", name=layer.name)
        uv_set.coordinates, uv_set.corners = distinct(corners)


def fill_shape_keys(record, source, geometry, space, findings):
    """Writes each shape key relative to its base key, if the mesh still has the vertices that the keys were made for."""
    keys = getattr(source.data, "shape_keys", None)
    if keys is None:
        return
    if source.type != "MESH":
        findings.warning("shape keys of curves and surfaces are left out; its shape as it is now is written", object_name=source.name)
        return
    if len(source.data.vertices) != len(geometry.positions):
        findings.warning("modifiers change the number of vertices, so its shape keys are left out; turn them off in the export "
                         "to keep the keys", object_name=source.name)
        return
    for key in keys.key_blocks:
        if key == keys.reference_key:
            continue
        moved = gather(key.data, "co", numpy.float32, 3) - gather(key.relative_key.data, "co", numpy.float32, 3)
        points = numpy.flatnonzero(numpy.abs(moved).max(axis=1) > 0)
        if len(points):
            record.add("shape_keys", name=key.name, points=points.astype(numpy.uint32),
                       offsets=space.offsets(moved[points], source.matrix_world))


def group_weights(mesh, groups):
    """{group index: (vertices, weights)} of those groups, sorted by vertex."""
    found = {index: ([], []) for index in groups}
    for vertex in mesh.vertices:
        for one in vertex.groups:
            if one.group in found and one.weight > 0.0:
                found[one.group][0].append(vertex.index)
                found[one.group][1].append(one.weight)
    return found


def fill_skin(record, source, mesh, bone_of_group, findings):
    """Writes any number of weights per vertex, normalized to sum 1. `bone_of_group` maps indices of vertex groups to bones."""
    counts = numpy.zeros(len(mesh.vertices), dtype=numpy.uint32)
    bones, weights, loose = [], [], []
    for vertex in mesh.vertices:
        influences = sorted((bone_of_group[one.group], one.weight) for one in vertex.groups
                      if one.group in bone_of_group and one.weight > 0.0)
        total = sum(weight for _, weight in influences)
        counts[vertex.index] = len(influences)
        bones += [bone for bone, _ in influences]
        weights += [weight / total for _, weight in influences]
        if not influences:
            loose.append(vertex.index)
    if loose and len(loose) < len(counts):
        findings.warning(f"{len(loose)} vertices have no weight of any bone; they will stay with the root", vertices=loose,
                         object_name=source.name)
    if weights:
        record.add("skin", influence_counts=counts, bones=bones, weights=weights)
