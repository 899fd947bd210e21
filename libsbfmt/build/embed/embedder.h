/* Embeds vertices in a body's level: which of its points, with which weights. */
#ifndef SBFI_EMBEDDER_H
#define SBFI_EMBEDDER_H

#include "build/embed/tetrahedron_finder.h"
#include "build/geometry/triangle_tree.h"
#include "build/springs/spring_level.h"

enum { SBFI_EMBEDDER_EXTREMES = 14 };

/* Bounds of a weight in a file. */
static const double SBFI_MIN_EMBEDDED = -0.5, SBFI_MAX_EMBEDDED = 1.5;

typedef struct sbfi_embedded_vertex {
  sbf_uint4 points;
  sbf_vec4 weights; /* summing to 1, and reproducing the vertex up to `error` */
  float error;      /* m; not 0 if the body has no depth near the vertex */
  float outside;    /* m, distance outside the lattice that embeds it */
  bool beyond;      /* no weights in bounds reproduce the vertex: `error` is the remaining distance */
} sbfi_embedded_vertex;

/* Purpose of the weights: vertices in a file, with bounds; or loads of a calibration, which are spread
 * over the points and need no bounds. */
typedef enum sbfi_embedder_use { SBFI_EMBEDS_VERTICES, SBFI_EMBEDS_LOADS } sbfi_embedder_use;

typedef struct sbfi_embedder {
  sbfi_embedder_use use;
  const sbf_soft_body *body;
  const sbf_level *level;
  sbfi_interior_map interior;
  uint32_t frame;                   /* first of four points for vertices far outside; SBFI_NO_INDEX: none */
  sbfi_triangle_tree surface;       /* of the body, at rest */
  sbfi_tetrahedron_finder lattice;  /* of the level's tetrahedra, if any */
  sbfi_embedded_vertex *in_lattice; /* of the surface's points, if the level has tetrahedra */
  sbfi_box_tree points;             /* of the level, if the body has no polygons */
  uint32_t extremes[SBFI_EMBEDDER_EXTREMES]; /* extreme level points along the axes and diagonals */
  double size;                               /* m, longest distance between two opposite ones */
  uint32_t *slots;                           /* hash of the surface's exact positions to their points */
  size_t slot_count;
} sbfi_embedder;

/* `interior` may be NULL for a level that was not made by sbfi_spring_level_make. `frame` is the first of
 * its points by section_frame.h or SBFI_NO_INDEX. Allocates from `arena`; body and level must outlive the
 * embedder. False if memory runs out. */
bool sbfi_embedder_make(sbfi_embedder *embedder, sbfi_embedder_use use, const sbf_soft_body *body,
    const sbf_level *level, const sbfi_interior_map *interior, uint32_t frame, sbfi_arena *arena);

/* Embedding of a vertex at `position`. A surface point at exactly this position (`likely` is tried first)
 * embeds it alone. Otherwise frame points embed it, with a lattice only if it is far outside (without
 * frame points the level's extremes do). A lattice uses the tetrahedron around the vertex, or one near it
 * (tetrahedron_finder.h); if its weights are out of bounds, one next to that, or four points of the rings
 * around it (point_rings.h). Otherwise the nearest triangle of the surface (polygons are fans from their
 * first corner) with a fourth point: the polygon's own, the centre, or one of the level's extremes,
 * whichever gives the smallest weights; deep inside, the triangle that the ray from the centre through the
 * vertex hits. Weights are outside 0..1 if the vertex is outside the four points, but never outside the
 * bounds above: a vertex that such weights cannot reach is embedded as close as possible, and `error` is
 * the remaining distance. */
sbfi_embedded_vertex sbfi_embedder_embed(const sbfi_embedder *embedder, sbf_vec3 position, uint32_t likely);

/* Embedding by four points of the level, the first of them `frame`. */
sbfi_embedded_vertex sbfi_embedder_embed_by_frame(
    const sbfi_embedder *embedder, uint32_t frame, sbf_vec3 position);

/* Whether one of the body's surface points is at exactly this position. */
bool sbfi_embedder_has(const sbfi_embedder *embedder, sbf_vec3 position);

/* Squared distance from the body's surface if below `min`, else `min`. */
double sbfi_embedder_distance(const sbfi_embedder *embedder, sbf_vec3 position, double min);

#endif
