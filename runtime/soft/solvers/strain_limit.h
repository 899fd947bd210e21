/* Strain limits of springs: a spring longer or shorter than its limits is moved to them, and its rate of
 * change beyond them becomes 0 (Provot, Deformation Constraints in a Mass-Spring Model, 1995, moves the
 * points in the same way). An end that comes closer while it rotates about the other speeds up accordingly,
 * and the rigid body of a pinned end gets the reaction: linear and angular momentum are conserved. One sweep
 * per substep: springs with common points may stay slightly beyond their limits. Springs within their limits
 * are not changed, so a second sweep over a corrected state changes nothing.
 *
 * Bias against the energy: an elastic wall would return the spring's velocity; this one is inelastic.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_STRAIN_LIMIT_H
#define SBRI_STRAIN_LIMIT_H

#include "math/vec3.h"
#include "soft/solvers/motion.h"
#include "soft/solvers/pinned_impulse.h"

/* Relative tolerance of a limit. */
#define SBRI_LIMIT_SLACK 2e-6f
/* Maximum relative change of an angular velocity by a change of arm length. Prevents piles from exploding. */
#define SBRI_LIMIT_MAX_ANGULAR_CHANGE 0.2f

static inline void sbri_shift_slot(
    const sbri_island_tick *t, uint32_t slot, sbf_vec3 shift, sbf_vec3 velocity_change) {
  if (slot >= t->island->free_count) return;
  sbri_point *p = &t->positions[slot];
  *p = (sbri_point){p->x + shift.x, p->y + shift.y, p->z + shift.z, 0};
  float *v = sbri_triple(t->velocities, slot);
  v[0] += velocity_change.x, v[SBRI_BLOCK] += velocity_change.y, v[2 * SBRI_BLOCK] += velocity_change.z;
}

/* Applies an impulse to a free or pinned slot. */
static inline void sbri_apply_slot_impulse(const sbri_island_tick *t, uint32_t slot, sbf_vec3 impulse) {
  if (slot < t->island->free_count)
    sbri_shift_slot(t, slot, sbri_vec3(0, 0, 0), sbri_scale(impulse, t->island->inverse_masses[slot]));
  else
    sbri_pinned_apply_impulse(t, slot, impulse);
}

static inline sbf_vec3 sbri_reacted_velocity(const sbri_island_tick *t, uint32_t slot) {
  return sbri_add(sbri_slot_velocity(t, t->velocities, slot), sbri_pinned_velocity_change(t, slot));
}

/* Tangential impulse that conserves the angular momentum of an arm along n. `travel` is the shift of its ends
 * to the length `bound`, N s^2; `velocity` is their relative velocity. */
static inline sbf_vec3 sbri_limit_tangential_impulse(
    sbf_vec3 velocity, sbf_vec3 n, float travel, float sum, float bound) {
  float fraction = travel / bound, max = SBRI_LIMIT_MAX_ANGULAR_CHANGE / sum;
  if (!(bound > 0)) return sbri_vec3(0, 0, 0);
  fraction = fraction > max ? max : fraction < -max ? -max : fraction;
  return sbri_scale(sbri_add_scaled(velocity, n, -sbri_dot(velocity, n)), fraction);
}

/* Shifts a free or pinned slot immediately; the shift is in kg m. */
static inline void sbri_move_slot(const sbri_island_tick *t, uint32_t slot, sbf_vec3 shift) {
  if (slot < t->island->free_count)
    sbri_shift_slot(t, slot, sbri_scale(shift, t->island->inverse_masses[slot]), sbri_vec3(0, 0, 0));
  else
    sbri_pinned_apply_shift(t, slot, shift);
}

/* Moves a spring of length `length` to the length `bound`. Its pinned end may have been shifted. */
static inline void sbri_limit_link(
    const sbri_island_tick *t, uint32_t a, uint32_t b, float length, float bound) {
  uint32_t free_count = t->island->free_count;
  float wa = a < free_count ? t->island->inverse_masses[a] : 0;
  float wb = b < free_count ? t->island->inverse_masses[b] : 0;
  if (!(wa + wb > 0) || !(length > 0)) return;
  bool is_long = length > bound;
  sbf_vec3 edge = sbri_sub(sbri_shifted_position(t, b), sbri_shifted_position(t, a));
  length = sbri_length(edge);
  if (!(length > 0) || is_long != (length > bound)) return;
  sbf_vec3 n = sbri_scale(edge, 1 / length);
  sbf_vec3 relative_velocity = sbri_sub(sbri_reacted_velocity(t, b), sbri_reacted_velocity(t, a));
  float speed = sbri_dot(relative_velocity, n),
        inverse_mass = wa + wb + sbri_pinned_inverse_mass(t, a, n) + sbri_pinned_inverse_mass(t, b, n);
  bool leaving = is_long ? speed > 0 : speed < 0;
  float travel = (length - bound) / inverse_mass, stopping = leaving ? speed / inverse_mass : 0;
  sbf_vec3 impulse = sbri_sub(sbri_scale(n, stopping),
      sbri_limit_tangential_impulse(relative_velocity, n, travel, inverse_mass, bound));
  sbri_move_slot(t, a, sbri_scale(n, travel));
  sbri_move_slot(t, b, sbri_scale(n, -travel));
  sbri_apply_slot_impulse(t, a, impulse);
  sbri_apply_slot_impulse(t, b, sbri_scale(impulse, -1));
}

static inline void sbri_limit_strains(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  for (uint32_t block = 0; block < island->links.block_count; block++) {
    const sbri_link_block *link = &island->links.blocks[block];
    const sbri_link_limits *limits = &island->links.limits[block];
    const float *rests = t->springs.rests ? t->springs.rests + block * SBRI_BLOCK : link->rest;
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide3 p = sbri_wide_gather(t->positions, link->a + lane);
      sbri_wide3 q = sbri_wide_gather(t->positions, link->b + lane);
      sbri_wide x = q.x - p.x, y = q.y - p.y, z = q.z - p.z, one = sbri_wide_all(1), zero = sbri_wide_all(0);
      sbri_wide length = sbri_wide_sqrt(x * x + y * y + z * z), rest = sbri_wide_load(rests + lane);
      sbri_wide max = sbri_wide_load(limits->max + lane);
      sbri_wide longest = rest * (one + max), shortest = rest * (one + sbri_wide_load(limits->min + lane));
      sbri_mask long_one =
          (max > zero) & (length > longest * sbri_wide_all(1 + SBRI_LIMIT_SLACK)) & (rest > zero);
      sbri_mask short_one = length < shortest * sbri_wide_all(1 - SBRI_LIMIT_SLACK);
      if (!sbri_mask_any(long_one | short_one)) continue;
      float lengths[SBRI_LANES], bounds[SBRI_LANES];
      sbri_wide_store(lengths, length);
      sbri_wide_store(
          bounds, sbri_wide_select(long_one, longest, sbri_wide_select(short_one, shortest, length)));
      for (uint32_t i = 0; i < SBRI_LANES; i++) {
        uint32_t at = lane + i;
        if (lengths[i] == bounds[i] ||
            (t->springs.strengths && !(t->springs.strengths[block * SBRI_BLOCK + at] > 0)))
          continue;
        sbri_limit_link(t, link->a[at], link->b[at], lengths[i], bounds[i]);
      }
    }
  }
}

#endif
