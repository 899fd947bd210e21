/* One position-based sweep over neo-Hookean tetrahedra (mechanics/neo_hookean.h states the energy), eight at
 * a time. Each in turn moves to where an implicit Euler step of it alone would take it.
 *
 * Such a step turns the stress P = mu F + s cof F, s = lambda (J - 1) - mu, into the impulses h V P' g_i with
 * P' = (1 + h^2 V A H)^-1 P, where H are the second derivatives of the energy and A is sum w_i g_i g_i^T. The
 * inverse is not computed. P is split into its part along cof F, on which the stiff lambda acts, and the
 * rest,
 *
 *   P = mu (F - (3 J / c) cof F)  +  (s + 3 mu J / c) cof F,     c = |cof F|^2,
 *
 * and each part gets the fraction (1 + W^2) / (1 + W^2 + W^4) of its impulse: nearly all where the substep
 * resolves it, 1 / W^2 where it does not. W^2 is h^2 times an estimate of A and H for that part, exact at
 * rest for isotropic elements:
 *
 *   the rest:      0.6 V (sum w_i |g_i|^2) (mu + |s| (1 + e^2) / 2),    e^2 = max(F:F - 2, F:F / 3)
 *   along cof F:   V (sum w_i |cof F g_i|^2 / c) (mu + lambda c + 2 s J F:F / c)
 *
 * No element by itself overshoots: 0.6 sum w_i |g_i|^2 is more than half of the largest eigenvalue of A, and
 * e is nearly the maximum stretch. (The fraction 1 / (1 + W^2) would be the implicit step itself if each
 * point belonged to one element. Where elements share points, it makes the error of the rest state four times
 * as large.)
 *
 * Nothing moves where P is 0, so the rest state is exact, unlike with two constraints that are projected one
 * after the other (Macklin and Mueller, A Constraint-based Formulation of Stable Neo-Hookean Materials,
 * 2021). Flat and inverted elements are no special case. Linear momentum is conserved, angular momentum to
 * second order, since both parts of P F^T are symmetric. No multiplier is accumulated.
 *
 * Every other sweep visits the blocks in reverse, so that neither end of the list is preferred.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_TETRAHEDRON_SWEEP_H
#define SBRI_TETRAHEDRON_SWEEP_H

#include "soft/solvers/motion.h"

/* Stores the edges of each tetrahedron from its first corner at the beginning of the tick. */
static inline void sbri_solid_edges_begin(const sbri_island_tick *t) {
  for (uint32_t b = 0; b < t->island->tetrahedra.block_count; b++) {
    const sbri_tetrahedron_block *block = &t->solids.blocks[b];
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
      float *edges = t->solids.edges + 9 * SBRI_BLOCK * (size_t)b + lane;
      sbri_wide3 x0 = sbri_wide_gather(t->scratch.begins, block->corners[0] + lane);
      for (int k = 0; k < 3; k++)
        sbri_store3(edges + 3 * SBRI_BLOCK * k,
            sbri_wide3_sub(sbri_wide_gather(t->scratch.begins, block->corners[k + 1] + lane), x0));
    }
  }
}

typedef struct sbri_sweep_step {
  float h, square; /* s, s^2 */
} sbri_sweep_step;

SBRI_INLINE sbri_wide3 sbri_wide3_of(sbri_wide4 a) {
  return (sbri_wide3){a.x, a.y, a.z};
}
SBRI_INLINE void sbri_wide4_move(sbri_wide4 *u, sbri_wide3 direction, sbri_wide s) {
  u->x = u->x + s * direction.x, u->y = u->y + s * direction.y, u->z = u->z + s * direction.z;
}

/* Adds viscous forces to f, as in sbri_compute_tetrahedron_damping, for the change of the edges since the
 * beginning of the substep. They are divided by 1 + h^2 times their own stiffness, beta / h of the maximum at
 * rest. `reach` is 0.6 sum w_i K_ii. */
SBRI_INLINE void sbri_sweep_damping(const sbri_island_tick *t, const sbri_tetrahedron_block *block,
    uint32_t lane, const float *betas, const sbri_wide3 d[3], sbri_wide reach, sbri_wide squares,
    const sbri_sweep_step *step, sbri_wide3 f[3]) {
  sbri_wide3 x0 = sbri_wide_gather(t->positions, block->corners[0] + lane), w[3], viscous[3];
  sbri_wide zero = sbri_wide_all(0), one = sbri_wide_all(1), rate = sbri_wide_all(1 / step->h);
  for (int i = 0; i < 3; i++) {
    sbri_wide3 before = sbri_wide3_sub(sbri_wide_gather(t->positions, block->corners[i + 1] + lane), x0);
    w[i] = sbri_wide3_scale(sbri_wide3_sub(d[i], before), rate);
    viscous[i] = (sbri_wide3){zero, zero, zero};
  }
  sbri_compute_viscous_forces(block, lane, betas, d, w, viscous);
  sbri_wide shear = sbri_wide_max(sbri_wide_load(block->shear + lane), sbri_wide_all(1e-30f));
  sbri_wide bulk = sbri_wide_load(block->bulk + lane), third = sbri_wide_all(1.0f / 3);
  sbri_wide stiffest = (sbri_wide_all(3) * bulk - shear) / shear * squares * third;
  sbri_wide fraction = one / (one + sbri_wide_all(step->h) * sbri_wide_load(betas + lane) * reach *
                                        sbri_wide_max(stiffest, one));
  for (int i = 0; i < 3; i++) f[i] = sbri_wide3_add(f[i], sbri_wide3_scale(viscous[i], fraction));
}

