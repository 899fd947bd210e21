/* Forces of springs, gathered point by point: each of the eight points of a block sums its own springs, so
 * that nothing is written twice, the order of sums is fixed, and the two ends of a spring receive exactly
 * opposite forces. Written for the lanes of the file that includes it; see model/kernels.h. */
#ifndef SBRI_SPRING_FORCES_H
#define SBRI_SPRING_FORCES_H

#include "solvers/scheme.h"

/* Keeps a length from being 0, in m^2: far below what single precision can tell from 0 between two points. */
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

/* Of a group of lanes in arrays that stand in blocks of three by eight, as velocities do. */
static inline float *sbri_triple(float *blocks, uint32_t slot) {
  return blocks + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}
static inline const float *sbri_const_triple(const float *blocks, uint32_t slot) {
  return blocks + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}

/* Whether springs, tetrahedra or regions have damping of their own, which goes by velocity_points. */
static inline bool sbri_has_damping(const sbri_island *island) {
  return island->cell_damping || island->tetrahedron_damping || island->region_damping;
}

/* The velocities as points, for that damping; `rate` is one over the tick's length. */
static inline void sbri_spread_velocities(const sbri_island_tick *t, float rate) {
  const sbri_island *island = t->island;
  for (uint32_t slot = 0; slot < island->free_count; slot += SBRI_LANES)
    sbri_wide_store_points(t->velocity_points + slot, sbri_load3(sbri_const_triple(t->velocities, slot)));
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++) {
    const sbri_point *from = &t->begins[slot], *to = &t->targets[slot];
    t->velocity_points[slot] =
        (sbri_point){(to->x - from->x) * rate, (to->y - from->y) * rate, (to->z - from->z) * rate, 0};
  }
}

/* What the forces on a group of lanes ask for; known where the function is made, so that the common ones
 * carry no more than they need. */
enum {
  SBRI_DAMPED = 1,  /* springs have damping of their own, or slack */
  SBRI_TRACKED = 2, /* the greatest share of a spring beyond its rest length is wanted */
  SBRI_FLOWING = 4, /* rest lengths are state, and springs may be torn */
  SBRI_FORCE_KINDS = 8
};

static inline int sbri_force_kind(const sbri_island_tick *t, bool tracked) {
  return (t->island->cell_damping ? SBRI_DAMPED : 0) | (tracked ? SBRI_TRACKED : 0) |
         (t->rests ? SBRI_FLOWING : 0);
}

/* Force of its springs on each point of a group of lanes; `stretches` (8) where tracked. */
SBRI_INLINE sbri_wide3 sbri_spring_forces(
    const sbri_island_tick *t, uint32_t slot, sbri_wide3 x, int kind, float *stretches) {
  const sbri_island *island = t->island;
  const bool damped = kind & SBRI_DAMPED, track = kind & SBRI_TRACKED, flowing = kind & SBRI_FLOWING;
  uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
  sbri_wide3 f = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)}, v = f;
  sbri_wide greatest = track ? sbri_wide_load(stretches + lane) : f.x;
  if (damped) v = sbri_wide_load_points(t->velocity_points + slot);
  for (uint32_t c = island->cell_begins[block]; c < island->cell_ends[block]; c++) {
    const sbri_spring_cell *cell = &island->cells[c];
    sbri_wide3 other = sbri_wide_gather(t->positions, cell->others + lane);
    sbri_wide dx = other.x - x.x, dy = other.y - x.y, dz = other.z - x.z;
    sbri_wide square = dx * dx + dy * dy + dz * dz + sbri_wide_all(SBRI_LENGTH_FLOOR);
    sbri_wide k = sbri_wide_load(cell->stiffness + lane), pull = sbri_wide_load(cell->pull + lane);
    sbri_wide strength = sbri_wide_all(1);
    if (flowing) {
      const uint32_t *links = island->cell_links + c * SBRI_BLOCK + lane;
      strength = sbri_wide_gather_floats(t->strengths, links);
      k = k * strength;
      pull = k * sbri_wide_gather_floats(t->rests, links);
    }
    sbri_wide s = k - pull / sbri_wide_sqrt(square);
    if (track) { /* goals, which have no rest length, do not count */
      sbri_wide share = s / sbri_wide_max(k, sbri_wide_all(1e-20f));
      greatest = sbri_wide_select(pull > sbri_wide_all(0), sbri_wide_max(share, greatest), greatest);
    }
    if (damped && island->cell_slack) {
      size_t place = (size_t)c * SBRI_BLOCK + lane; /* links go along where points split */
      sbri_wide slack = flowing ? sbri_wide_gather_floats(island->link_slack, island->cell_links + place)
                                : sbri_wide_load(island->cell_slack + place);
      s = s - sbri_wide_min(s, sbri_wide_all(0)) * slack;
    }
    if (damped) {
      sbri_wide3 w = sbri_wide_gather(t->velocity_points, cell->others + lane);
      sbri_wide rate = (w.x - v.x) * dx + (w.y - v.y) * dy + (w.z - v.z) * dz;
      sbri_wide damping = sbri_wide_load(island->cell_damping + c * SBRI_BLOCK + lane);
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
  return island->tetrahedron_block_count > 0 || island->region_block_count > 0;
}

/* Acceleration of each point of a group of lanes by all forces but frame damping and media friction. */
SBRI_INLINE sbri_wide3 sbri_acceleration(
    const sbri_island_tick *t, uint32_t slot, sbri_wide3 x, int kind, float *stretches) {
  sbri_wide3 f = sbri_spring_forces(t, slot, x, kind, stretches);
  if (t->outer) {
    sbri_wide3 more = sbri_wide_load_points(t->outer + slot);
    f.x = f.x + more.x, f.y = f.y + more.y, f.z = f.z + more.z;
  }
  if (sbri_has_element_forces(t->island)) {
    sbri_wide3 more = sbri_wide_load_points(t->element_forces + slot);
    f.x = f.x + more.x, f.y = f.y + more.y, f.z = f.z + more.z;
  }
  sbri_wide w = sbri_wide_load(t->island->inverse_masses + slot);
  sbri_wide g = sbri_wide_load(t->island->gravity_scales + slot);
  return (sbri_wide3){f.x * w + g * sbri_wide_all(t->gravity.x), f.y * w + g * sbri_wide_all(t->gravity.y),
      f.z * w + g * sbri_wide_all(t->gravity.z)};
}

/* The switch over kinds of forces: CALL with each as a constant. */
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
