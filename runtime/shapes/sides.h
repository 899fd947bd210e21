/* Adjacency of a surface's triangles: its rims, and edges along which it is bent. */
#ifndef SBRI_SIDES_H
#define SBRI_SIDES_H

#include <stdbool.h>

#include "math/vec3.h"

/* Values in place of the opposite corner: there is no other triangle; an earlier triangle already lists the
 * edge. */
#define SBRI_RIM UINT32_MAX
#define SBRI_SAME_SIDE (UINT32_MAX - 1)

/* Size of the scratch table of sbri_sides_find. */
static inline uint32_t sbri_sides_table(uint32_t triangle_count) {
  uint32_t capacity = 8;
  while (capacity < 6 * triangle_count) capacity *= 2;
  return capacity;
}

/* For each edge of each triangle (3 x count), from each corner on: the third corner of the other triangle at
 * the edge, SBRI_RIM or SBRI_SAME_SIDE. */
void sbri_sides_find(const uint32_t *triangles, uint32_t count, uint32_t *beside, uint32_t *table);

/* Squared cosine of the angle above which an edge collides: 18 degrees. Flatter surfaces collide by vertices
 * and faces. */
#define SBRI_BENT 0.9045f

/* Whether two triangles are bent along their edge from a to b: `own` and `other` are their third corners. */
static inline bool sbri_side_is_bent(sbf_vec3 a, sbf_vec3 b, sbf_vec3 own, sbf_vec3 other) {
  sbf_vec3 side = sbri_sub(b, a), n = sbri_cross(side, sbri_sub(own, a)),
           m = sbri_cross(sbri_sub(other, a), side);
  float both = sbri_dot(n, m);
  return !(both > 0) || both * both < SBRI_BENT * sbri_dot(n, n) * sbri_dot(m, m);
}

#endif
