/* Who touches whom in a polygon mesh: edges, polygons at an edge, edges at a point, components. Used by the
 * spring passes and by validation. Everything is numbered in the order of one walk over the polygons, corner
 * by corner, so the same mesh always gives the same numbers. */
#ifndef SBFI_TOPOLOGY_H
#define SBFI_TOPOLOGY_H

#include "base/memory.h"
#include "sbfmt/model.h"

#define SBFI_NO_INDEX UINT32_MAX

typedef struct sbfi_topology {
  uint32_t point_count, polygon_count, corner_count, edge_count, component_count;
  uint32_t *corner_begins; /* (polygon_count + 1) first corner of each polygon */
  uint32_t *corner_edges;  /* (corner_count) edge to the polygon's next corner; SBFI_NO_INDEX: same point */
  sbf_uint2 *edges;        /* (edge_count) ends, in the direction first walked */
  uint32_t *edge_polygon_begins; /* (edge_count + 1) */
  uint32_t *edge_polygons;       /* polygons at each edge; one that passes it twice stands twice */
  uint32_t *point_edge_begins;   /* (point_count + 1) */
  uint32_t *point_edges;         /* edges at each point, in edge order */
  uint32_t *point_components;    /* (point_count) numbered by first point; SBFI_NO_INDEX: in no polygon */

  uint32_t boundary_edge_count;    /* passed once */
  uint32_t nonmanifold_edge_count; /* passed more than twice */
  uint32_t clashing_edge_count;    /* passed twice in the same direction: the polygons face opposite ways */
  uint32_t unused_point_count;     /* in no polygon */
  uint32_t degenerate_side_count;  /* sides from a point to itself */
} sbfi_topology;

/* Fills `*topology` with memory of the arena; false where memory runs out. The mesh's indices are valid. */
bool sbfi_topology_build(sbfi_topology *topology, const sbf_polygon_mesh *mesh, sbfi_arena *arena);

/* The end of the edge that is not `point`. */
static inline uint32_t sbfi_edge_other(const sbfi_topology *t, uint32_t edge, uint32_t point) {
  return t->edges[edge].at[0] == point ? t->edges[edge].at[1] : t->edges[edge].at[0];
}

#endif