/* Solves a group of lanes. Loops over corners are unrolled by hand, because compilers keep arrays that are
 * looped over in memory. */
SBRI_INLINE void sbri_sweep_lanes(const sbri_island_tick *t, const sbri_tetrahedron_block *block,
    const float *edges, uint32_t lane, const float *betas, const sbri_sweep_step *step) {
  sbri_wide4 u0 = sbri_wide_gather4(t->scratch.moves, block->corners[0] + lane);
  sbri_wide4 u1 = sbri_wide_gather4(t->scratch.moves, block->corners[1] + lane);
  sbri_wide4 u2 = sbri_wide_gather4(t->scratch.moves, block->corners[2] + lane);
  sbri_wide4 u3 = sbri_wide_gather4(t->scratch.moves, block->corners[3] + lane);
#define SBRI_EDGE(k, u)                                                                                      \
  sbri_wide3_add(                                                                                            \
      sbri_load3(edges + 3 * SBRI_BLOCK * k + lane), (sbri_wide3){u.x - u0.x, u.y - u0.y, u.z - u0.z})
  sbri_wide3 d1 = SBRI_EDGE(0, u1), d2 = SBRI_EDGE(1, u2), d3 = SBRI_EDGE(2, u3);
#undef SBRI_EDGE
  sbri_wide3 n1 = sbri_wide3_cross(d2, d3), n2 = sbri_wide3_cross(d3, d1), n3 = sbri_wide3_cross(d1, d2);
  sbri_wide k11 = sbri_wide_load(block->stiffness[0] + lane);
  sbri_wide k22 = sbri_wide_load(block->stiffness[1] + lane);
  sbri_wide k33 = sbri_wide_load(block->stiffness[2] + lane);
  sbri_wide k12 = sbri_wide_load(block->stiffness[3] + lane);
  sbri_wide k23 = sbri_wide_load(block->stiffness[4] + lane);
  sbri_wide k31 = sbri_wide_load(block->stiffness[5] + lane);
  sbri_wide inverse_volume = sbri_wide_load(block->inverse_volume + lane);
  sbri_wide bulk = sbri_wide_load(block->bulk + lane), shear = sbri_wide_load(block->shear + lane);
  sbri_wide one = sbri_wide_all(1), two = sbri_wide_all(2), tiny = sbri_wide_all(1e-30f);
  sbri_wide half = sbri_wide_all(0.5f), zero = sbri_wide_all(0);
  sbri_wide ratio = sbri_wide3_dot(d1, n1) * inverse_volume;
  sbri_wide over_shear = one / sbri_wide_max(shear, tiny);
#define SBRI_ROW(a, b, c, axis) a *d1.axis + b *d2.axis + c *d3.axis
#define SBRI_ROWS(a, b, c) (sbri_wide3){SBRI_ROW(a, b, c, x), SBRI_ROW(a, b, c, y), SBRI_ROW(a, b, c, z)}
  sbri_wide3 kd1 = SBRI_ROWS(k11, k12, k31), kd2 = SBRI_ROWS(k12, k22, k23), kd3 = SBRI_ROWS(k31, k23, k33);
#undef SBRI_ROWS
#undef SBRI_ROW
  /* F:F, and |cof F|^2 from the minors of K, the Gram matrix of the edges at rest. */
  sbri_wide per_stiffness = inverse_volume * over_shear; /* 1 / (V mu) */
  sbri_wide squares =
      per_stiffness * (sbri_wide3_dot(d1, kd1) + sbri_wide3_dot(d2, kd2) + sbri_wide3_dot(d3, kd3));
  sbri_wide n11 = sbri_wide3_dot(n1, n1), n22 = sbri_wide3_dot(n2, n2), n33 = sbri_wide3_dot(n3, n3);
  sbri_wide n12 = sbri_wide3_dot(n1, n2), n23 = sbri_wide3_dot(n2, n3), n31 = sbri_wide3_dot(n3, n1);
  sbri_wide even =
      (k22 * k33 - k23 * k23) * n11 + (k33 * k11 - k31 * k31) * n22 + (k11 * k22 - k12 * k12) * n33;
  sbri_wide mixed =
      (k23 * k31 - k12 * k33) * n12 + (k12 * k31 - k23 * k11) * n23 + (k12 * k23 - k31 * k22) * n31;
  /* In slivers the minors cancel. With x, y, z the squared products of two singular values each, (x + y +
   * z)^2 >= 3 (xy + yz + zx) means |cof F|^4 >= 3 J^2 F:F, with equality at rest. The factor stays below 3 so
   * that rounding does not decide there. */
  sbri_wide bound = sbri_wide_max(ratio, zero - ratio) *
                    sbri_wide_sqrt(sbri_wide_all(2.99f) * sbri_wide_max(squares, zero));
  sbri_wide areas = sbri_wide_max((even + two * mixed) * per_stiffness * per_stiffness, bound);
  areas = sbri_wide_max(areas, tiny);
  sbri_wide over_areas = one / areas;
  /* A sixth of s, of 3 mu J / c, and of the pressure-like part of P. */
  sbri_wide s = bulk * (ratio - one) - shear, per_area = ratio * over_areas;
  sbri_wide q = sbri_wide_all(3) * shear * per_area, p = s + q;
  sbri_wide k00 = k11 + k22 + k33 + two * (k12 + k23 + k31), n00 = n11 + n22 + n33 + two * (n12 + n23 + n31);
  sbri_wide reach = sbri_wide_all(0.6f) * (u0.w * k00 + u1.w * k11 + u2.w * k22 + u3.w * k33);
  sbri_wide sides = u0.w * n00 + u1.w * n11 + u2.w * n22 + u3.w * n33;
  sbri_wide e = sbri_wide_max(squares - two, squares * sbri_wide_all(1.0f / 3)), max = sbri_wide_all(1e18f);
  sbri_wide size = sbri_wide_max(s, sbri_wide_all(0) - s), square = sbri_wide_all(step->square);
  sbri_wide across = square * reach * (one + size * over_shear * (half + half * e));
  sbri_wide curved = sbri_wide_max(shear + bulk * areas + two * s * per_area * squares, shear);
  sbri_wide along = square * sides * inverse_volume * over_areas * curved;
  across = sbri_wide_min(across, max), along = sbri_wide_min(along, max);
  sbri_wide a = (one + across) / (one + across + across * across);
  sbri_wide b = (one + along) / (one + along + along * along);
  sbri_wide pull = a * q - b * p;
#define SBRI_PART(n, kd, axis) pull *n.axis - a *kd.axis
#define SBRI_FORCE(n, kd) (sbri_wide3){SBRI_PART(n, kd, x), SBRI_PART(n, kd, y), SBRI_PART(n, kd, z)}
  sbri_wide3 f1 = SBRI_FORCE(n1, kd1), f2 = SBRI_FORCE(n2, kd2), f3 = SBRI_FORCE(n3, kd3);
#undef SBRI_FORCE
#undef SBRI_PART
  if (betas) {
    const sbri_wide3 d[3] = {d1, d2, d3};
    sbri_wide3 f[3] = {f1, f2, f3};
    sbri_sweep_damping(t, block, lane, betas, d, reach, squares, step, f);
    f1 = f[0], f2 = f[1], f3 = f[2];
  }
  sbri_wide4_move(&u0, sbri_wide3_add(sbri_wide3_add(f1, f2), f3), (sbri_wide_all(0) - square) * u0.w);
  sbri_wide4_move(&u1, f1, square * u1.w);
  sbri_wide4_move(&u2, f2, square * u2.w);
  sbri_wide4_move(&u3, f3, square * u3.w);
  sbri_wide_scatter4(t->scratch.moves, block->corners[0] + lane, u0);
  sbri_wide_scatter4(t->scratch.moves, block->corners[1] + lane, u1);
  sbri_wide_scatter4(t->scratch.moves, block->corners[2] + lane, u2);
  sbri_wide_scatter4(t->scratch.moves, block->corners[3] + lane, u3);
}

SBRI_INLINE void sbri_sweep_blocks(
    const sbri_island_tick *t, const sbri_sweep_step *step, bool backwards, const float *betas) {
  const sbri_tetrahedron_block *blocks = t->solids.blocks;
  uint32_t full = t->island->tetrahedra.full_count, left_out = t->island->tetrahedra.dense_count - full;
  uint32_t count = t->island->tetrahedra.block_count - left_out;
  for (uint32_t n = 0; n < count; n++) {
    uint32_t b = backwards ? count - 1 - n : n;
    if (b >= full) b += left_out;
    const float *edges = t->solids.edges + 9 * SBRI_BLOCK * (size_t)b;
    for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES)
      sbri_sweep_lanes(t, &blocks[b], edges, lane, betas ? betas + b * SBRI_BLOCK : NULL, step);
  }
}

static inline void sbri_sweep_tetrahedra(const sbri_island_tick *t, float h, bool backwards) {
  const sbri_sweep_step step = {h, h * h};
  if (t->island->tetrahedra.damping)
    sbri_sweep_blocks(t, &step, backwards, t->island->tetrahedra.damping);
  else
    sbri_sweep_blocks(t, &step, backwards, NULL);
}

#endif
