/* Heun's method with error control. The positions of the corrector differ from those of the predictor by
 * h^2/2 a, the error of the predictor. A step is halved until that is below the limit for every point, and
 * doubled again when possible. Second order; the soft bodies of Blender use the same rule.
 *
 * Steps are the tick divided by powers of two and begin at multiples of themselves, so that the division does
 * not depend on rounding. Frame damping and media friction are exact decays of half a step before and after.
 * An undamped mode of frequency w grows by sqrt(1 + (w h)^4 / 4) per step, a damping ratio of -(w h)^3 / 8.
 * It needs some damping, and steps are limited to w h <= 1/2 even if the error allows more.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_HEUN_H
#define SBRI_HEUN_H

#include "soft/solvers/finish.h"
#include "soft/solvers/motion.h"

/* Error estimate: h^2/2 times the maximum acceleration, the distance between corrector and predictor. */
static inline float sbri_heun_error(const sbri_island_tick *t, float h) {
  float lanes[SBRI_BLOCK] = {0}, greatest = 0;
  for (uint32_t slot = 0; slot < t->island->free_count; slot += SBRI_LANES) {
    sbri_wide3 a = sbri_load3(sbri_const_triple(t->scratch.accelerations, slot));
    sbri_wide square = a.x * a.x + a.y * a.y + a.z * a.z;
    float *at = lanes + slot % SBRI_BLOCK;
    sbri_wide_store(at, sbri_wide_max(square, sbri_wide_load(at)));
  }
  for (int lane = 0; lane < SBRI_BLOCK; lane++) greatest = lanes[lane] > greatest ? lanes[lane] : greatest;
  return 0.5f * h * h * sqrtf(greatest);
}

/* Predictor: x + h v and v + h a. Old values are stored in `moves` and `older_velocities`. */
static inline void sbri_heun_predict(const sbri_island_tick *t, float h) {
  sbri_wide step = sbri_wide_all(h);
  for (uint32_t slot = 0; slot < t->island->free_count; slot += SBRI_LANES) {
    sbri_wide3 x = sbri_wide_load_points(t->positions + slot);
    sbri_wide3 v = sbri_load3(sbri_const_triple(t->velocities, slot));
    sbri_wide3 a = sbri_load3(sbri_const_triple(t->scratch.accelerations, slot));
    sbri_wide_store_points(t->scratch.moves + slot, x);
    sbri_store3(sbri_triple(t->scratch.older_velocities, slot), v);
    x.x = x.x + step * v.x, x.y = x.y + step * v.y, x.z = x.z + step * v.z;
    sbri_wide_store_points(t->positions + slot, x);
    v.x = v.x + step * a.x, v.y = v.y + step * a.y, v.z = v.z + step * a.z;
    sbri_store3(sbri_triple(t->velocities, slot), v);
  }
}

/* The corrector of a body with surface samples or loads, which needs all velocities at once. */
static inline void sbri_heun_correct_embedded(
    const sbri_island_tick *t, const sbri_body *body, float h, const sbri_point *first) {
  sbri_wide half = sbri_wide_all(0.5f), half_step = sbri_wide_all(0.5f * h), step = sbri_wide_all(h);
  const sbri_contact_rule rule = sbri_contact_rule_of(t, body, h);
  /* `older_velocities` become mean velocities, `velocities` the differences */
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    sbri_wide3 a0 = sbri_wide_load_points(first + slot);
    sbri_wide3 a1 = sbri_load3(sbri_const_triple(t->scratch.accelerations, slot));
    sbri_wide3 v0 = sbri_load3(sbri_const_triple(t->scratch.older_velocities, slot));
    sbri_wide3 v = sbri_load3(sbri_const_triple(t->velocities, slot));
    sbri_wide3 mean = {half * (v0.x + v.x), half * (v0.y + v.y), half * (v0.z + v.z)};
    v.x = v.x + half_step * (a1.x - a0.x) - mean.x;
    v.y = v.y + half_step * (a1.y - a0.y) - mean.y;
    v.z = v.z + half_step * (a1.z - a0.z) - mean.z;
    sbri_store3(sbri_triple(t->velocities, slot), v);
    sbri_store3(sbri_triple(t->scratch.older_velocities, slot), mean);
    sbri_wide_store_points(t->positions + slot, sbri_wide_load_points(t->scratch.moves + slot));
  }
  sbri_apply_impulses(t, body, t->scratch.older_velocities, &rule);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    sbri_wide3 x = sbri_wide_load_points(t->positions + slot);
    sbri_wide3 mean = sbri_load3(sbri_const_triple(t->scratch.older_velocities, slot));
    sbri_wide3 v = sbri_load3(sbri_const_triple(t->velocities, slot));
    if (t->contacts.near_ground[slot / SBRI_BLOCK]) /* of a body whose points are contact points */
      sbri_contact_move(&x, &mean,
          t->contacts.planes + 4 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK, &rule, slot);
    else
      x.x = x.x + step * mean.x, x.y = x.y + step * mean.y, x.z = x.z + step * mean.z;
    v.x = v.x + mean.x, v.y = v.y + mean.y, v.z = v.z + mean.z;
    sbri_wide_store_points(t->positions + slot, x);
    sbri_store3(sbri_triple(t->velocities, slot), v);
  }
}

