/* Finds points by place. */
#ifndef SBFI_POINT_FINDER_H
#define SBFI_POINT_FINDER_H

#include "build/geometry/box_tree.h"
#include "mechanics/vector.h"

typedef struct sbfi_point_finder {
  const sbf_vec3 *points;
  sbfi_box_tree tree;
} sbfi_point_finder;

/* `points` must outlive it. False where memory runs out. */
bool sbfi_point_finder_make(
    sbfi_point_finder *finder, const sbf_vec3 *points, uint32_t count, sbfi_arena *arena);

/* The nearest point no farther than `within`, the first of several; UINT32_MAX: none. `*distance` may be
 * NULL. */
uint32_t sbfi_point_nearest(
    const sbfi_point_finder *finder, sbfi_d3 position, double within, double *distance);

/* Hands over every point no farther than `within`. */
void sbfi_find_points_near(const sbfi_point_finder *finder, sbfi_d3 position, double within,
    void (*visit)(void *user, uint32_t point), void *user);

#endif
