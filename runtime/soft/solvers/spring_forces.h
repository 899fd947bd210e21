/* Forces of springs, gathered point by point. Each of the eight points of a block sums its own springs, so
 * nothing is written twice, the order of sums is fixed, and the two ends of a spring receive exactly opposite
 * forces.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_SPRING_FORCES_H
#define SBRI_SPRING_FORCES_H

#include "soft/solvers/scheme.h"

/* Added to squared lengths, m^2, to avoid division by 0. Below the resolution of single precision. */
#define SBRI_LENGTH_FLOOR 1e-30f

static inline sbri_wide3 sbri_load3(const float *block) {
  return (sbri_wide3){
      sbri_wide_load(block), sbri_wide_load(block + SBRI_BLOCK), sbri_wide_load(block + 2 * SBRI_BLOCK)};
}
static inline void sbri_store3(float *block, sbri_wide3 v) {
  sbri_wide_store(block, v.x);
  sbri_wide_store(block + SBRI_BLOCK, v.y);
  sbri_wide_store(block + 2 * SBRI_BLOCK, v.z);
}

/* Address of a group of lanes in arrays of blocks of three by eight, such as velocities. */
static inline float *sbri_triple(float *blocks, uint32_t slot) {
  return blocks + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}
static inline const float *sbri_const_triple(const float *blocks, uint32_t slot) {
  return blocks + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}

/* Whether springs, tetrahedra or regions have their own damping, which reads velocity_points. */
static inline bool sbri_has_damping(const sbri_island *island) {
  return island->cells.damping || island->tetrahedra.damping || island->regions.have_damping;
}

/* Copies velocities to velocity_points. `rate` is 1 / tick length. */
static inline void sbri_copy_velocities_to_points(const sbri_island_tick *t, float rate) {
  const sbri_island *island = t->island;
  for (uint32_t slot = 0; slot < island->free_count; slot += SBRI_LANES)
    sbri_wide_store_points(
        t->scratch.velocity_points + slot, sbri_load3(sbri_const_triple(t->velocities, slot)));
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++) {
    const sbri_point *from = &t->scratch.begins[slot], *to = &t->targets[slot];
    t->scratch.velocity_points[slot] =
        (sbri_point){(to->x - from->x) * rate, (to->y - from->y) * rate, (to->z - from->z) * rate, 0};
  }
}

/* Variants of the force loop, fixed at compile time so that the common ones do no extra work. */
enum {
  SBRI_DAMPED = 1,  /* springs have damping or slack */
  SBRI_TRACKED = 2, /* the maximum stretch of the springs is measured */
  SBRI_FLOWING = 4, /* rest lengths are state (yield), and springs may be torn */
  SBRI_FORCE_KINDS = 8
};

static inline int sbri_force_kind(const sbri_island_tick *t, bool tracked) {
  return (t->island->cells.damping ? SBRI_DAMPED : 0) | (tracked ? SBRI_TRACKED : 0) |
         (t->springs.rests ? SBRI_FLOWING : 0);
}

/* Spring force on each point of a group of lanes, N: the sum of k (1 - L / |d|) d over its springs.
 * `stretches` (8 values) receives the maximum stretch if tracked. */
