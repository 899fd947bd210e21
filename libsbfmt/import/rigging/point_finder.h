/* Finds points by position, in a grid of hashed cells (Teschner et al. 2003). */
#ifndef SBFI_POINT_FINDER_H
#define SBFI_POINT_FINDER_H

#include "base/memory.h"
#include "mechanics/vector.h"

typedef struct sbfi_point_finder {
  const sbf_vec3 *points;
  sbfi_d3 low, high; /* of the points */
  double cell;       /* length of a cell's sides */
  uint32_t *starts;  /* (slot_count + 1) place in `items` where the points of a slot begin */
  uint32_t *items;   /* points, slot by slot, in ascending order within each */
  uint32_t slot_count;
} sbfi_point_finder;

/* `points` must outlive the finder. `within` is the usual distance of queries: others are correct as well,
 * but much longer ones are slow. False where memory runs out. */
bool sbfi_point_finder_make(
    sbfi_point_finder *finder, const sbf_vec3 *points, uint32_t count, double within, sbfi_arena *arena);

/* The nearest point no farther than `within`, the lowest number of several; UINT32_MAX: none. `*distance` may
 * be NULL. */
uint32_t sbfi_point_nearest(
    const sbfi_point_finder *finder, sbfi_d3 position, double within, double *distance);

/* Calls `visit` with every point no farther than `within`, each once. */
void sbfi_find_points_near(const sbfi_point_finder *finder, sbfi_d3 position, double within,
    void (*visit)(void *user, uint32_t point), void *user);

#endif
