/* Forces of springs, gathered point by point: each of the eight points of a block sums its own springs, so
 * that nothing is written twice, the order of sums is fixed, and the two ends of a spring receive exactly
 * opposite forces. Written for the lanes of the file that includes it; see kernels/kernels.h. */
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

/* Force of its springs on each point of a group of lanes. With `stretches` also the greatest share of a
 * spring beyond its rest length; with `damped` the springs' own damping. */
static inline sbri_wide3 sbri_spring_forces(
    const sbri_island_tick *t, uint32_t slot, sbri_wide3 x, bool damped, bool track, float *stretches) {
  const sbri_island *island = t->island;
  uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
  sbri_wide3 f = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)}, v = f;
  sbri_wide greatest = track ? sbri_wide_load(stretches + lane) : f.x;
  if (damped) v = sbri_wide_load_points(t->velocity_points + slot);
  for (uint32_t c = island->cell_begins[block]; c < island->cell_begins[block + 1]; c++) {
    const sbri_spring_cell *cell = &island->cells[c];
    sbri_wide3 other = sbri_wide_gather(t->positions, cell->others + lane);
    sbri_wide dx = other.x - x.x, dy = other.y - x.y, dz = other.z - x.z;
    sbri_wide square = dx * dx + dy * dy + dz * dz + sbri_wide_all(SBRI_LENGTH_FLOOR);
    sbri_wide k = sbri_wide_load(cell->stiffness + lane), pull = sbri_wide_load(cell->pull + lane);
    sbri_wide s = k - pull / sbri_wide_sqrt(square);
    if (track) { /* goals, which have no rest length, do not count */
      sbri_wide share = s / sbri_wide_max(k, sbri_wide_all(1e-20f));
      greatest = sbri_wide_select(pull > sbri_wide_all(0), sbri_wide_max(share, greatest), greatest);
    }
    if (damped) {
      sbri_wide3 w = sbri_wide_gather(t->velocity_points, cell->others + lane);
      sbri_wide rate = (w.x - v.x) * dx + (w.y - v.y) * dy + (w.z - v.z) * dz;
      s = s + sbri_wide_load(island->cell_damping + c * SBRI_BLOCK + lane) * rate / square;
    }
    f.x = f.x + s * dx;
    f.y = f.y + s * dy;
    f.z = f.z + s * dz;
  }
  if (track) sbri_wide_store(stretches + lane, greatest);
  return f;
}

#endif
