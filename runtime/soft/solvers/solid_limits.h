/* Strain limits, yield and tear of tetrahedra, at the end of a substep. Strains are the principal ones of F_e
 * (mechanics/solid_strain.h).
 *
 * Limits work like those of springs (strain_limit.h): a principal stretch beyond its limit is brought back
 * along its own gradient, weighted by the inverse masses of the corners, and its rate of change away from the
 * limit becomes 0. Linear and angular momentum are conserved. Up to four sweeps per substep; elements with
 * common points may stay slightly beyond their limits.
 *
 * An element that yields gets a new metric of its rest shape; a torn element loses its stiffness. Both change
 * the blocks, which are then state.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_SOLID_LIMITS_H
#define SBRI_SOLID_LIMITS_H

#include "mechanics/solid_strain.h"
#include "soft/solvers/strain_limit.h"

/* Maximum squared compression of a rest shape in a direction. Elements beyond it do not yield further. */
#define SBRI_MAX_FLOW_STRETCH 64.0
/* Sweeps end when no strain exceeds its limit by more than this. */
#define SBRI_LIMIT_TOLERANCE 1e-3
enum { SBRI_LIMIT_SWEEPS = 4 };

/* One element, and its position in the blocks for forces. */
typedef struct sbri_solid_lane {
  uint32_t block, lane;
  const uint32_t *corners[4];
} sbri_solid_lane;

static inline uint32_t sbri_corner(const sbri_solid_lane *e, int k) {
  return *e->corners[k];
}

static inline void sbri_store_solid_edges(const sbri_island_tick *t, const sbri_solid_lane *e, sbfi_d3 d[3]) {
  sbf_vec3 o = sbri_shifted_position(t, sbri_corner(e, 0));
  for (int k = 0; k < 3; k++) {
    sbf_vec3 p = sbri_shifted_position(t, sbri_corner(e, k + 1));
    d[k] = (sbfi_d3){(double)p.x - (double)o.x, (double)p.y - (double)o.y, (double)p.z - (double)o.z};
  }
}

/* Brings the k-th stretch to `bound`. Corrections of other stretches may have moved the corners. */
static inline void sbri_limit_stretch(
    const sbri_island_tick *t, const sbri_solid_lane *e, sbfi_stretches *s, int k, double bound) {
  const double *q = s->directions[k];
  double sum = 0, pinned_sum = 0, fractions[4] = {0, q[0], q[1], q[2]};
  bool is_long = s->values[k] > bound;
  sbfi_d3 d[3];
  sbri_store_solid_edges(t, e, d);
  sbfi_d3 u = sbfi_d3_add(
      sbfi_d3_add(sbfi_d3_scale(d[0], q[0]), sbfi_d3_scale(d[1], q[1])), sbfi_d3_scale(d[2], q[2]));
  double value = s->values[k] < 0 ? -sqrt(sbfi_d3_dot(u, u)) : sqrt(sbfi_d3_dot(u, u));
  if (!(fabs(value) > 1e-6) || is_long != (value > bound)) return;
  sbf_vec3 n = sbfi_d3_rounded(sbfi_d3_scale(u, 1 / value)), relative_velocity = {0, 0, 0};
  fractions[0] = -(q[0] + q[1] + q[2]);
  for (int i = 0; i < 4; i++) {
    uint32_t slot = sbri_corner(e, i);
    double w = slot < t->island->free_count ? t->island->inverse_masses[slot] : 0;
    sum += w * fractions[i] * fractions[i];
    pinned_sum += (double)sbri_pinned_inverse_mass(t, slot, sbri_scale(n, (float)fractions[i]));
    relative_velocity =
        sbri_add_scaled(relative_velocity, sbri_reacted_velocity(t, slot), (float)fractions[i]);
  }
  if (!(sum > 0)) return;
  float all = (float)(sum + pinned_sum), speed = sbri_dot(relative_velocity, n),
        travel = (float)(value - bound) / all;
  bool leaving = is_long ? speed > 0 : speed < 0;
  sbf_vec3 impulse = sbri_limit_tangential_impulse(relative_velocity, n, travel, all, (float)bound);
  impulse = sbri_add_scaled(impulse, n, leaving ? -speed / all : 0);
  for (int i = 0; i < 4; i++)
    sbri_move_slot(t, sbri_corner(e, i), sbri_scale(n, -(float)fractions[i] * travel));
  for (int i = 0; i < 4; i++)
    sbri_apply_slot_impulse(t, sbri_corner(e, i), sbri_scale(impulse, (float)fractions[i]));
  s->values[k] = bound;
}

