/* Adjacency of a polygon mesh: edges, polygons at an edge, edges at a point, components. Used by the
 * spring passes and by validation. Numbers follow one walk over the polygons, corner by corner, so equal
 * meshes always have equal numbers. */
#ifndef SBFI_TOPOLOGY_H
#define SBFI_TOPOLOGY_H

#include "base/memory.h"
#include "sbfmt/model.h"

#define SBFI_NO_INDEX UINT32_MAX

typedef struct sbfi_topology {
  uint32_t point_count, polygon_count, corner_count, edge_count, component_count;
  uint32_t *corner_begins; /* (polygon_count + 1) first corner of each polygon */
  uint32_t *corner_edges;  /* (corner_count) edge to the polygon's next corner; SBFI_NO_INDEX: same point */
  sbf_uint2 *edges;        /* (edge_count) ends, in the direction of the first traversal */
  uint32_t *edge_polygon_begins; /* (edge_count + 1) */
  uint32_t *edge_polygons;     /* polygons at each edge; a polygon that traverses it twice is listed twice */
  uint32_t *point_edge_begins; /* (point_count + 1) */
  uint32_t *point_edges;       /* edges at each point, in edge order */
  uint32_t *point_components;  /* (point_count) numbered by first point; SBFI_NO_INDEX: no polygon */

  uint32_t boundary_edge_count;    /* one traversal */
  uint32_t nonmanifold_edge_count; /* more than two traversals */
  /* two traversals in the same direction: the polygons have opposite orientations */
  uint32_t clashing_edge_count;
  uint32_t unused_point_count;    /* points without polygons */
  uint32_t degenerate_side_count; /* edges from a point to itself */
} sbfi_topology;

/* Fills `*topology`, allocated from the arena; false if memory runs out. The mesh's indices must be valid. */
bool sbfi_topology_build(sbfi_topology *topology, const sbf_polygon_mesh *mesh, sbfi_arena *arena);

/* The end of the edge that is not `point`. */
static inline uint32_t sbfi_edge_other(const sbfi_topology *t, uint32_t edge, uint32_t point) {
  return t->edges[edge].at[0] == point ? t->edges[edge].at[1] : t->edges[edge].at[0];
}

#endif
