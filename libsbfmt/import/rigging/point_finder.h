/* Finds points by position, in a grid of hashed cells (Teschner et al. 2003). */
#ifndef SBFI_POINT_FINDER_H
#define SBFI_POINT_FINDER_H

#include "base/memory.h"
#include "mechanics/vector.h"

typedef struct sbfi_point_finder {
  const sbf_vec3 *points;
  uint32_t point_count;
  sbfi_d3 low, high; /* of the points */
  double cell;       /* edge length of a cell */
  uint32_t *starts;  /* (slot_count + 1) first index into `items` of each slot */
  uint32_t *items;   /* points by slot, ascending within each */
  uint32_t slot_count;
} sbfi_point_finder;

/* `points` must outlive the finder. `within` is the usual query distance: others are correct, but much
 * longer ones look at all points. False if memory runs out. */
bool sbfi_point_finder_make(
    sbfi_point_finder *finder, const sbf_vec3 *points, uint32_t count, double within, sbfi_arena *arena);

/* Nearest point within the distance, the lowest index if equal; UINT32_MAX: none. `*distance` may be NULL. */
uint32_t sbfi_point_nearest(
    const sbfi_point_finder *finder, sbfi_d3 position, double within, double *distance);

/* Calls `visit` once for every point within the distance. */
void sbfi_find_points_near(const sbfi_point_finder *finder, sbfi_d3 position, double within,
    void (*visit)(void *user, uint32_t point), void *user);

#endif