/* Copy `n` of an element: one is for forces, one for sweeps. */
static inline sbri_tetrahedron_block *sbri_solid_copy(
    const sbri_island_tick *t, uint32_t element, int n, uint32_t *lane) {
  uint32_t at = t->island->tetrahedra.lanes[2 * element + (uint32_t)n];
  *lane = at % SBRI_BLOCK;
  return &t->solids.flowing[at / SBRI_BLOCK];
}

static inline void sbri_tear_solid(const sbri_island_tick *t, const sbri_solid_lane *e, uint32_t element) {
  sbri_tears *tears = t->tears;
  sbf_vec3 middle = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    const sbri_point *p = &t->positions[sbri_corner(e, k)];
    middle = sbri_add_scaled(middle, sbri_vec3(p->x, p->y, p->z), 0.25f);
  }
  if (tears->count < SBRI_TEARS) tears->at[tears->count] = (sbri_tear){element, true, middle};
  tears->count++;
  t->solids.torn[element] = SBRI_TORN_NOW;
  for (int n = 0; n < 2; n++) {
    uint32_t lane;
    sbri_tetrahedron_block *block = sbri_solid_copy(t, element, n, &lane);
    for (int i = 0; i < 6; i++) block->stiffness[i][lane] = 0;
    block->inverse_volume[lane] = block->bulk[lane] = block->shear[lane] = 0;
  }
}

static inline void sbri_yield_solid(
    const sbri_island_tick *t, uint32_t element, double per_metric, const sbfi_solid_metric *metric) {
  for (int n = 0; n < 2; n++) {
    uint32_t lane;
    sbri_tetrahedron_block *block = sbri_solid_copy(t, element, n, &lane);
    const sbri_tetrahedron_block *made = &t->island->tetrahedra.blocks[block - t->solids.flowing];
    for (int i = 0; i < 3; i++) {
      float flow_stretch = (float)(metric->at[i] * per_metric) / made->stiffness[i][lane];
      if (flow_stretch > (float)SBRI_MAX_FLOW_STRETCH) return;
      if (flow_stretch > *t->solids.max_flow_stretch) *t->solids.max_flow_stretch = flow_stretch;
    }
    for (int i = 0; i < 6; i++) block->stiffness[i][lane] = (float)(metric->at[i] * per_metric);
  }
}

/* Principal stretches of the element; returns false if it is torn. */
static inline bool sbri_solid_stretches(const sbri_island_tick *t, const sbri_solid_lane *e, sbfi_d3 d[3],
    sbfi_solid_metric *metric, sbfi_stretches *stretches) {
  const sbri_tetrahedron_block *block = &t->solids.blocks[e->block];
  uint32_t lane = e->lane;
  if (!(block->shear[lane] > 0)) return false;
  double per_metric = (double)block->shear[lane] / block->inverse_volume[lane]; /* V mu */
  for (int i = 0; i < 6; i++) metric->at[i] = block->stiffness[i][lane] / per_metric;
  sbri_store_solid_edges(t, e, d);
  return sbfi_stretches_find(metric, d, stretches);
}

/* Returns whether a strain exceeded its limit by more than the tolerance. */
static inline bool sbri_limit_solid(const sbri_island_tick *t, const sbri_solid_lane *e) {
  const sbri_solid_limits *is = &t->island->tetrahedra.limits[e->block];
  double max = 1 + (double)is->max[e->lane], min = 1 + (double)is->min[e->lane];
  sbfi_solid_metric metric;
  sbfi_stretches stretches;
  sbfi_d3 d[3];
  bool moved = false;
  if (!(is->max[e->lane] > 0 || is->min[e->lane] > -1)) return false;
  if (!sbri_solid_stretches(t, e, d, &metric, &stretches)) return false;
  for (int k = 0; k < 3; k++) {
    double value = stretches.values[k];
    bool is_long = is->max[e->lane] > 0 && value > max;
    if (!is_long && !(is->min[e->lane] > -1 && value < min)) continue;
    double bound = is_long ? max : min;
    moved = moved || fabs(value - bound) > SBRI_LIMIT_TOLERANCE;
    sbri_limit_stretch(t, e, &stretches, k, bound);
  }
  return moved;
}

