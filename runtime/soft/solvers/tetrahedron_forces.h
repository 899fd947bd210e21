/* Forces of neo-Hookean tetrahedra (mechanics/neo_hookean.h states the energy), eight at a time.
 *
 * With edges d_j = x_j - x_0 and the area vectors n_1 = d_2 x d_3 and so on, J = d_1.n_1 / (6 V) and the
 * force on corner i is
 *
 *   f_i = -sum_j K_ij d_j - (lambda (J - 1) - mu) / 6 n_i,     K_ij = V mu g_i.g_j
 *
 * for i, j = 1..3, and f_0 minus their sum. This equals -V P g_i without ever forming F, in two thirds of the
 * operations. Forces are summed point by point in the order of the blocks; within a block, first all first
 * corners, lane after lane, then all second corners. The order is the same for every SIMD width.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_TETRAHEDRON_FORCES_H
#define SBRI_TETRAHEDRON_FORCES_H

#include "math/vec3.h"
#include "model/island_tick.h"

SBRI_INLINE sbri_wide3 sbri_wide3_sub(sbri_wide3 a, sbri_wide3 b) {
  return (sbri_wide3){a.x - b.x, a.y - b.y, a.z - b.z};
}
SBRI_INLINE sbri_wide3 sbri_wide3_add(sbri_wide3 a, sbri_wide3 b) {
  return (sbri_wide3){a.x + b.x, a.y + b.y, a.z + b.z};
}
SBRI_INLINE sbri_wide3 sbri_wide3_scale(sbri_wide3 a, sbri_wide s) {
  return (sbri_wide3){a.x * s, a.y * s, a.z * s};
}
SBRI_INLINE sbri_wide sbri_wide3_dot(sbri_wide3 a, sbri_wide3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
SBRI_INLINE sbri_wide3 sbri_wide3_cross(sbri_wide3 a, sbri_wide3 b) {
  return (sbri_wide3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* An element below this volume ratio is compressed: the compression limit (compression_limit.h) may move it
 * before the next check. */
#define SBRI_COMPRESSION_NEAR 0.5f

/* Per lane: bound of the stiffening relative to rest, and minimum J. */
typedef struct sbri_tetrahedron_watch {
  float stiffening[SBRI_BLOCK]; /* bound of the stiffness relative to rest, maximum over elements */
  float min_ratio[SBRI_BLOCK];  /* minimum J */
  bool is_compressed;           /* some element of the present block is */
} sbri_tetrahedron_watch;

/* Includes a group of lanes with the volume ratios J. */
SBRI_INLINE void sbri_watch_ratio(
    sbri_mask real, sbri_wide ratio, uint32_t lane, sbri_tetrahedron_watch *watch) {
  sbri_wide min = sbri_wide_load(watch->min_ratio + lane);
  sbri_wide_store(watch->min_ratio + lane, sbri_wide_select(real, sbri_wide_min(ratio, min), min));
  watch->is_compressed =
      watch->is_compressed || sbri_mask_any(real & (ratio < sbri_wide_all(SBRI_COMPRESSION_NEAR)));
}

/* The block of a corner is V (mu |g|^2 1 + lambda (cof F g)(cof F g)^T) with |cof F g| = |n| / (6 V). The
 * bound is the maximum over the corners of its largest eigenvalue relative to rest, plus the contribution of
 * the curvature of J between corners: at most lambda |J - 1| beyond the mu at rest. */