/* Corrector: positions by the mean of both velocities, bounded by the ground, then velocities by the mean of
 * both accelerations. The predictor added h a0, so h/2 (a1 - a0) remains. `first` holds a0. */
static inline void sbri_heun_correct_body(
    const sbri_island_tick *t, const sbri_body *body, float h, const sbri_point *first) {
  sbri_wide half = sbri_wide_all(0.5f), half_step = sbri_wide_all(0.5f * h), step = sbri_wide_all(h);
  const sbri_contact_rule rule = sbri_contact_rule_of(t, body, h);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    sbri_wide3 x = sbri_wide_load_points(t->scratch.moves + slot), a0 = sbri_wide_load_points(first + slot);
    sbri_wide3 a1 = sbri_load3(sbri_const_triple(t->scratch.accelerations, slot));
    sbri_wide3 v0 = sbri_load3(sbri_const_triple(t->scratch.older_velocities, slot));
    sbri_wide3 v = sbri_load3(sbri_const_triple(t->velocities, slot));
    sbri_wide3 mean = {half * (v0.x + v.x), half * (v0.y + v.y), half * (v0.z + v.z)};
    v.x = v.x + half_step * (a1.x - a0.x);
    v.y = v.y + half_step * (a1.y - a0.y);
    v.z = v.z + half_step * (a1.z - a0.z);
    if (t->contacts.near_ground[block]) {
      sbri_wide3 bounded = mean;
      sbri_contact_move(&x, &bounded, t->contacts.planes + 4 * (block * SBRI_BLOCK) + lane, &rule, slot);
      v.x = v.x + (bounded.x - mean.x), v.y = v.y + (bounded.y - mean.y), v.z = v.z + (bounded.z - mean.z);
    } else {
      x.x = x.x + step * mean.x, x.y = x.y + step * mean.y, x.z = x.z + step * mean.z;
    }
    sbri_wide_store_points(t->positions + slot, x);
    sbri_store3(sbri_triple(t->velocities, slot), v);
  }
}

/* Stores the first accelerations before the second are computed. */
static inline void sbri_heun_store_first(const sbri_island_tick *t, sbri_point *first) {
  for (uint32_t slot = 0; slot < t->island->free_count; slot += SBRI_LANES)
    sbri_wide_store_points(first + slot, sbri_load3(sbri_const_triple(t->scratch.accelerations, slot)));
}

static inline void sbri_heun_evaluate(const sbri_island_tick *t, float h, float *stretches) {
  if (sbri_has_damping(t->island)) sbri_copy_velocities_to_points(t, 1 / t->tick_s);
  sbri_accelerate(t, h, stretches);
  sbri_count_element_visits(t, 1);
}

/* Tick in units of 2^-10 of its length: position and step size. */
enum { SBRI_HEUN_UNITS = SBRI_MAX_SUBSTEPS };

static inline void sbri_lanes_heun_tick(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  float unit = t->tick_s / (float)SBRI_HEUN_UNITS, stretches[SBRI_BLOCK] = {0};
  sbri_point *first = t->scratch.begins; /* of free points; the entries of pinned points are in use */
  uint32_t needed = sbri_substeps_now(t, t->tick_s), longest = SBRI_HEUN_UNITS, shortest = 1;
  if (needed < island->stepping.min_substeps && !island->stepping.substeps)
    needed = island->stepping.min_substeps;
  while (longest > 1 && SBRI_HEUN_UNITS / longest < needed) longest /= 2;
  while (island->stepping.max_substeps && shortest < longest &&
         SBRI_HEUN_UNITS / shortest > island->stepping.max_substeps)
    shortest *= 2; /* stability bounds the step */
  sbri_store_pinned_begin(t);
  sbri_mark_all_compressed(t);
  sbri_heun_evaluate(t, unit * (float)longest, NULL);
  for (uint32_t done = 0, step = longest; done < SBRI_HEUN_UNITS;) {
    if (step > shortest && !island->stepping.substeps &&
        sbri_heun_error(t, unit * (float)step) > t->step_error_m) {
      step /= 2;
      continue;
    }
    float h = unit * (float)step;
    sbri_decay_all(t, 0.5f * h);
    if (sbri_has_damping(island)) sbri_heun_evaluate(t, h, NULL); /* damping depends on velocities */
    sbri_heun_store_first(t, first);
    sbri_heun_predict(t, h);
    done += step;
    sbri_move_pinned(t, (float)done / (float)SBRI_HEUN_UNITS);
    sbri_heun_evaluate(t, h, NULL);
    for (uint32_t b = 0; b < island->body_count; b++) {
      const sbri_body *body = &t->model->bodies[island->bodies[b]];
      if (sbri_has_impulses(t, body))
        sbri_heun_correct_embedded(t, body, h, first);
      else
        sbri_heun_correct_body(t, body, h, first);
    }
    sbri_decay_all(t, 0.5f * h);
    if (island->tetrahedra.block_count > 0) sbri_update_compression(t);
    sbri_finish_substep(t, h);
    if (t->reactions) sbri_react_at_end(t, h);
    sbri_heun_evaluate(t, h, done == SBRI_HEUN_UNITS ? stretches : NULL);
    while (step < longest && done % (2 * step) == 0 &&
           sbri_heun_error(t, 2 * unit * (float)step) <= t->step_error_m)
      step *= 2;
  }
  sbri_store_stretch(t, stretches);
}

#endif
