/* Contact manifold of two hulls that touch or are about to. */
#ifndef SBRI_HULL_PAIR_H
#define SBRI_HULL_PAIR_H

#include "collide/hull.h"
#include "math/quat.h"

/* A hull at a place. */
typedef struct sbri_placed_hull {
  const sbri_hull *hull;
  sbf_vec3 at;
  sbf_quat rotation;
  float scale; /* of its lengths */
} sbri_placed_hull;

enum { SBRI_PAIR_POINTS = 4 };
typedef struct sbri_hull_pair {
  sbf_vec3 normal; /* unit, from b to a */
  float gap;       /* of the hulls as a whole along it, negative where they overlap */
  uint32_t count;
  sbf_vec3 on_a[SBRI_PAIR_POINTS], on_b[SBRI_PAIR_POINTS];
  float gaps[SBRI_PAIR_POINTS]; /* likewise, of each place */
} sbri_hull_pair;

/* The direction along which they are furthest apart, or overlap least, and up to four places that are no
 * further apart along it than `reach`. False where there are none. */
bool sbri_collide_hulls(
    const sbri_placed_hull *a, const sbri_placed_hull *b, float reach, sbri_hull_pair *pair);

/* Of places on a plane square to the normal the four that span most of what they span: the deepest first. */
void sbri_hull_pair_add(sbri_hull_pair *pair, sbf_vec3 on_a, sbf_vec3 on_b, float gap);

#endif
