/* Springs of a body. The order of every list is part of the contract: the relaxation scheme corrects springs
 * in that order. */
#ifndef SBFI_SPRINGS_H
#define SBFI_SPRINGS_H

#include "base/progress.h"
#include "build/geometry/topology.h"

typedef struct sbfi_spring_list {
  sbf_uint2 *at;
  uint32_t count;
} sbfi_spring_list;

/* Springs over the surface, no pair twice in any of the three:
 *
 * - structural: the sides of the polygons, corner k to corner k + 1, as the walk over the polygons meets
 * them;
 *
 * - shear: in the same walk, of each polygon of four and more corners, corner k to corner k + 2 (of a quad
 * both diagonals), and where a triangle's side belongs to it and one more triangle, the two corners opposite
 * that side;
 *
 * - flexion: for each point, its neighbours that lie opposite each other: no polygon at the point holds both,
 * and each is the straightest continuation of the other. Points with more than 64 neighbours, the poles of a
 * sphere, have none. */
typedef struct sbfi_surface_springs {
  sbfi_spring_list structural, shear, flexion;
} sbfi_surface_springs;

bool sbfi_springs_surface(sbfi_surface_springs *springs, const sbf_polygon_mesh *mesh,
    const sbfi_topology *topology, bool flexion, sbfi_arena *arena);

/* The interior of the bachelor's thesis behind the reference lizard: a centre, the mean of all points of the
 * surface (in no polygon as well), and for each polygon a point, the mean of its corners and the centre.
 * Sums run in single precision in source order, as the reference's do. A triangle gets a point only in a
 * surface of which at least half the polygons are triangles: what glTF made of quads, rather than a stray
 * triangle among quads, which the reference leaves to its sides' springs.
 *
 * Springs, by places in: the surface's points, then `given` points an author placed, then these points.
 * Centre to every surface point in source order; then polygon by polygon its point to each corner and to the
 * centre. (The author's points are joined by sbfi_springs_author.) */
typedef struct sbfi_centroid_interior {
  sbf_vec3 *points; /* (point_count) the centre first */
  uint32_t point_count;
  uint32_t *polygon_points; /* (polygons) index of each polygon's point in `points`; SBFI_NO_INDEX: none */
  sbfi_spring_list internal;
} sbfi_centroid_interior;

bool sbfi_springs_centroid(
    sbfi_centroid_interior *interior, const sbf_polygon_mesh *mesh, uint32_t given, sbfi_arena *arena);

/* An interior on a body-centred grid: its nodes inside the surface, but for those next to it, and springs
 * along the grid's edges between them that the surface does not cut. Every surface point has springs to the
 * up to four nearest nodes that it sees, within five quarters of a cell, or, where there are none, two cells
 * and a half; and every node that lacks one of its fourteen neighbours to those corners of the nearest
 * triangle that it sees. So no spring leaves a concave body. Places as with the centroid interior: surface,
 * given, these. */
typedef struct sbfi_lattice_interior {
  sbf_vec3 *points; /* (point_count) first those at least half as deep below the surface as the deepest */
  uint32_t point_count, deep_count;
  double cell; /* m, of the grid */
  sbfi_spring_list internal;
} sbfi_lattice_interior;

/* `cell` 0: by the length of the polygons' sides, and finer where that leaves no node inside. No points where
 * none are inside, or the grid would be too fine. False where memory runs out or `progress` ends it. */
bool sbfi_springs_lattice(sbfi_lattice_interior *interior, const sbf_polygon_mesh *mesh, uint32_t given,
    double cell, sbfi_progress progress, sbfi_arena *arena);

/* All pairs of the first `count` points without a spring in `known`, in the order of their indices. */
bool sbfi_springs_brute(
    sbfi_spring_list *springs, uint32_t count, const sbfi_surface_springs *known, sbfi_arena *arena);

#endif