SBRI_INLINE sbri_wide3 sbri_spring_forces(
    const sbri_island_tick *t, uint32_t slot, sbri_wide3 x, int kind, float *stretches) {
  const sbri_island *island = t->island;
  const bool damped = kind & SBRI_DAMPED, track = kind & SBRI_TRACKED, flowing = kind & SBRI_FLOWING;
  uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
  sbri_wide3 f = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)}, v = f;
  sbri_wide greatest = track ? sbri_wide_load(stretches + lane) : f.x;
  if (damped) v = sbri_wide_load_points(t->scratch.velocity_points + slot);
  for (uint32_t c = island->cells.begins[block]; c < island->cells.ends[block]; c++) {
    const sbri_spring_cell *cell = &island->cells.at[c];
    sbri_wide3 other = sbri_wide_gather(t->positions, cell->others + lane);
    sbri_wide dx = other.x - x.x, dy = other.y - x.y, dz = other.z - x.z;
    sbri_wide square = dx * dx + dy * dy + dz * dz + sbri_wide_all(SBRI_LENGTH_FLOOR);
    sbri_wide k = sbri_wide_load(cell->stiffness + lane),
              rest_force = sbri_wide_load(cell->rest_force + lane);
    sbri_wide strength = sbri_wide_all(1);
    if (flowing) {
      const uint32_t *links = island->cells.links + c * SBRI_BLOCK + lane;
      strength = sbri_wide_gather_floats(t->springs.strengths, links);
      k = k * strength;
      rest_force = k * sbri_wide_gather_floats(t->springs.rests, links);
    }
    sbri_wide s = k - rest_force / sbri_wide_sqrt(square);
    if (track) { /* goal springs have rest length 0 and do not count */
      sbri_wide fraction = s / sbri_wide_max(k, sbri_wide_all(1e-20f));
      greatest = sbri_wide_select(rest_force > sbri_wide_all(0), sbri_wide_max(fraction, greatest), greatest);
    }
    if (damped && island->cells.slack) {
      size_t index = (size_t)c * SBRI_BLOCK + lane; /* links move with points that split */
      sbri_wide slack = flowing ? sbri_wide_gather_floats(island->links.slack, island->cells.links + index)
                                : sbri_wide_load(island->cells.slack + index);
      s = s - sbri_wide_min(s, sbri_wide_all(0)) * slack;
    }
    if (damped) {
      sbri_wide3 w = sbri_wide_gather(t->scratch.velocity_points, cell->others + lane);
      sbri_wide rate = (w.x - v.x) * dx + (w.y - v.y) * dy + (w.z - v.z) * dz;
      sbri_wide damping = sbri_wide_load(island->cells.damping + c * SBRI_BLOCK + lane);
      if (flowing) damping = damping * strength;
      s = s + damping * rate / square;
    }
    f.x = f.x + s * dx;
    f.y = f.y + s * dy;
    f.z = f.z + s * dz;
  }
  if (track) sbri_wide_store(stretches + lane, greatest);
  return f;
}

static inline bool sbri_has_element_forces(const sbri_island *island) {
  return island->tetrahedra.block_count > 0 || island->regions.block_count > 0;
}

/* Acceleration of each point of a group of lanes, m/s^2: all forces except frame damping and media friction.
 */
SBRI_INLINE sbri_wide3 sbri_acceleration(
    const sbri_island_tick *t, uint32_t slot, sbri_wide3 x, int kind, float *stretches) {
  sbri_wide3 f = sbri_spring_forces(t, slot, x, kind, stretches);
  if (t->scratch.external_forces) {
    sbri_wide3 more = sbri_wide_load_points(t->scratch.external_forces + slot);
    f.x = f.x + more.x, f.y = f.y + more.y, f.z = f.z + more.z;
  }
  if (sbri_has_element_forces(t->island)) {
    sbri_wide3 more = sbri_wide_load_points(t->scratch.element_forces + slot);
    f.x = f.x + more.x, f.y = f.y + more.y, f.z = f.z + more.z;
  }
  sbri_wide w = sbri_wide_load(t->island->inverse_masses + slot);
  sbri_wide g = sbri_wide_load(t->island->gravity_scales + slot);
  return (sbri_wide3){f.x * w + g * sbri_wide_all(t->environment.gravity.x),
      f.y * w + g * sbri_wide_all(t->environment.gravity.y),
      f.z * w + g * sbri_wide_all(t->environment.gravity.z)};
}

/* Calls CALL with the kind of forces as a compile-time constant. */
#define SBRI_FOR_FORCE_KIND(kind, CALL)                                                                      \
  switch (kind) {                                                                                            \
  case 0:                                                                                                    \
    CALL(0);                                                                                                 \
    break;                                                                                                   \
  case 1:                                                                                                    \
    CALL(1);                                                                                                 \
    break;                                                                                                   \
  case 2:                                                                                                    \
    CALL(2);                                                                                                 \
    break;                                                                                                   \
  case 3:                                                                                                    \
    CALL(3);                                                                                                 \
    break;                                                                                                   \
  case 4:                                                                                                    \
    CALL(4);                                                                                                 \
    break;                                                                                                   \
  case 5:                                                                                                    \
    CALL(5);                                                                                                 \
    break;                                                                                                   \
  case 6:                                                                                                    \
    CALL(6);                                                                                                 \
    break;                                                                                                   \
  default:                                                                                                   \
    CALL(7);                                                                                                 \
  }

#endif
