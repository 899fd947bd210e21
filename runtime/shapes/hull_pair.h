/* Contact manifold of two hulls that touch or are near each other. */
#ifndef SBRI_HULL_PAIR_H
#define SBRI_HULL_PAIR_H

#include "math/quat.h"
#include "shapes/hull.h"

/* A hull in a pose. */
typedef struct sbri_placed_hull {
  const sbri_hull *hull;
  sbf_vec3 at;
  sbf_quat rotation;
  float scale; /* of lengths */
} sbri_placed_hull;

enum { SBRI_PAIR_POINTS = 4 };
typedef struct sbri_hull_pair {
  sbf_vec3 normal; /* unit, from b to a */
  float gap;       /* of whole hulls along the normal, negative if they overlap */
  uint32_t count;
  sbf_vec3 on_a[SBRI_PAIR_POINTS], on_b[SBRI_PAIR_POINTS];
  float gaps[SBRI_PAIR_POINTS]; /* of each point */
} sbri_hull_pair;

/* Separating axis with the largest separation or smallest penetration, and up to four points with a
 * separation of at most `reach` along it. Returns false if there are none. */
bool sbri_collide_hulls(
    const sbri_placed_hull *a, const sbri_placed_hull *b, float reach, sbri_hull_pair *pair);

/* Adds a point and keeps the four that span most of the contact area. The deepest is first. */
void sbri_hull_pair_add(sbri_hull_pair *pair, sbf_vec3 on_a, sbf_vec3 on_b, float gap);

#endif
