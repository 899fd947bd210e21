/* Reactions of an island on the rigid bodies that it is pinned to: forces on pinned points, summed over
 * substeps as impulses and moments. They are the opposite of the forces on the free points, at the same
 * positions, so that momentum is conserved.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_REACTION_H
#define SBRI_REACTION_H

#include "math/lane_sums.h"
#include "math/vec3.h"
#include "soft/solvers/external_forces.h"
#include "soft/solvers/region_forces.h"
#include "soft/solvers/spring_forces.h"
#include "soft/solvers/tetrahedron_forces.h"

static inline void sbri_react_at(const sbri_island_tick *t, uint32_t slot, sbf_vec3 force, float h) {
  int32_t attachment = t->island->pins.rigid_bodies[slot - t->island->free_count];
  if (attachment < 0) return;
  sbri_reaction *r = &t->reactions[attachment];
  const sbri_point *at = &t->positions[slot];
  sbf_vec3 impulse = sbri_scale(force, h), arm = sbri_sub(sbri_vec3(at->x, at->y, at->z), r->about);
  r->impulse = sbri_add(r->impulse, impulse);
  r->moment = sbri_add(r->moment, sbri_cross(arm, impulse));
}

/* Slot of the pinned end of a spring with one pinned end, and the force on it, as in sbri_spring_forces. The
 * spring may have yielded or split. */
static inline uint32_t sbri_pinned_spring_force(const sbri_island_tick *t, uint32_t number, sbf_vec3 *force) {
  const sbri_island *island = t->island;
  const sbfi_spring *s = &island->springs.at[number];
  uint32_t a = s->a, b = s->b;
  if (t->springs.rests) { /* the end may be a split point */
    uint32_t at = island->links.of_spring[number];
    a = island->links.blocks[at / SBRI_BLOCK].a[at % SBRI_BLOCK],
    b = island->links.blocks[at / SBRI_BLOCK].b[at % SBRI_BLOCK];
  }
  uint32_t pinned = a >= island->free_count ? a : b, free = a + b - pinned;
  const sbri_point *x = &t->positions[pinned], *y = &t->positions[free];
  sbf_vec3 d = {y->x - x->x, y->y - x->y, y->z - x->z};
  float square = sbri_dot(d, d) + SBRI_LENGTH_FLOOR, k = s->stiffness_n_m, damping = s->damping_ns_m;
  float rest = s->rest_length_m;
  if (t->springs.rests) {
    uint32_t link = island->links.of_spring[number];
    rest = t->springs.rests[link], k *= t->springs.strengths[link], damping *= t->springs.strengths[link];
  }
  float fraction = k - k * rest / sqrtf(square);
  if (fraction < 0) fraction -= fraction * s->slack;
  if (damping > 0) {
    const sbri_point *v = &t->scratch.velocity_points[pinned], *w = &t->scratch.velocity_points[free];
    fraction += damping * sbri_dot(sbri_vec3(w->x - v->x, w->y - v->y, w->z - v->z), d) / square;
  }
  *force = sbri_scale(d, fraction);
  return pinned;
}

static inline void sbri_react_springs(const sbri_island_tick *t, float h) {
  const sbri_island *island = t->island;
  for (uint32_t i = 0; i < island->springs.pinned_count; i++) {
    sbf_vec3 force;
    uint32_t pinned = sbri_pinned_spring_force(t, island->springs.pinned[i], &force);
    sbri_react_at(t, pinned, force, h);
  }
}

static inline sbf_vec3 sbri_point_vec3(const sbri_point *p) {
  return sbri_vec3(p->x, p->y, p->z);
}

/* Adds reactions from the forces that were just computed for a substep of h, before anything moves. */
static inline void sbri_react(const sbri_island_tick *t, float h) {
  const sbri_island *island = t->island;
  const bool flows = t->springs.rests != NULL, damped = island->cells.damping != NULL;
  if (flows) sbri_react_springs(t, h);
  for (uint32_t first = island->free_count; first < island->slot_count; first += SBRI_LANES) {
    sbri_point sums[SBRI_LANES] = {{0, 0, 0, 0}};
    sbri_wide3 x = sbri_wide_load_points(t->positions + first);
    if (!flows)
      sbri_wide_store_points(sums, damped ? sbri_spring_forces(t, first, x, SBRI_DAMPED, NULL)
                                          : sbri_spring_forces(t, first, x, 0, NULL));
    for (uint32_t slot = first; slot < first + SBRI_LANES; slot++) {
      sbf_vec3 sum = sbri_point_vec3(&sums[slot - first]);
      if (sbri_has_element_forces(island))
        sum = sbri_add(sum, sbri_point_vec3(&t->scratch.element_forces[slot]));
      if (t->scratch.external_forces) sum = sbri_add(sum, sbri_point_vec3(&t->scratch.external_forces[slot]));
      sbri_react_at(t, slot, sum, h);
    }
  }
}

/* Sums for islands of springs whose pinned ends belong to one rigid body: internal forces cancel, so the
 * forces on free points give the reaction. Summed in lanes of eight, so that the result is the same for any
 * SIMD width. */
typedef sbri_lane_sums
    sbri_spring_sums; /* force and torque on the free points about reaction.about, N and N m */

static inline bool sbri_are_spring_sums_complete(const sbri_island_tick *t) {
  return t->island->pins.responses && !t->scratch.external_forces && !sbri_has_element_forces(t->island);
}

/* Adds a group of lanes at x with accelerations a. */
static inline void sbri_add_spring_forces(
    const sbri_island_tick *t, uint32_t slot, sbri_wide3 x, sbri_wide3 a, sbri_spring_sums *sums) {
  const sbf_vec3 about = t->reactions[t->island->pins.attachments[0]].about;
  sbri_wide m = sbri_wide_load(t->island->masses + slot),
            g = sbri_wide_load(t->island->gravity_scales + slot);
  sbri_wide3 f = {m * (a.x - g * sbri_wide_all(t->environment.gravity.x)),
      m * (a.y - g * sbri_wide_all(t->environment.gravity.y)),
      m * (a.z - g * sbri_wide_all(t->environment.gravity.z))};
  sbri_wide3 r = {x.x - sbri_wide_all(about.x), x.y - sbri_wide_all(about.y), x.z - sbri_wide_all(about.z)};
  sbri_lane_sums_add(sums, slot % SBRI_BLOCK, r, f);
}

static inline void sbri_apply_spring_reactions(
    const sbri_island_tick *t, const sbri_spring_sums *sums, float h) {
  sbri_reaction *r = &t->reactions[t->island->pins.attachments[0]];
  r->impulse = sbri_add_scaled(r->impulse, sbri_lanes_force(sums), -h);
  r->moment = sbri_add_scaled(r->moment, sbri_lanes_moment(sums), -h);
}

/* Reactions of integrators without forces, at the end of the substep. */
static inline void sbri_react_at_end(const sbri_island_tick *t, float h) {
  if (sbri_has_damping(t->island)) sbri_copy_velocities_to_points(t, 1 / t->tick_s);
  if (t->scratch.external_forces) sbri_compute_external_forces(t, h);
  if (t->island->tetrahedra.block_count > 0) sbri_compute_tetrahedron_forces(t, NULL);
  if (t->island->regions.block_count > 0) sbri_compute_region_forces(t);
  sbri_react(t, h);
}

#endif
