/* Distances along a body from a bone: shortest paths through the cells of its grid. */
#ifndef SBFI_BODY_PATHS_H
#define SBFI_BODY_PATHS_H

#include "build/weights/body_grid.h"
#include "build/weights/bone_segments.h"

/* Scratch memory, reused for all bones. */
typedef struct sbfi_body_paths {
  const sbfi_body_grid *grid;
  float *distances; /* (cell_count) in cells; from the last queried bone */
  uint32_t *first;  /* first cell of each bucket, by distance */
  uint32_t *next, *previous;
} sbfi_body_paths;

bool sbfi_body_paths_make(sbfi_body_paths *paths, const sbfi_body_grid *grid, sbfi_arena *arena);

/* Computes `distances` to the nearest of `segments` (at least one): a bone, then its links. A bone outside
 * all cells starts at the nearest cell. */
void sbfi_body_paths_from(sbfi_body_paths *paths, const sbfi_bone_segment *segments, uint32_t segment_count);

#endif
