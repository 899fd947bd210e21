/* A body as cells of a grid: those that its surface crosses and those inside. Paths lead to all 26
 * neighbours. */
#ifndef SBFI_BODY_GRID_H
#define SBFI_BODY_GRID_H

#include "build/weights/body_rays.h"

enum {
  SBFI_BODY_CELLS = 64,
  SBFI_BODY_DIRECTIONS = 26
}; /* cells along the longest side; neighbours of a cell */

/* A straight path over cells outside the body; stored once for both directions. */
typedef struct sbfi_body_bridge {
  uint32_t from, to;
  float length; /* in cells */
} sbfi_body_bridge;

typedef struct sbfi_body_grid {
  uint32_t counts[3]; /* boxes along x, y, z, including a margin of one without cells */
  uint32_t box_count;
  int32_t *cell_of_box;  /* (box_count) or SBF_NONE */
  uint32_t *box_of_cell; /* (cell_count) */
  uint32_t cell_count;
  sbfi_body_bridge *bridges; /* (bridge_count) ascending by `from`; body_bridges.h creates them */
  uint32_t bridge_count;
  int32_t steps[SBFI_BODY_DIRECTIONS]; /* to a box's neighbours; the first half leads to lower indices, the
                                          second to higher */
  float lengths[SBFI_BODY_DIRECTIONS]; /* in cells */
} sbfi_body_grid;

/* False if memory runs out. */
bool sbfi_body_grid_make(
    sbfi_body_grid *grid, const sbfi_weight_mesh *mesh, const sbfi_body_rays *rays, sbfi_arena *arena);

/* Centre of a box; box of a point, which is clamped to the mesh's bounding box. */
sbfi_d3 sbfi_body_box_middle(const sbfi_body_grid *grid, uint32_t box);
uint32_t sbfi_body_box_at(const sbfi_body_grid *grid, sbfi_d3 point);

#endif
