/* A body's level as something that embeds vertices: which of its points, with which weights. */
#ifndef SBFI_EMBEDDER_H
#define SBFI_EMBEDDER_H

#include "build/embed/tetrahedron_finder.h"
#include "build/geometry/triangle_tree.h"
#include "build/springs/spring_level.h"

enum { SBFI_EMBEDDER_EXTREMES = 14 };

/* Bounds of a weight that a file may hold. */
static const double SBFI_MIN_EMBEDDED = -0.5, SBFI_MAX_EMBEDDED = 1.5;

typedef struct sbfi_embedded_vertex {
  sbf_uint4 points;
  sbf_vec4 weights; /* summing to 1, and giving the vertex back but for `error` */
  float error;      /* m; not 0 where the body has no depth beside the vertex */
  float outside;    /* m, from the lattice, where one embeds it */
  bool beyond;      /* no weights in bounds give the vertex back: `error` is what those used miss it by */
} sbfi_embedded_vertex;

/* What weights are for: vertices that a file holds, in bounds; or loads of a calibration, which are spread
 * over the points and need no bounds. */
typedef enum sbfi_embedder_use { SBFI_EMBEDS_VERTICES, SBFI_EMBEDS_LOADS } sbfi_embedder_use;

typedef struct sbfi_embedder {
  sbfi_embedder_use use;
  const sbf_soft_body *body;
  const sbf_level *level;
  sbfi_interior_map interior;
  uint32_t frame;                  /* first of four points that embed what lies beyond; SBFI_NO_INDEX: none */
  sbfi_triangle_tree surface;      /* of the body, at rest */
  sbfi_tetrahedron_finder lattice; /* of the level's tetrahedra, where it has some */
  sbfi_embedded_vertex *in_lattice;          /* of the surface's points, where the level has tetrahedra */
  sbfi_box_tree points;                      /* of the level, where the body has no polygons */
  uint32_t extremes[SBFI_EMBEDDER_EXTREMES]; /* level points farthest out: along the axes, and diagonals */
  double size;                               /* m, the longest way between two opposite ones */
  uint32_t *slots; /* hash of the surface's positions, bit by bit, to their points */
  size_t slot_count;
} sbfi_embedder;

/* `interior` may be NULL for a level that was not made by sbfi_spring_level_make, `frame` is the first of its
 * points by section_frame.h or SBFI_NO_INDEX. Memory of `arena`; body and
 * level must outlive the embedder. False where memory runs out. */
bool sbfi_embedder_make(sbfi_embedder *embedder, sbfi_embedder_use use, const sbf_soft_body *body,
    const sbf_level *level, const sbfi_interior_map *interior, uint32_t frame, sbfi_arena *arena);

/* How the level embeds a vertex at `position`:
 *   a surface point in the very same place (bit by bit; `likely` first) embeds it alone;
 *   frame points what lies elsewhere, with a lattice what lies far outside of it (without frame points the
 * level's extremes);
 *   a lattice by the tetrahedron around the vertex, or one near it (tetrahedron_finder.h), or where its
 * weights are out of bounds by one beside that, or four points of the rings around it (point_rings.h); else
 * by the nearest triangle of the surface (of polygons cut as fans from their first corner) and a fourth
 * point: the polygon's own, the centre, or the level's extremes, whichever leaves the smallest weights; and
 * deep inside, the triangle that the ray from the centre through the vertex meets. Weights lie outside 0..1
 * where the vertex lies outside the four points, and never outside the bounds above: a vertex beyond what
 * such weights reach is embedded as near as they come, and `error` says how far off that is. */
sbfi_embedded_vertex sbfi_embedder_embed(const sbfi_embedder *embedder, sbf_vec3 position, uint32_t likely);

/* By four points of the level, the first of them `frame`. */
sbfi_embedded_vertex sbfi_embedder_embed_by_frame(
    const sbfi_embedder *embedder, uint32_t frame, sbf_vec3 position);

/* Whether one of the body's surface points stands in that very place, bit by bit. */
bool sbfi_embedder_has(const sbfi_embedder *embedder, sbf_vec3 position);

/* Squared distance from the body's surface if below `least`, else `least`. */
double sbfi_embedder_distance(const sbfi_embedder *embedder, sbf_vec3 position, double min);

#endif
