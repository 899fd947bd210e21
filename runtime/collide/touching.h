/* What a body touches, for events: up to so many other things at once, told when each begins. Output, not
 * state: nothing that moves goes by it. */
#ifndef SBRI_TOUCHING_H
#define SBRI_TOUCHING_H

#include "math/vec3.h"

/* Of a host's bodies those that are beyond it get no push back. */
enum { SBRI_TOUCHING = 12 };

typedef struct sbri_touching_one {
  uint32_t thing; /* number of the collider, or UINT32_MAX: the ground */
  bool fresh;     /* it was not touched in the tick before */
  sbf_vec3 place, normal;
  float impulse;         /* N s, of its places, each in the substep in which it was most */
  sbf_vec3 push, moment; /* N s and N m s about `place`: of all pushes of the tick that the body got */
} sbri_touching_one;

typedef struct sbri_touching {
  sbri_touching_one now[SBRI_TOUCHING];
  uint32_t before[SBRI_TOUCHING];
  uint32_t count, before_count;
  bool stepped; /* the pushes are those of this tick */
} sbri_touching;

static inline void sbri_touching_begin(sbri_touching *t) {
  for (uint32_t i = 0; i < t->count; i++) t->before[i] = t->now[i].thing;
  t->before_count = t->count;
  t->count = 0;
  t->stepped = true;
}

/* The entry of the thing; NULL: there is no room for another one. */
static inline sbri_touching_one *sbri_touching_add(
    sbri_touching *t, uint32_t thing, sbf_vec3 place, sbf_vec3 normal, float impulse) {
  for (uint32_t i = 0; i < t->count; i++) {
    if (t->now[i].thing != thing) continue;
    t->now[i].impulse += impulse;
    return &t->now[i];
  }
  if (t->count == SBRI_TOUCHING) return NULL;
  bool fresh = true;
  for (uint32_t i = 0; i < t->before_count; i++) fresh = fresh && t->before[i] != thing;
  t->now[t->count] = (sbri_touching_one){
      .thing = thing, .fresh = fresh, .place = place, .normal = normal, .impulse = impulse};
  return &t->now[t->count++];
}

/* An impulse that the body got at a place. */
static inline void sbri_touching_push(sbri_touching_one *one, sbf_vec3 place, sbf_vec3 impulse) {
  one->push = sbri_add(one->push, impulse);
  one->moment = sbri_add(one->moment, sbri_cross(sbri_sub(place, one->place), impulse));
}

#endif
