/* Compression limit of tetrahedra. An element below a tenth of its volume at the end of a substep is brought
 * back to that bound along the gradient of J, weighted by the inverse masses of its corners, and its rate of
 * compression becomes 0. Momentum is conserved. Inverted elements recover by a limited step per substep.
 *
 * Pinned corners do not move, but their rigid bodies receive the reaction. Without it, a light bone would
 * push soft bodies like an infinite mass and add energy without bound.
 *
 * The energy itself is finite and smooth through J = 0, so nothing bursts there. But thin tips that strike
 * the ground first, with the mass of a body behind them, would be inverted. Bias against the energy: none
 * above the bound; at the bound, an inelastic wall.
 *
 * The limit is checked only in blocks in which the last evaluation found an element below half its volume.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_COMPRESSION_H
#define SBRI_COMPRESSION_H

#include "soft/solvers/pinned_impulse.h"
#include "soft/solvers/soft_contacts.h"
#include "soft/solvers/strain_limit.h"
#include "soft/solvers/tetrahedron_forces.h"

#define SBRI_MIN_VOLUME_RATIO 0.1f
/* Maximum increase of J per substep, and maximum displacement of a corner as a fraction of its element's
 * size. Prevents piles from exploding. */
#define SBRI_COMPRESSION_STEP 0.1f
/* Iterations per substep, because neighbouring elements interact. */
enum { SBRI_COMPRESSION_SWEEPS = 8 };
/* Interval of checks in substeps; the last substep is always checked. */
enum { SBRI_CHECK_INTERVAL = 4 };

static inline sbf_vec3 sbri_edge_to(const sbri_island_tick *t, uint32_t from, uint32_t to) {
  const sbri_point *p = &t->positions[from], *q = &t->positions[to];
  return sbri_vec3(q->x - p->x, q->y - p->y, q->z - p->z);
}

static inline void sbri_limit_compression(
    const sbri_island_tick *t, const sbri_tetrahedron_block *block, uint32_t lane) {
  uint32_t slots[4];
  for (int k = 0; k < 4; k++) slots[k] = block->corners[k][lane];
  sbf_vec3 d1 = sbri_edge_to(t, slots[0], slots[1]), d2 = sbri_edge_to(t, slots[0], slots[2]),
           d3 = sbri_edge_to(t, slots[0], slots[3]), gradients[4];
  float s = block->inverse_volume[lane];
  gradients[1] = sbri_scale(sbri_cross(d2, d3), s);
  gradients[2] = sbri_scale(sbri_cross(d3, d1), s);
  gradients[3] = sbri_scale(sbri_cross(d1, d2), s);
  gradients[0] = sbri_scale(sbri_add(sbri_add(gradients[1], gradients[2]), gradients[3]), -1);
  float missing = SBRI_MIN_VOLUME_RATIO - sbri_dot(d1, gradients[1]), sum = 0, pinned_sum = 0, rate = 0,
        steepest = 0;
  if (!(missing > 0)) return;
  missing = missing < SBRI_COMPRESSION_STEP ? missing : SBRI_COMPRESSION_STEP;
  for (int k = 0; k < 4; k++) {
    float w = slots[k] < t->island->free_count ? t->island->inverse_masses[slots[k]] : 0;
    float square = sbri_dot(gradients[k], gradients[k]);
    sum += w * square;
    steepest = w * w * square > steepest ? w * w * square : steepest;
    pinned_sum += sbri_pinned_inverse_mass(t, slots[k], gradients[k]);
    rate += sbri_dot(gradients[k], sbri_slot_velocity(t, t->velocities, slots[k]));
    rate += sbri_dot(gradients[k], sbri_pinned_velocity_change(t, slots[k]));
  }
  if (!(sum > 0)) return;
  float fraction = missing / sum, max = SBRI_COMPRESSION_STEP * t->island->stability.cell_m,
        travel = fraction * sqrtf(steepest);
  if (max > 0 && travel > max) fraction *= max / travel;
  float rate_change = rate < 0 ? -rate / (sum + pinned_sum) : 0;
  if (travel > max) rate_change = 0; /* too flat for a meaningful gradient */
  for (int k = 0; k < 4; k++) {
    if (slots[k] >= t->island->free_count) {
      sbri_pinned_apply_impulse(t, slots[k], sbri_scale(gradients[k], rate_change));
      continue;
    }
    sbf_vec3 g = sbri_scale(gradients[k], t->island->inverse_masses[slots[k]]);
    sbri_shift_slot(t, slots[k], sbri_scale(g, fraction), sbri_scale(g, rate_change));
  }
}

