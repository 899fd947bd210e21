/* Walls in the energy of springs: what is longer or shorter than its strain limits allow is brought to them,
 * and the speed with which it was leaving them is taken (Provot, Deformation Constraints in a Mass-Spring
 * Model, 1995, moves the points alike). Momentum is kept. One sweep a substep: of springs that pull at the
 * same points some may stay a little beyond. What is within its limits is not touched, so that a second sweep
 * over a state that the first one has put right changes nothing.
 *
 * Bias against the energy: such a wall would throw a spring back with the speed it came with; here it takes
 * it.
 *
 * Written for the lanes of the file that includes it; see model/kernels.h. */
#ifndef SBRI_STRAIN_LIMIT_H
#define SBRI_STRAIN_LIMIT_H

#include "math/vec3.h"
#include "solvers/motion.h"

/* Beyond a limit by less than this share is at it. */
#define SBRI_LIMIT_SLACK 2e-6f

static inline void sbri_shift_slot(
    const sbri_island_tick *t, uint32_t slot, sbf_vec3 way, sbf_vec3 velocity_change) {
  if (slot >= t->island->free_count) return;
  sbri_point *p = &t->positions[slot];
  *p = (sbri_point){p->x + way.x, p->y + way.y, p->z + way.z, 0};
  float *v = sbri_triple(t->velocities, slot);
  v[0] += velocity_change.x, v[SBRI_BLOCK] += velocity_change.y, v[2 * SBRI_BLOCK] += velocity_change.z;
}

/* One spring, of length `length`, to the length `bound`. */
static inline void sbri_limit_link(
    const sbri_island_tick *t, uint32_t a, uint32_t b, float length, float bound) {
  uint32_t free_count = t->island->free_count;
  float wa = a < free_count ? t->island->inverse_masses[a] : 0;
  float wb = b < free_count ? t->island->inverse_masses[b] : 0;
  if (!(wa + wb > 0) || !(length > 0)) return;
  const sbri_point *p = &t->positions[a], *q = &t->positions[b];
  sbf_vec3 n = sbri_scale(sbri_vec3(q->x - p->x, q->y - p->y, q->z - p->z), 1 / length);
  float speed =
      sbri_dot(sbri_sub(sbri_slot_velocity(t, t->velocities, b), sbri_slot_velocity(t, t->velocities, a)), n);
  bool leaving = length > bound ? speed > 0 : speed < 0;
  float way = (length - bound) / (wa + wb), taken = leaving ? speed / (wa + wb) : 0;
  sbri_shift_slot(t, a, sbri_scale(n, wa * way), sbri_scale(n, wa * taken));
  sbri_shift_slot(t, b, sbri_scale(n, -wb * way), sbri_scale(n, -wb * taken));
}

static inline void sbri_limit_strains(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  for (uint32_t block = 0; block < island->link_block_count; block++) {
    const sbri_link_block *link = &island->links[block];
    const sbri_link_limits *limits = &island->link_limits[block];
    const float *rests = t->rests ? t->rests + block * SBRI_BLOCK : link->rest;
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide3 p = sbri_wide_gather(t->positions, link->a + lane);
      sbri_wide3 q = sbri_wide_gather(t->positions, link->b + lane);
      sbri_wide x = q.x - p.x, y = q.y - p.y, z = q.z - p.z, one = sbri_wide_all(1), zero = sbri_wide_all(0);
      sbri_wide length = sbri_wide_sqrt(x * x + y * y + z * z), rest = sbri_wide_load(rests + lane);
      sbri_wide most = sbri_wide_load(limits->most + lane);
      sbri_wide longest = rest * (one + most), shortest = rest * (one + sbri_wide_load(limits->least + lane));
      sbri_mask long_one =
          (most > zero) & (length > longest * sbri_wide_all(1 + SBRI_LIMIT_SLACK)) & (rest > zero);
      sbri_mask short_one = length < shortest * sbri_wide_all(1 - SBRI_LIMIT_SLACK);
      if (!sbri_mask_any(long_one | short_one)) continue;
      float lengths[SBRI_LANES], bounds[SBRI_LANES];
      sbri_wide_store(lengths, length);
      sbri_wide_store(
          bounds, sbri_wide_select(long_one, longest, sbri_wide_select(short_one, shortest, length)));
      for (uint32_t i = 0; i < SBRI_LANES; i++) {
        uint32_t at = lane + i;
        if (lengths[i] == bounds[i] || (t->strengths && !(t->strengths[block * SBRI_BLOCK + at] > 0)))
          continue;
        sbri_limit_link(t, link->a[at], link->b[at], lengths[i], bounds[i]);
      }
    }
  }
}

#endif
