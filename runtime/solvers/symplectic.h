/* Symplectic Euler: v += h a(x), then x += h v. Second order where it counts (its energy oscillates and does
 * not drift), no damping of its own. Bias against the energy: a mode of frequency w runs fast by (w h)^2
 * / 24.
 *
 * Written for the lanes of the file that includes it; see kernels/kernels.h. */
#ifndef SBRI_SYMPLECTIC_H
#define SBRI_SYMPLECTIC_H

#include "solvers/motion.h"
#include "solvers/volume_keep.h"

static inline void sbri_lanes_symplectic_tick(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  uint32_t substeps = sbri_stable_substeps(island, t->tick_s, *t->stretch);
  float h = t->tick_s / (float)substeps;
  float stretches[SBRI_BLOCK] = {0};
  size_t held = island->slot_count - island->free_count;
  memcpy(t->begins + island->free_count, t->positions + island->free_count, held * sizeof *t->begins);
  for (uint32_t s = 0; s < substeps; s++) {
    bool last = s + 1 == substeps;
    if (island->cell_damping) sbri_spread_velocities(t, 1 / t->tick_s);
    sbri_kick(t, h, last, stretches);
    for (uint32_t b = 0; b < island->body_count; b++)
      sbri_drift_body(t, &t->model->bodies[island->bodies[b]], h);
    sbri_carry_held(t, last ? 1 : (float)(s + 1) / (float)substeps);
    for (uint32_t b = 0; b < island->body_count; b++)
      if (t->model->bodies[island->bodies[b]].keeps_volume)
        sbri_volume_keep(t, &t->model->bodies[island->bodies[b]], h);
  }
  float greatest = 0;
  for (int lane = 0; lane < SBRI_BLOCK; lane++)
    greatest = stretches[lane] > greatest ? stretches[lane] : greatest;
  *t->stretch = greatest;
}

#endif
