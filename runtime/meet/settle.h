/* The pushes of touches that act on each other, and a touch as those see it who look for its push: how its
 * two ends move against each other, and what an impulse does to that. */
#ifndef SBRI_SETTLE_H
#define SBRI_SETTLE_H

#include "math/vec3.h"
#include "meet/meetings.h"

static inline sbf_vec3 sbri_meet_velocity(const sbri_meet_end *end) {
  if (end->mover)
    return sbri_add(
        sbri_four_xyz(end->mover->velocity), sbri_cross(sbri_four_xyz(end->mover->spin), end->arm));
  sbf_vec3 sum = {0, 0, 0};
  for (uint32_t k = 0; k < end->count; k++) {
    const float *v = end->points[k];
    sum = sbri_add_scaled(sum, sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]), end->weights[k]);
  }
  return sbri_add_scaled(end->still, sum, end->speed);
}

/* Of a against b, m/s. */
static inline sbf_vec3 sbri_meet_between(const sbri_meet_row *r) {
  return sbri_sub(sbri_meet_velocity(&r->a), sbri_meet_velocity(&r->b));
}

static inline void sbri_meet_give_end(const sbri_meet_end *end, sbf_vec3 p) {
  sbri_meet_mover *m = end->mover;
  for (uint32_t k = 0; k < end->count; k++) {
    float *v = end->points[k], share = end->eases[k];
    v[0] += share * p.x, v[SBRI_BLOCK] += share * p.y, v[2 * SBRI_BLOCK] += share * p.z;
  }
  if (!m) return;
  sbf_vec3 l = sbri_cross(end->arm, p);
  m->velocity = sbri_four_add_scaled(m->velocity, sbri_four_of(p), m->ease);
  m->spin = sbri_four_add(
      m->spin, sbri_four_of(sbri_vec3(m->eases[0][0] * l.x + m->eases[0][1] * l.y + m->eases[0][2] * l.z,
                   m->eases[1][0] * l.x + m->eases[1][1] * l.y + m->eases[1][2] * l.z,
                   m->eases[2][0] * l.x + m->eases[2][1] * l.y + m->eases[2][2] * l.z)));
  m->given = sbri_add(m->given, p);
  m->moment = sbri_add(m->moment, l);
}

/* An impulse on a, and its reaction on b. */
static inline void sbri_meet_give(const sbri_meet_row *r, sbf_vec3 impulse) {
  sbri_meet_give_end(&r->a, impulse);
  sbri_meet_give_end(&r->b, sbri_scale(impulse, -1));
}

/* Finds the impulses of all rows, from those that they have been given already. */
void sbri_meet_settle(sbri_meet_row *rows, uint32_t count);

#endif
