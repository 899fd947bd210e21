/* Symplectic (semi-implicit) Euler: v += h a(x), then x += h v. Its energy oscillates but does not drift, and
 * it adds no damping. A mode of angular frequency w runs fast by the fraction (w h)^2 / 24 (Hairer, Lubich,
 * Wanner, Geometric Numerical Integration).
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_SYMPLECTIC_H
#define SBRI_SYMPLECTIC_H

#include "soft/solvers/finish.h"
#include "soft/solvers/motion.h"

/* Whether the stable step may shrink within a tick: tetrahedra and gases stiffen under compression. */
static inline bool sbri_may_stiffen(const sbri_island_tick *t) {
  bool gas = false;
  for (uint32_t b = 0; b < t->island->body_count; b++)
    gas = gas || t->model->bodies[t->island->bodies[b]].gas.pressure_pa != 0;
  return !t->island->stepping.substeps && (gas || t->island->tetrahedra.block_count > 0);
}

/* Minimum number of substeps of a body in contact. With fewer, its weight presses it into the ground far
 * enough to make it hop. */
enum { SBRI_MIN_TOUCHING_SUBSTEPS = 5 };

/* Number of substeps between two dampings of bodies without pins. In contact every substep is damped;
 * otherwise bodies creep by the velocity that gravity adds in between. */
static inline uint32_t sbri_self_damp_every(const sbri_island_tick *t) {
  return t->collides || sbri_soft_contacts_any(t) ? 1 : SBRI_SELF_DAMP_EVERY;
}

/* Maximum distance that a point may travel between two checks, in cells, for the marks of compressed blocks
 * to remain valid until the next check. An element of half its volume then stays above the limit. */
#define SBRI_MARKED_TRAVEL 0.1f

/* After a check, before substeps of h: marks all blocks as compressed if any point is too fast for the
 * present marks. */
static inline void sbri_keep_marks_if_slow(const sbri_island_tick *t, float h) {
  float travel = SBRI_CHECK_INTERVAL * h * sbri_impact_speed_bound(t);
  if (t->fraction < 1 || !(travel <= SBRI_MARKED_TRAVEL * t->island->stability.cell_m))
    sbri_mark_all_compressed(t);
}

/* Steps the island through a tick. If tetrahedra or gases stiffen beyond the stability limit of the substep,
 * divides the rest of the tick again. The total is at most SBRI_MAX_STRAINED_SUBSTEPS. */
static inline void sbri_lanes_symplectic_tick(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  bool solid = island->tetrahedra.block_count > 0, may_stiffen = sbri_may_stiffen(t);
  uint32_t left = sbri_substeps_now(t, t->tick_s);
  float min = t->fraction * SBRI_MIN_TOUCHING_SUBSTEPS;
  if (solid && (float)left < min && !island->stepping.substeps && sbri_soft_contacts_any(t))
    left = (uint32_t)ceilf(min);
  float h = t->tick_s / (float)left, rest = t->tick_s, self_s = 0, stretches[SBRI_BLOCK] = {0};
  uint32_t damp_every = sbri_self_damp_every(t);
  sbri_store_pinned_begin(t);
  sbri_mark_all_compressed(t);
  sbri_divided_begin(t);
  bool divided = sbri_are_forces_divided(t);
  for (uint32_t s = 1; left > 0; s++) {
    bool last = left == 1, checks = last || s % SBRI_CHECK_INTERVAL == 0;
    if (sbri_has_damping(island)) sbri_copy_velocities_to_points(t, 1 / t->tick_s);
    if (divided)
      sbri_divided_tetrahedron_pass(t, checks);
    else if (solid)
      sbri_tetrahedron_pass(t, checks);
    if (checks && !last && may_stiffen) {
      sbri_update_gas_stiffness(t);
      uint32_t needed = sbri_substeps_now(t, rest),
               max = s < SBRI_MAX_STRAINED_SUBSTEPS ? SBRI_MAX_STRAINED_SUBSTEPS - s : 0;
      needed = needed < max ? needed : max;
      if (needed > left) left = needed, h = rest / (float)left;
    }
    if (checks && sbri_is_compressed(t)) sbri_keep_marks_if_slow(t, h);
    bool damps = last || s % damp_every == 0;
    self_s += h;
    bool drifts = sbri_drifts_with_kick(t, damps ? self_s : 0);
    sbri_kick(t, h, damps ? self_s : 0, damp_every > 1, last, drifts, stretches);
    if (damps) self_s = 0;
    if (!drifts) sbri_drift(t, h);
    rest = (float)--left * h;
    sbri_move_pinned(t, left == 0 ? 1 : 1 - rest / t->tick_s);
    sbri_count_element_visits(t, 1);
    sbri_finish_substep(t, h);
  }
  sbri_store_stretch(t, stretches);
}

#endif