SBRI_INLINE void sbri_watch(const sbri_tetrahedron_block *block, uint32_t lane, sbri_wide3 n1, sbri_wide3 n2,
    sbri_wide3 n3, sbri_wide ratio, sbri_tetrahedron_watch *watch) {
  sbri_wide zero = sbri_wide_all(0), tiny = sbri_wide_all(1e-30f);
  sbri_wide k11 = sbri_wide_load(block->stiffness[0] + lane),
            k22 = sbri_wide_load(block->stiffness[1] + lane);
  sbri_wide k33 = sbri_wide_load(block->stiffness[2] + lane),
            k12 = sbri_wide_load(block->stiffness[3] + lane);
  sbri_wide k23 = sbri_wide_load(block->stiffness[4] + lane),
            k31 = sbri_wide_load(block->stiffness[5] + lane);
  sbri_wide bulk = sbri_wide_load(block->bulk + lane), shear = sbri_wide_load(block->shear + lane);
  sbri_wide side = bulk * sbri_wide_load(block->inverse_volume + lane), two = sbri_wide_all(2);
  sbri_wide3 n0 = sbri_wide3_add(sbri_wide3_add(n1, n2), n3);
  sbri_wide k00 = k11 + k22 + k33 + two * (k12 + k23 + k31);
  sbri_wide a = side * sbri_wide3_dot(n0, n0) / sbri_wide_max(k00, tiny);
  a = sbri_wide_max(a, side * sbri_wide3_dot(n1, n1) / sbri_wide_max(k11, tiny));
  a = sbri_wide_max(a, side * sbri_wide3_dot(n2, n2) / sbri_wide_max(k22, tiny));
  a = sbri_wide_max(a, side * sbri_wide3_dot(n3, n3) / sbri_wide_max(k33, tiny));
  /* a is lambda |cof F g|^2 / (mu |g|^2). */
  sbri_wide fraction = sbri_wide_max(shear, tiny), max = sbri_wide_max(bulk + shear, tiny);
  sbri_wide off = ratio - sbri_wide_all(1), curved = bulk * off - shear;
  curved = sbri_wide_max(sbri_wide_max(curved, zero - curved) - shear, zero);
  sbri_wide stiffening = (sbri_wide_all(1) + a) * fraction / max + curved / max;
  sbri_mask real = shear > zero;
  sbri_wide before = sbri_wide_load(watch->stiffening + lane);
  sbri_wide_store(
      watch->stiffening + lane, sbri_wide_select(real, sbri_wide_max(stiffening, before), before));
  sbri_watch_ratio(real, ratio, lane, watch);
}

/* Viscous forces, subtracted from f, at the rates w of the edges d: -beta V F S g_i, with S Hooke's stress of
 * the rate E' of Green's strain. In terms of edges, E' has the coefficients c_jk = (d_j.w_k + w_j.d_k) / 2,
 * and V g_j^T S g_i = 2 / (V mu) K c K + (lambda - mu) / (V mu^2) (K:c) K. */
