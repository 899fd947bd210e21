/* Distances along a body from a bone: shortest paths through the cells of its grid. */
#ifndef SBFI_BODY_PATHS_H
#define SBFI_BODY_PATHS_H

#include "build/weights/body_grid.h"
#include "build/weights/bone_segments.h"

/* Scratch for one bone after another. */
typedef struct sbfi_body_paths {
  const sbfi_body_grid *grid;
  float *distances; /* (cell_count) in cells; of the bone last asked for */
  uint32_t *first;  /* buckets of cells by distance */
  uint32_t *next, *previous;
} sbfi_body_paths;

bool sbfi_body_paths_make(sbfi_body_paths *paths, const sbfi_body_grid *grid, sbfi_arena *arena);

/* Fills `distances`, to the nearest of `segments` (at least one): a bone, then its links. A bone that no cell
 * of the body holds begins at the nearest cell. */
void sbfi_body_paths_from(sbfi_body_paths *paths, const sbfi_bone_segment *segments, uint32_t segment_count);

#endif
