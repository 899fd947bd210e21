"""Imports polygons as meshes."""

import bpy
import numpy


def make_mesh(name, record, space):
    """(a mesh of polygons and points, its Corners)."""
    mesh = bpy.data.meshes.new(name)
    points = space.points_back(record.positions)
    corners = Corners(record, points)
    add_polygons(mesh, points, corners.points, corners.sizes)
    return mesh, corners


def add_polygons(mesh, points, polygon_points, sizes):
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.ravel())
    mesh.loops.add(len(polygon_points))
    mesh.loops.foreach_set("vertex_index", polygon_points.astype(numpy.int32))
    mesh.polygons.add(len(sizes))
    mesh.polygons.foreach_set("loop_start", numpy.cumsum(sizes, dtype=numpy.int32) - sizes)
    if bpy.app.version < (4, 1, 0):
        mesh.polygons.foreach_set("loop_total", sizes)
    mesh.update(calc_edges=True)


class Corners:
    """The document's polygons as faces that Blender can hold. A polygon may use a point twice, for example around a hole that a slit
    joins to the rim. Blender has no such faces, and some of its functions then write out of bounds, so the polygon is cut into
    triangles.

    `sizes`, `points`: the faces. `corner`: the document's corner of each face corner. `polygon`: the document's polygon of each
    face."""

    def __init__(self, record, points):
        sizes = numpy.array(record.polygon_sizes, dtype=numpy.int32)
        polygon_points = numpy.array(record.polygon_points, dtype=numpy.int64)
        polygon_of = numpy.repeat(numpy.arange(len(sizes)), sizes)
        again = repeated(polygon_of, polygon_points)
        self.sizes, self.polygon = sizes, numpy.arange(len(sizes))
        self.corner = numpy.arange(len(polygon_points))
        if len(again):
            repeated_corners = numpy.isin(polygon_of, again)
            triangles, owners = cut(points[polygon_points[repeated_corners]], sizes[again])
            triangles, owners = numpy.flatnonzero(repeated_corners)[triangles], again[owners]
            sound = [len(set(three)) == 3 for three in polygon_points[triangles].tolist()]
            kept = numpy.delete(self.polygon, again)
            self.sizes = numpy.concatenate((sizes[kept], numpy.full(sum(sound), 3, dtype=numpy.int32)))
            self.polygon = numpy.concatenate((kept, owners[sound]))
            self.corner = numpy.concatenate((self.corner[~repeated_corners], triangles[sound].ravel()))
        self.points = polygon_points[self.corner]


def repeated(polygon_of, polygon_points):
    """Indices of the polygons that use a point twice."""
    order = numpy.lexsort((polygon_points, polygon_of))
    polygons, points = polygon_of[order], polygon_points[order]
    return numpy.unique(polygons[1:][(polygons[1:] == polygons[:-1]) & (points[1:] == points[:-1])])


def cut(corner_points, sizes):
    """(corners of the triangles, polygon of each triangle). Each corner of `polygons` is its own point."""
    scratch = bpy.data.meshes.new("cut")
    add_polygons(scratch, corner_points, numpy.arange(len(corner_points)), sizes)
    scratch.calc_loop_triangles()
    triangles = numpy.empty(3 * len(scratch.loop_triangles), dtype=numpy.int32)
    owners = numpy.empty(len(scratch.loop_triangles), dtype=numpy.int32)
    scratch.loop_triangles.foreach_get("loops", triangles)
    scratch.loop_triangles.foreach_get("polygon_index", owners)
    bpy.data.meshes.remove(scratch)
    return triangles.reshape(-1, 3), owners
