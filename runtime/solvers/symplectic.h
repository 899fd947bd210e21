/* Symplectic Euler: v += h a(x), then x += h v. Second order where it counts (its energy oscillates and does
 * not drift), no damping of its own. Bias against the energy: a mode of frequency w runs fast by (w h)^2
 * / 24.
 *
 * Written for the lanes of the file that includes it; see kernels/kernels.h. */
#ifndef SBRI_SYMPLECTIC_H
#define SBRI_SYMPLECTIC_H

#include "solvers/finish.h"
#include "solvers/motion.h"

static inline void sbri_lanes_symplectic_tick(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  uint32_t substeps = sbri_stable_substeps(island, t->tick_s, *t->stretch);
  float h = t->tick_s / (float)substeps;
  float stretches[SBRI_BLOCK] = {0};
  sbri_remember_held(t);
  for (uint32_t s = 0; s < substeps; s++) {
    bool last = s + 1 == substeps;
    if (island->cell_damping) sbri_spread_velocities(t, 1 / t->tick_s);
    sbri_kick(t, h, last, stretches);
    sbri_drift(t, h);
    sbri_carry_held(t, last ? 1 : (float)(s + 1) / (float)substeps);
    sbri_finish_substep(t, h);
  }
  sbri_keep_stretch(t, stretches);
}

#endif
