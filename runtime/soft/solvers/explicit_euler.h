/* Explicit Euler: x += h v, v += h a, both from the state before the step. It is here to show how it fails:
 * an undamped mode of frequency w grows by sqrt(1 + (w h)^2) in every substep, which is a damping ratio of -w
 * h / 2. Springs with their own damping ratio z are stable while w h < 2 z. First order.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_EXPLICIT_EULER_H
#define SBRI_EXPLICIT_EULER_H

#include "soft/solvers/finish.h"
#include "soft/solvers/motion.h"

/* v += h a, with the accelerations found before. */
static inline void sbri_add_accelerations(const sbri_island_tick *t, float h) {
  sbri_wide step = sbri_wide_all(h);
  for (uint32_t i = 0; i < 3 * t->island->free_count; i += SBRI_LANES)
    sbri_wide_store(t->velocities + i,
        sbri_wide_load(t->velocities + i) + step * sbri_wide_load(t->scratch.accelerations + i));
}

static inline void sbri_lanes_explicit_euler_tick(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  uint32_t substeps = sbri_substeps_now(t, t->tick_s);
  float h = t->tick_s / (float)substeps;
  float stretches[SBRI_BLOCK] = {0};
  sbri_store_pinned_begin(t);
  sbri_mark_all_compressed(t);
  for (uint32_t s = 0; s < substeps; s++) {
    bool last = s + 1 == substeps;
    if (sbri_has_damping(island)) sbri_copy_velocities_to_points(t, 1 / t->tick_s);
    sbri_accelerate(t, h, last ? stretches : NULL);
    if (last) sbri_mark_all_compressed(t);
    if (t->reactions) sbri_react(t, h);
    sbri_drift(t, h);
    sbri_add_accelerations(t, h);
    sbri_decay_all(t, h);
    sbri_move_pinned(t, last ? 1 : (float)(s + 1) / (float)substeps);
    sbri_count_element_visits(t, 1);
    sbri_finish_substep(t, h);
  }
  sbri_store_stretch(t, stretches);
}

#endif
