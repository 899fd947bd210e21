/* The pushes of touches that act on each other, and a touch as those see it who look for its push: how its
 * two ends move against each other, and what an impulse does to that. */
#ifndef SBRI_SETTLE_H
#define SBRI_SETTLE_H

#include "math/vec3.h"
#include "meet/meetings.h"

/* What its points do for it, m/s. */
static inline sbf_vec3 sbri_meet_points_move(const sbri_meet_end *end) {
  sbf_vec3 sum = {0, 0, 0};
  for (uint32_t k = 0; k < end->count; k++) {
    const float *v = end->points[k];
    sum = sbri_add_scaled(sum, sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]), end->weights[k]);
  }
  return sbri_scale(sum, end->speed);
}

static inline sbf_vec3 sbri_meet_velocity(const sbri_meet_end *end) {
  if (end->mover)
    return sbri_add(
        sbri_four_xyz(end->mover->velocity), sbri_cross(sbri_four_xyz(end->mover->spin), end->arm));
  return sbri_add(end->still, sbri_meet_points_move(end));
}

/* Of a against b, m/s. */
static inline sbf_vec3 sbri_meet_between(const sbri_meet_row *r) {
  return sbri_sub(sbri_meet_velocity(&r->a), sbri_meet_velocity(&r->b));
}

static inline void sbri_meet_give_points(const sbri_meet_end *end, sbf_vec3 p) {
  for (uint32_t k = 0; k < end->count; k++) {
    float *v = end->points[k], share = end->eases[k];
    v[0] += share * p.x, v[SBRI_BLOCK] += share * p.y, v[2 * SBRI_BLOCK] += share * p.z;
  }
}

static inline void sbri_meet_give_end(const sbri_meet_end *end, sbf_vec3 p) {
  sbri_meet_mover *m = end->mover;
  sbri_meet_give_points(end, p);
  if (!m) return;
  m->velocity = sbri_four_add_scaled(m->velocity, sbri_four_of(p), m->ease);
  m->spin = sbri_four_add(m->spin, sbri_four_times(end->spins, sbri_four_of(p)));
}

/* An impulse on a, and its reaction on b. */
static inline void sbri_meet_give(const sbri_meet_row *r, sbf_vec3 impulse) {
  sbri_meet_give_end(&r->a, impulse);
  sbri_meet_give_end(&r->b, sbri_scale(impulse, -1));
}

/* Finds the impulses of all rows, from those that they have been given already. */
void sbri_meet_settle(sbri_meet_row *rows, uint32_t count);

#endif
