/* Symplectic Euler: v += h a(x), then x += h v. Second order where it counts (its energy oscillates and does
 * not drift), no damping of its own. Bias against the energy: a mode of frequency w runs fast by (w h)^2
 * / 24.
 *
 * Written for the lanes of the file that includes it; see model/kernels.h. */
#ifndef SBRI_SYMPLECTIC_H
#define SBRI_SYMPLECTIC_H

#include "solvers/finish.h"
#include "solvers/motion.h"

/* Whether what is stable changes within a tick by more than springs can. */
static inline bool sbri_may_stiffen(const sbri_island_tick *t) {
  bool gas = false;
  for (uint32_t b = 0; b < t->island->body_count; b++)
    gas = gas || t->model->bodies[t->island->bodies[b]].gas_pa != 0;
  return !t->island->substeps && (gas || t->island->tetrahedron_block_count > 0);
}

/* In fewer, what lies on the ground is pressed so hard against it by its weight that it would hop. */
enum { SBRI_MIN_TOUCHING_SUBSTEPS = 5 };

/* How many substeps share a damping of what nothing holds: on the ground, and where others may touch it, each
 * has its own, or bodies would creep by what falls between them. */
static inline uint32_t sbri_self_damp_every(const sbri_island_tick *t) {
  return t->meets || sbri_touches_any(t) ? 1 : SBRI_SELF_DAMP_EVERY;
}

/* Where tetrahedra or gases have stiffened beyond what the substep allows for, the rest of the tick is
 * divided anew; a tick never has more than the most substeps, however often it is. */
static inline void sbri_lanes_symplectic_tick(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  bool solid = island->tetrahedron_block_count > 0, may_stiffen = sbri_may_stiffen(t);
  uint32_t left = sbri_substeps_now(t, t->tick_s);
  float min = t->share * SBRI_MIN_TOUCHING_SUBSTEPS;
  if (solid && (float)left < min && !island->substeps && sbri_touches_any(t)) left = (uint32_t)ceilf(min);
  float h = t->tick_s / (float)left, rest = t->tick_s, self_s = 0, stretches[SBRI_BLOCK] = {0};
  uint32_t damp_every = sbri_self_damp_every(t);
  sbri_remember_held(t);
  for (uint32_t s = 1; left > 0; s++) {
    bool last = left == 1, looks = last || s % SBRI_LOOK_EVERY == 0;
    if (sbri_has_damping(island)) sbri_spread_velocities(t, 1 / t->tick_s);
    if (solid) sbri_tetrahedron_pass(t, looks);
    if (looks && !last && may_stiffen) {
      sbri_outer_look(t);
      uint32_t needed = sbri_substeps_now(t, rest),
               max = s < SBRI_MAX_STRAINED_SUBSTEPS ? SBRI_MAX_STRAINED_SUBSTEPS - s : 0;
      needed = needed < max ? needed : max;
      if (needed > left) left = needed, h = rest / (float)left;
    }
    bool damps = last || s % damp_every == 0;
    self_s += h;
    sbri_kick(t, h, damps ? self_s : 0, damp_every > 1, last, stretches);
    if (damps) self_s = 0;
    sbri_drift(t, h);
    rest = (float)--left * h;
    sbri_carry_held(t, left == 0 ? 1 : 1 - rest / t->tick_s);
    sbri_count_passes(t, 1);
    sbri_finish_substep(t, h);
  }
  sbri_keep_stretch(t, stretches);
}

#endif
