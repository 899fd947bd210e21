/* Combines all skinned render meshes of an asset to one surface with bone weights. */
#ifndef SBFI_SKIN_UNION_H
#define SBFI_SKIN_UNION_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* Weight of a bone at a point. */
typedef struct sbfi_bone_weight {
  uint32_t bone;
  float weight;
} sbfi_bone_weight;

/* Vertices with exactly equal positions are one point, over all meshes, which reverses splits for
 * rendering; except if their weights differ by more than half, as at lips in contact. Polygons keep their
 * order, mesh after mesh; corners and polygons that degenerate, and duplicates of earlier polygons, are
 * removed. */
typedef struct sbfi_skin_union {
  sbf_polygon_mesh mesh;          /* over the points */
  uint32_t *bone_weight_begins;   /* (points + 1) */
  sbfi_bone_weight *bone_weights; /* of each point, by bone; normalized weights; a point may have none */
  uint32_t **points_of_mesh;      /* (render meshes) point of each vertex; NULL: the mesh is not chosen */
} sbfi_skin_union;

/* Selects the meshes to cut, `chosen` (render meshes) and `*count`: skinned meshes, except those that show
 * a body because all their vertices are surface points of it. False if memory runs out. */
bool sbfi_skins_choose(const sbf_asset *asset, uint8_t *chosen, uint32_t *count, sbfi_arena *arena);

/* Allocates from `arena`; false if memory runs out. */
bool sbfi_skin_union_make(
    sbfi_skin_union *to, const sbf_asset *asset, const uint8_t *chosen, sbfi_arena *arena);

#endif