SBRI_INLINE void sbri_compute_viscous_forces(const sbri_tetrahedron_block *block, uint32_t lane,
    const float *betas, const sbri_wide3 d[3], const sbri_wide3 w[3], sbri_wide3 f[3]) {
  static const int indices[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  sbri_wide k[6], c[6], half = sbri_wide_all(0.5f), two = sbri_wide_all(2), tiny = sbri_wide_all(1e-30f);
  for (int i = 0; i < 6; i++) k[i] = sbri_wide_load(block->stiffness[i] + lane);
  for (int i = 0; i < 3; i++)
    for (int j = i; j < 3; j++)
      c[indices[i][j]] = half * (sbri_wide3_dot(d[i], w[j]) + sbri_wide3_dot(w[i], d[j]));
  sbri_wide trace = k[0] * c[0] + k[1] * c[1] + k[2] * c[2] + two * (k[3] * c[3] + k[4] * c[4] + k[5] * c[5]);
  sbri_wide six = sbri_wide_all(6), mu = sbri_wide_max(six * sbri_wide_load(block->shear + lane), tiny);
  sbri_wide first = six * sbri_wide_load(block->bulk + lane) - mu;
  sbri_wide per_volume = six * sbri_wide_load(block->inverse_volume + lane) / mu; /* 1 / (V mu) */
  sbri_wide beta = sbri_wide_load(betas + lane), even = first / mu * per_volume * trace;
  for (int i = 0; i < 3; i++) {
    sbri_wide row[3]; /* (c K) column i */
    for (int j = 0; j < 3; j++)
      row[j] = c[indices[j][0]] * k[indices[0][i]] + c[indices[j][1]] * k[indices[1][i]] +
               c[indices[j][2]] * k[indices[2][i]];
    for (int j = 0; j < 3; j++) {
      sbri_wide s = two * per_volume *
                        (k[indices[j][0]] * row[0] + k[indices[j][1]] * row[1] + k[indices[j][2]] * row[2]) +
                    even * k[indices[j][i]];
      f[i] = sbri_wide3_sub(f[i], sbri_wide3_scale(d[j], beta * s));
    }
  }
}

/* Viscous forces at the present velocities. */
SBRI_INLINE void sbri_compute_tetrahedron_damping(const sbri_island_tick *t,
    const sbri_tetrahedron_block *block, uint32_t lane, const float *betas, const sbri_wide3 d[3],
    sbri_wide3 f[3]) {
  sbri_wide3 v = sbri_wide_gather(t->scratch.velocity_points, block->corners[0] + lane), w[3];
  for (int i = 0; i < 3; i++)
    w[i] = sbri_wide3_sub(sbri_wide_gather(t->scratch.velocity_points, block->corners[i + 1] + lane), v);
  sbri_compute_viscous_forces(block, lane, betas, d, w, f);
}

/* Edges of a group of lanes from their first corner. */
typedef struct sbri_tetrahedron_edges {
  sbri_wide3 d[3];
} sbri_tetrahedron_edges;

SBRI_INLINE sbri_tetrahedron_edges sbri_tetrahedron_edges_of(
    const sbri_point *x, const sbri_tetrahedron_block *block, uint32_t lane) {
  sbri_wide3 x0 = sbri_wide_gather(x, block->corners[0] + lane);
  return (sbri_tetrahedron_edges){{sbri_wide3_sub(sbri_wide_gather(x, block->corners[1] + lane), x0),
      sbri_wide3_sub(sbri_wide_gather(x, block->corners[2] + lane), x0),
      sbri_wide3_sub(sbri_wide_gather(x, block->corners[3] + lane), x0)}};
}

/* Forces of a group of lanes on corners 1 to 3; corner 0 receives minus `forces[0]`. */
SBRI_INLINE void sbri_tetrahedron_lanes(const sbri_island_tick *t, const sbri_tetrahedron_block *block,
    const sbri_wide3 d[3], uint32_t lane, const float *betas, sbri_tetrahedron_watch *watch,
    sbri_wide3 forces[4]) {
  sbri_wide3 *f = forces + 1;
  sbri_wide3 n1 = sbri_wide3_cross(d[1], d[2]);
  sbri_wide ratio = sbri_wide3_dot(d[0], n1) * sbri_wide_load(block->inverse_volume + lane);
  sbri_wide k11 = sbri_wide_load(block->stiffness[0] + lane),
            k22 = sbri_wide_load(block->stiffness[1] + lane);
  sbri_wide k33 = sbri_wide_load(block->stiffness[2] + lane),
            k12 = sbri_wide_load(block->stiffness[3] + lane);
  sbri_wide k23 = sbri_wide_load(block->stiffness[4] + lane),
            k31 = sbri_wide_load(block->stiffness[5] + lane);
#define SBRI_ROW(a, b, c, axis) a *d[0].axis + b *d[1].axis + c *d[2].axis
#define SBRI_ROWS(a, b, c) (sbri_wide3){SBRI_ROW(a, b, c, x), SBRI_ROW(a, b, c, y), SBRI_ROW(a, b, c, z)}
  sbri_wide3 kd1 = SBRI_ROWS(k11, k12, k31), kd2 = SBRI_ROWS(k12, k22, k23), kd3 = SBRI_ROWS(k31, k23, k33);
#undef SBRI_ROWS
#undef SBRI_ROW
  sbri_wide3 n2 = sbri_wide3_cross(d[2], d[0]), n3 = sbri_wide3_cross(d[0], d[1]);
  sbri_wide p =
      sbri_wide_load(block->shear + lane) - sbri_wide_load(block->bulk + lane) * (ratio - sbri_wide_all(1));
  f[0] = sbri_wide3_sub(sbri_wide3_scale(n1, p), kd1);
  f[1] = sbri_wide3_sub(sbri_wide3_scale(n2, p), kd2);
  f[2] = sbri_wide3_sub(sbri_wide3_scale(n3, p), kd3);
  if (betas) sbri_compute_tetrahedron_damping(t, block, lane, betas, d, f);
  if (watch) sbri_watch(block, lane, n1, n2, n3, ratio, watch);
  forces[0] = sbri_wide3_add(sbri_wide3_add(f[0], f[1]), f[2]);
}

/* With eight lanes, the edges of the next block are gathered before the forces of this one are added. A
 * processor looks ahead by only about one block and would stall otherwise. */
SBRI_INLINE void sbri_tetrahedron_blocks(const sbri_island_tick *t, const float *betas,
    sbri_tetrahedron_watch *watch, const sbri_force_parts *parts, uint32_t begin, uint32_t end) {
  enum { GROUPS = SBRI_BLOCK / SBRI_LANES };
  sbri_point *sums = t->scratch.element_forces;
  const sbri_tetrahedron_block *blocks = t->solids.blocks;
  const sbri_point *x = t->positions;
  sbri_tetrahedron_edges next = {0};
  if (GROUPS == 1 && begin < end) next = sbri_tetrahedron_edges_of(x, blocks + begin, 0);
  for (uint32_t b = begin; b < end; b++) {
    const sbri_tetrahedron_block *block = &blocks[b];
    const bool is_shared = parts && parts->rows_of[b] != UINT32_MAX;
    const uint32_t(*targets)[SBRI_BLOCK] = is_shared ? parts->rows[parts->rows_of[b]].at : block->corners;
    const float *of = betas ? betas + (size_t)b * SBRI_BLOCK : NULL;
    sbri_wide3 forces[GROUPS][4];
    if (watch) watch->is_compressed = false;
    for (uint32_t group = 0; group < GROUPS; group++) {
      sbri_tetrahedron_edges now =
          GROUPS == 1 ? next : sbri_tetrahedron_edges_of(x, block, group * SBRI_LANES);
      sbri_tetrahedron_lanes(t, block, now.d, group * SBRI_LANES, of, watch, forces[group]);
    }
    if (watch) t->solids.compressed[b] = watch->is_compressed;
    if (GROUPS == 1) next = sbri_tetrahedron_edges_of(x, block + (b + 1 < end), 0);
#define SBRI_SCATTER(k)                                                                                      \
  for (uint32_t group = 0; group < GROUPS; group++)                                                          \
  sbri_wide_scatter_sum(sums, targets[k] + group * SBRI_LANES, forces[group][k], (k) == 0)
    SBRI_SCATTER(0);
    SBRI_SCATTER(1);
    SBRI_SCATTER(2);
    SBRI_SCATTER(3);
#undef SBRI_SCATTER
  }
}

/* Adds the forces of a range of blocks. Specialised loops, so that the common one does no extra work. */
static inline void sbri_add_tetrahedron_forces(const sbri_island_tick *t, sbri_tetrahedron_watch *watch,
    const sbri_force_parts *parts, uint32_t begin, uint32_t end) {
  const float *betas = t->island->tetrahedra.damping;
  if (parts && betas)
    sbri_tetrahedron_blocks(t, betas, watch, parts, begin, end);
  else if (parts && watch)
    sbri_tetrahedron_blocks(t, NULL, watch, parts, begin, end);
  else if (parts)
    sbri_tetrahedron_blocks(t, NULL, NULL, parts, begin, end);
  else if (betas)
    sbri_tetrahedron_blocks(t, betas, watch, NULL, begin, end);
  else if (watch)
    sbri_tetrahedron_blocks(t, NULL, watch, NULL, begin, end);
  else
    sbri_tetrahedron_blocks(t, NULL, NULL, NULL, begin, end);
}

/* Writes the forces of the island's tetrahedra to t->element_forces, N. `watch`: NULL, or initialised by
 * sbri_watch_begin; receives the stiffening and the minimum J. */
static inline void sbri_compute_tetrahedron_forces(const sbri_island_tick *t, sbri_tetrahedron_watch *watch) {
  memset(t->scratch.element_forces, 0, t->island->slot_count * sizeof *t->scratch.element_forces);
  sbri_add_tetrahedron_forces(t, watch, NULL, 0, t->island->tetrahedra.dense_count);
}

static inline void sbri_watch_begin(sbri_tetrahedron_watch *watch) {
  for (int lane = 0; lane < SBRI_BLOCK; lane++) watch->stiffening[lane] = 0, watch->min_ratio[lane] = 1;
  watch->is_compressed = false;
}
static inline float sbri_watch_stiffening(const sbri_tetrahedron_watch *watch) {
  float greatest = 1;
  for (int lane = 0; lane < SBRI_BLOCK; lane++)
    greatest = watch->stiffening[lane] > greatest ? watch->stiffening[lane] : greatest;
  return greatest;
}
static inline float sbri_watch_min_ratio(const sbri_tetrahedron_watch *watch) {
  float min = 1;
  for (int lane = 0; lane < SBRI_BLOCK; lane++)
    min = watch->min_ratio[lane] < min ? watch->min_ratio[lane] : min;
  return min;
}

/* Computes the forces. With `checks`, also updates the stiffening and the minimum J in the tick's state and
 * the marks of compressed blocks. */
static inline void sbri_tetrahedron_pass(const sbri_island_tick *t, bool checks) {
  sbri_tetrahedron_watch watch;
  sbri_watch_begin(&watch);
  sbri_compute_tetrahedron_forces(t, checks ? &watch : NULL);
  if (!checks) return;
  *t->solids.stiffening = sbri_watch_stiffening(&watch);
  *t->solids.min_ratio = sbri_watch_min_ratio(&watch);
}

/* Time whose substeps at rest are stable for `time_s` at the last measured stiffening: frequencies grow with
 * its root, damping with stiffening itself. */
static inline double sbri_stiffened_time(const sbri_island_tick *t, float time_s) {
  const float max = 1e4f; /* larger values would not help */
  float fraction = *t->solids.stiffening * *t->solids.max_flow_stretch;
  if (!(fraction < max)) fraction = max;
  return (double)time_s * (double)(t->island->springs.stiffness_damping_s > 0 ? fraction : sqrtf(fraction));
}

#endif
