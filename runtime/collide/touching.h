/* Things that a body touches, for events: a limited number, each reported when contact begins. Output, not
 * state: the simulation does not read it. */
#ifndef SBRI_TOUCHING_H
#define SBRI_TOUCHING_H

#include "math/vec3.h"

/* Capacity; external bodies beyond it receive no impulse. */
enum { SBRI_TOUCHING = 12 };

typedef struct sbri_touching_one {
  uint32_t thing; /* index of the collider; UINT32_MAX: the ground */
  bool fresh;     /* not touched in the previous tick */
  sbf_vec3 position, normal;
  float impulse;         /* sum over contact points of the maximum impulse of a substep, N s */
  sbf_vec3 push, moment; /* impulse and angular impulse about `position` that the body received in the tick, N
                            s and N m s */
} sbri_touching_one;

typedef struct sbri_touching {
  sbri_touching_one now[SBRI_TOUCHING];
  uint32_t before[SBRI_TOUCHING];
  uint32_t count, before_count;
  bool stepped; /* the impulses are of this tick */
} sbri_touching;

static inline void sbri_touching_begin(sbri_touching *t) {
  for (uint32_t i = 0; i < t->count; i++) t->before[i] = t->now[i].thing;
  t->before_count = t->count;
  t->count = 0;
  t->stepped = true;
}

/* Returns the entry of the thing, a new one if necessary; NULL if all are used. */
static inline sbri_touching_one *sbri_touching_add(
    sbri_touching *t, uint32_t thing, sbf_vec3 position, sbf_vec3 normal, float impulse) {
  for (uint32_t i = 0; i < t->count; i++) {
    if (t->now[i].thing != thing) continue;
    t->now[i].impulse += impulse;
    return &t->now[i];
  }
  if (t->count == SBRI_TOUCHING) return NULL;
  bool fresh = true;
  for (uint32_t i = 0; i < t->before_count; i++) fresh = fresh && t->before[i] != thing;
  t->now[t->count] = (sbri_touching_one){
      .thing = thing, .fresh = fresh, .position = position, .normal = normal, .impulse = impulse};
  return &t->now[t->count++];
}

/* Adds an impulse on the body at a point. */
static inline void sbri_touching_push(sbri_touching_one *one, sbf_vec3 position, sbf_vec3 impulse) {
  one->push = sbri_add(one->push, impulse);
  one->moment = sbri_add(one->moment, sbri_cross(sbri_sub(position, one->position), impulse));
}

#endif