/* J of a group of lanes; 1 in empty lanes. */
SBRI_INLINE sbri_wide sbri_ratio_of(
    const sbri_island_tick *t, const sbri_tetrahedron_block *block, uint32_t lane) {
  sbri_wide3 x0 = sbri_wide_gather(t->positions, block->corners[0] + lane), d[3];
  for (int k = 0; k < 3; k++)
    d[k] = sbri_wide3_sub(sbri_wide_gather(t->positions, block->corners[k + 1] + lane), x0);
  sbri_wide ratio =
      sbri_wide3_dot(d[0], sbri_wide3_cross(d[1], d[2])) * sbri_wide_load(block->inverse_volume + lane);
  sbri_mask real = sbri_wide_load(block->shear + lane) > sbri_wide_all(0);
  return sbri_wide_select(real, ratio, sbri_wide_all(1));
}

/* Whether an element is compressed enough for the limit to be checked. */
static inline bool sbri_is_compressed(const sbri_island_tick *t) {
  return t->island->tetrahedra.dense_count > 0 && *t->solids.min_ratio < SBRI_COMPRESSION_NEAR;
}

/* Marks all blocks as compressed, if it is not known which are. */
static inline void sbri_mark_all_compressed(const sbri_island_tick *t) {
  if (sbri_is_compressed(t)) memset(t->solids.compressed, 1, t->island->tetrahedra.dense_count);
}

/* Updates J for integrators that do not compute it. */
static inline void sbri_update_compression(const sbri_island_tick *t) {
  sbri_tetrahedron_watch watch;
  sbri_watch_begin(&watch);
  for (uint32_t b = 0; b < t->island->tetrahedra.dense_count; b++)
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      float *min = watch.min_ratio + lane;
      sbri_wide_store(min, sbri_wide_min(sbri_ratio_of(t, &t->solids.blocks[b], lane), sbri_wide_load(min)));
    }
  *t->solids.min_ratio = sbri_watch_min_ratio(&watch);
  sbri_mark_all_compressed(t);
}

/* One iteration over the blocks that are marked as compressed; returns whether any element was below the
 * limit. Reads all lanes of a block before it moves any, because some blocks share points between lanes.
 * Stores soft contacts before the first change unless `*contacts_stored`; most substeps need none. */
static inline bool sbri_limit_compression_sweep(const sbri_island_tick *t, bool *contacts_stored) {
  const uint8_t *marks_of = t->solids.compressed, *end = marks_of + t->island->tetrahedra.dense_count;
  bool any_compressed = false;
  for (const uint8_t *at = marks_of; (at = memchr(at, 1, (size_t)(end - at))) != NULL; at++) {
    const sbri_tetrahedron_block *block = &t->solids.blocks[at - marks_of];
    float marks[SBRI_BLOCK];
    bool any = false;
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_mask compressed = sbri_ratio_of(t, block, lane) < sbri_wide_all(SBRI_MIN_VOLUME_RATIO);
      sbri_wide_store(marks + lane, sbri_wide_select(compressed, sbri_wide_all(1), sbri_wide_all(0)));
      any = any || sbri_mask_any(compressed);
    }
    for (uint32_t k = 0; any && !*contacts_stored && k < t->island->body_count; k++)
      sbri_soft_contacts_store(t, &t->model->bodies[t->island->bodies[k]]);
    *contacts_stored = *contacts_stored || any;
    for (uint32_t lane = 0; any && lane < SBRI_BLOCK; lane++)
      if (marks[lane] != 0) sbri_limit_compression(t, block, lane);
    any_compressed = any_compressed || any;
  }
  return any_compressed;
}

#endif
