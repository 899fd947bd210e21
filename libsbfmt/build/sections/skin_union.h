/* All skinned render meshes of an asset as one surface, and who holds each of its points. */
#ifndef SBFI_SKIN_UNION_H
#define SBFI_SKIN_UNION_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* A bone's share in a point. */
typedef struct sbfi_hold {
  uint32_t bone;
  float weight;
} sbfi_hold;

/* Vertices that stand in one place, bit by bit, are one point, over all meshes, so that what was stored apart
 * for rendering stays together; but not where their weights differ by more than half, as those of lips that
 * touch. Polygons keep their order, mesh after mesh, less corners and polygons that vanish so, and those that
 * have the points of an earlier one. */
typedef struct sbfi_skin_union {
  sbf_polygon_mesh mesh;     /* over the points */
  uint32_t *hold_begins;     /* (points + 1) */
  sbfi_hold *holds;          /* of each point, by bone; weights sum to one; a point may have none */
  uint32_t **points_of_mesh; /* (render meshes) the point of each vertex; NULL: the mesh is not chosen */
} sbfi_skin_union;

/* Which meshes are to be cut, `chosen` (render meshes) and `*count`: those that are skinned and are no
 * picture of a body, all of whose vertices are surface points of it. False where memory runs out. */
bool sbfi_skins_choose(const sbf_asset *asset, uint8_t *chosen, uint32_t *count, sbfi_arena *arena);

/* Memory of `arena`; false where it runs out. */
bool sbfi_skin_union_make(
    sbfi_skin_union *to, const sbf_asset *asset, const uint8_t *chosen, sbfi_arena *arena);

#endif
