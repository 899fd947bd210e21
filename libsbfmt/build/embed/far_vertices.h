/* Collects vertices of a render mesh that are far outside the level that embeds them, for a report. */
#ifndef SBFI_FAR_VERTICES_H
#define SBFI_FAR_VERTICES_H

#include "base/diagnostic.h"
#include "base/memory.h"
#include "sbfmt/model.h"

enum { SBFI_FAR_VERTICES_NAMED = 4 };

typedef struct sbfi_far_vertices {
  const sbf_render_mesh *mesh;
  uint8_t *known;       /* (vertices) bit 0: in a polygon, bit 1: counted; NULL before the first */
  uint32_t count;       /* number of distinct vertices */
  uint32_t in_polygons; /* of these, those in polygons */
  uint32_t named[SBFI_FAR_VERTICES_NAMED]; /* the first of them */
  double farthest_m;
  uint32_t body; /* body that embeds the farthest */
} sbfi_far_vertices;

/* Adds a vertex, `outside_m` from the lattice of a body. False if memory runs out. */
bool sbfi_far_vertices_add(
    sbfi_far_vertices *to, uint32_t vertex, double outside_m, uint32_t body, sbfi_arena *arena);

/* Reports EMBEDDING_FAR if there are any. */
void sbfi_far_vertices_report(const sbfi_far_vertices *of, const sbf_asset *asset, sbfi_reporter *reporter);

#endif