static inline void sbri_flow_solid(const sbri_island_tick *t, const sbri_solid_lane *e, float h) {
  const sbri_solid_limits *is = &t->island->tetrahedra.limits[e->block];
  const sbri_tetrahedron_block *block = &t->solids.blocks[e->block];
  uint32_t lane = e->lane, element = t->island->tetrahedra.of_lane[e->block * SBRI_BLOCK + lane];
  sbfi_solid_metric metric;
  sbfi_stretches stretches;
  sbfi_d3 d[3];
  double longest = -1;
  if (!sbri_solid_stretches(t, e, d, &metric, &stretches)) return;
  for (int k = 0; k < 3; k++)
    if (stretches.values[k] > longest) longest = stretches.values[k];
  if (is->tear[lane] > 0 && longest - 1 > is->tear[lane])
    sbri_tear_solid(t, e, element);
  else if (is->rate[lane] > 0 &&
           sbfi_solid_flow(&stretches, is->yield[lane], 1 - sbri_exp(-is->rate[lane] * h), &metric))
    sbri_yield_solid(t, element, (double)block->shear[lane] / block->inverse_volume[lane], &metric);
}

/* Lanes in which a strain may exceed its bound, by the sum of (s^2 - 1)^2 = |C|^2 - 2 tr C + 3, or that are
 * inverted. */
SBRI_INLINE sbri_mask sbri_solids_beyond(
    const sbri_island_tick *t, const sbri_tetrahedron_block *block, const float *squares, uint32_t lane) {
  sbri_wide3 x0 = sbri_wide_gather(t->positions, block->corners[0] + lane), d[3];
  for (int k = 0; k < 3; k++)
    d[k] = sbri_wide3_sub(sbri_wide_gather(t->positions, block->corners[k + 1] + lane), x0);
  static const int indices[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  sbri_wide inverse_volume = sbri_wide_load(block->inverse_volume + lane), zero = sbri_wide_all(0);
  sbri_wide scale =
      inverse_volume / sbri_wide_max(sbri_wide_load(block->shear + lane), sbri_wide_all(1e-30f));
  sbri_wide k[6], b[6], product[3][3];
  for (int i = 0; i < 6; i++) k[i] = sbri_wide_load(block->stiffness[i] + lane) * scale;
  for (int i = 0; i < 3; i++)
    for (int j = i; j < 3; j++) b[indices[i][j]] = sbri_wide3_dot(d[i], d[j]);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      product[i][j] = b[indices[i][0]] * k[indices[0][j]] + b[indices[i][1]] * k[indices[1][j]] +
                      b[indices[i][2]] * k[indices[2][j]];
  sbri_wide sum = sbri_wide_all(3);
  for (int i = 0; i < 3; i++) {
    sum = sum - sbri_wide_all(2) * product[i][i];
    for (int j = 0; j < 3; j++) sum = sum + product[i][j] * product[j][i];
  }
  sbri_wide ratio = sbri_wide3_dot(d[0], sbri_wide3_cross(d[1], d[2])) * inverse_volume;
  return (sum > sbri_wide_load(squares + lane)) | (ratio < zero);
}

/* One pass over the elements that may be beyond a limit: applies the limits if `h` is 0, else yield and tear
 * over h seconds. Returns whether a limit moved anything. All lanes of a block are evaluated before any is
 * moved: lanes of some blocks share points, and the result must not depend on the SIMD width. */
static inline bool sbri_pass_solids(const sbri_island_tick *t, float h) {
  bool moved = false;
  for (uint32_t b = 0; b < t->island->tetrahedra.dense_count; b++) {
    const sbri_tetrahedron_block *block = &t->solids.blocks[b];
    float marks[SBRI_BLOCK];
    bool any = false;
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_mask is_beyond = sbri_solids_beyond(t, block, t->island->tetrahedra.limits[b].square, lane);
      sbri_wide_store(marks + lane, sbri_wide_select(is_beyond, sbri_wide_all(1), sbri_wide_all(0)));
      any = any || sbri_mask_any(is_beyond);
    }
    for (uint32_t lane = 0; any && lane < SBRI_BLOCK; lane++) {
      if (marks[lane] == 0) continue;
      sbri_solid_lane element = {b, lane, {0}};
      for (int k = 0; k < 4; k++) element.corners[k] = &block->corners[k][lane];
      if (h > 0)
        sbri_flow_solid(t, &element, h);
      else if (sbri_limit_solid(t, &element))
        moved = true;
    }
  }
  return moved;
}

static inline void sbri_limit_solids(const sbri_island_tick *t, float h) {
  for (int sweep = 0;
       t->island->tetrahedra.are_limited && sweep < SBRI_LIMIT_SWEEPS && sbri_pass_solids(t, 0); sweep++)
    ;
  if (t->solids.flowing) sbri_pass_solids(t, h);
}

#endif
