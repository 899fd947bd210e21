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

/* Springs over the surface, without duplicate pairs:
 *
 * - structural: the edges of the polygons, corner k to corner k + 1, in the order of a walk over the
 * polygons;
 *
 * - shear: in the same walk, corner k to corner k + 2 of each polygon with four or more corners (both
 * diagonals of a quad), and for an edge of exactly two triangles, the two corners opposite that edge;
 *
 * - flexion: for each point, pairs of opposite neighbours: no polygon at the point contains both, and each is
 * the straightest continuation of the other. Points with more than 64 neighbours, such as the poles of a
 * sphere, get none. */
typedef struct sbfi_surface_springs {
  sbfi_spring_list structural, shear, flexion;
} sbfi_surface_springs;

bool sbfi_springs_surface(sbfi_surface_springs *springs, const sbf_polygon_mesh *mesh,
    const sbfi_topology *topology, bool flexion, sbfi_arena *arena);

/* The interior used by the reference lizard, from the bachelor's thesis behind it: a centre, which is the
 * mean of all points of the surface (even those in no polygon), and a point for each polygon, which is the
 * mean of its corners and the centre. Sums run in single precision in source order, like those of the
 * reference. A triangle gets a point only if at least half of the surface's polygons are triangles, as after
 * conversion of quads by glTF. The reference leaves a stray triangle among quads to the springs along its
 * edges.
 *
 * Springs use these indices: the surface's points, then `given` points by the author, then these points.
 * First the centre to every surface point in source order; then, polygon by polygon, its point to each corner
 * and to the centre. (spring_level.c connects the author's points.) */
typedef struct sbfi_centroid_interior {
  sbf_vec3 *points; /* (point_count) the centre first */
  uint32_t point_count;
  uint32_t *polygon_points; /* (polygons) index of each polygon's point in `points`; SBFI_NO_INDEX: none */
  sbfi_spring_list internal;
} sbfi_centroid_interior;

bool sbfi_springs_centroid(
    sbfi_centroid_interior *interior, const sbf_polygon_mesh *mesh, uint32_t given, sbfi_arena *arena);

/* An interior on a body-centred grid: its nodes inside the surface, except those next to it, and springs
 * along the grid's edges between them that the surface does not cut. Every surface point has springs to up to
 * four nearest nodes in its line of sight, within five quarters of a cell, or two and a half cells if there
 * are none. Every node that lacks one of its fourteen neighbours has springs to the corners of the nearest
 * triangle in its line of sight. No spring therefore leaves a concave body. Indices as for the centroid
 * interior: surface, given, these. */
typedef struct sbfi_lattice_interior {
  sbf_vec3
      *points; /* (point_count) first the points at least half as deep below the surface as the deepest */
  uint32_t point_count, deep_count;
  double cell; /* m, of the grid */
  sbfi_spring_list internal;
} sbfi_lattice_interior;

/* `cell` 0: by the length of the polygons' edges, and finer if no node would be inside. No points if none is
 * inside, or the grid would be too fine. False if memory runs out or `progress` cancels. */
bool sbfi_springs_lattice(sbfi_lattice_interior *interior, const sbf_polygon_mesh *mesh, uint32_t given,
    double cell, sbfi_progress progress, sbfi_arena *arena);

/* All pairs of the first `count` points without a spring in `known`, in the order of their indices. */
bool sbfi_springs_brute(
    sbfi_spring_list *springs, uint32_t count, const sbfi_surface_springs *known, sbfi_arena *arena);

#endif
