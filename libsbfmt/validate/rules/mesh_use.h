/* Finds the points of a render mesh that polygons of any level use. */
#ifndef SBFI_MESH_USE_H
#define SBFI_MESH_USE_H

#include "sbfmt/model.h"

/* `used` (mesh->mesh.positions.count) receives 1 or 0. */
static inline void sbfi_mesh_use_of(const sbf_render_mesh *mesh, uint8_t *used) {
  for (uint32_t i = 0; i < mesh->mesh.positions.count; i++) used[i] = 0;
  for (uint32_t c = 0; c < mesh->mesh.polygon_points.count; c++) used[mesh->mesh.polygon_points.at[c]] = 1;
  for (uint32_t l = 0; l < mesh->levels.count; l++)
    for (uint32_t c = 0; c < mesh->levels.at[l].polygon_points.count; c++)
      used[mesh->levels.at[l].polygon_points.at[c]] = 1;
}

#endif
