/* Vertex block descent: an implicit Euler substep that moves one point after the other to the minimum of its
 * own part of the energy while the others stay fixed (Chen, Liu, Yang and Yuksel, Vertex Block Descent, ACM
 * Transactions on Graphics 43 (4), 2024):
 *
 *   x_i += H^-1 f,   f = -m/h^2 (x_i - y_i) + force of its elements,   y = x + h v + h^2 a,
 *   H = m/h^2 1 + sum over springs of k (n n^T + max(0, 1 - l0/l) (1 - n n^T))
 *              + sum over tetrahedra of V (mu |g|^2 1 + lambda (cof F g)(cof F g)^T)
 *
 * H is positive definite in every state, including inverted ones, so no step increases the linearised energy.
 * Points of one colour share no element and move at once, eight per block.
 *
 * Sweeps begin at the rigid motion of the body, which strains no element. From there the sum of energies only
 * falls, however few the sweeps, and translation and rotation are kept. If the sweeps begin at y, as in the
 * paper, stiff bodies gain energy.
 *
 * Bias against the energy: none at rest, whatever the substep. In motion it is that of implicit Euler: a
 * damping ratio of w h / 2, and a period longer by (w h)^2 / 3. Too few sweeps add more bias, because a
 * disturbance travels only a few points per sweep. Stiffness damping of tetrahedra is ignored; it is smaller
 * than the damping of the scheme.
 *
 * Differences from the paper: no Chebyshev acceleration, which was unstable; a fixed number of sweeps;
 * contacts act on the velocities at the end of the sweeps, as in the other schemes.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_BLOCK_DESCENT_H
#define SBRI_BLOCK_DESCENT_H

#include "soft/solvers/descent_table.h"
#include "soft/solvers/finish.h"
#include "soft/solvers/motion.h"

/* Iterations over all points per substep. */
enum { SBRI_DESCENT_SWEEPS = 4 };

/* Force on a point and the six entries of its matrix: xx, yy, zz, xy, yz, zx. */
typedef struct sbri_descent_sum {
  sbri_wide3 force;
  sbri_wide h[6];
} sbri_descent_sum;

/* s += a 1 + b v v^T. */
SBRI_INLINE void sbri_descent_add(sbri_descent_sum *s, sbri_wide a, sbri_wide b, sbri_wide3 v) {
  sbri_wide3 w = sbri_wide3_scale(v, b);
  s->h[0] = s->h[0] + (a + w.x * v.x), s->h[1] = s->h[1] + (a + w.y * v.y);
  s->h[2] = s->h[2] + (a + w.z * v.z), s->h[3] = s->h[3] + w.x * v.y;
  s->h[4] = s->h[4] + w.y * v.z, s->h[5] = s->h[5] + w.z * v.x;
}

/* Vector to a spring's other end and its squared length. */
typedef struct sbri_descent_edge {
  sbri_wide3 d;
  sbri_wide square;
} sbri_descent_edge;

/* `slack`: 8 values; NULL: no spring has slack. */
SBRI_INLINE sbri_descent_edge sbri_descent_spring(const sbri_island_tick *t, const sbri_spring_cell *cell,
    const float *slack, uint32_t lane, sbri_wide3 x, sbri_descent_sum *s) {
  sbri_wide3 d = sbri_wide3_sub(sbri_wide_gather(t->positions, cell->others + lane), x);
  sbri_wide square = sbri_wide3_dot(d, d) + sbri_wide_all(SBRI_LENGTH_FLOOR);
  sbri_wide k = sbri_wide_load(cell->stiffness + lane), rest_force = sbri_wide_load(cell->rest_force + lane);
  sbri_wide factor = k - rest_force / sbri_wide_sqrt(square), zero = sbri_wide_all(0), one = sbri_wide_all(1);
  if (slack) {
    sbri_wide fraction = sbri_wide_select(factor < zero, one - sbri_wide_load(slack + lane), one);
    k = k * fraction, factor = factor * fraction;
  }
  sbri_wide across = sbri_wide_max(factor, zero);
  s->force = sbri_wide3_add(s->force, sbri_wide3_scale(d, factor));
  sbri_descent_add(s, across, (k - across) / square, d);
  return (sbri_descent_edge){d, square};
}

/* Damping of the spring itself, by the relative displacement of its ends in the substep. */
SBRI_INLINE void sbri_descent_damp(
    sbri_descent_edge edge, sbri_wide damping_per_step, sbri_wide3 moved, sbri_descent_sum *s) {
  sbri_wide fraction = damping_per_step / edge.square;
  s->force = sbri_wide3_add(s->force, sbri_wide3_scale(edge.d, fraction * sbri_wide3_dot(moved, edge.d)));
  sbri_descent_add(s, sbri_wide_all(0), fraction, edge.d);
}

/* Corner 0 of the block is the point. */
SBRI_INLINE void sbri_descent_corner(const sbri_island_tick *t, const sbri_tetrahedron_block *block,
    uint32_t lane, sbri_wide3 x, sbri_descent_sum *s) {
  sbri_wide3 d[3], n[3];
  for (int i = 0; i < 3; i++)
    d[i] = sbri_wide3_sub(sbri_wide_gather(t->positions, block->corners[i + 1] + lane), x);
  n[0] = sbri_wide3_cross(d[1], d[2]), n[1] = sbri_wide3_cross(d[2], d[0]),
  n[2] = sbri_wide3_cross(d[0], d[1]);
  sbri_wide inverse_volume = sbri_wide_load(block->inverse_volume + lane);
  sbri_wide bulk = sbri_wide_load(block->bulk + lane);
  sbri_wide ratio = sbri_wide3_dot(d[0], n[0]) * inverse_volume;
  sbri_wide p = sbri_wide_load(block->shear + lane) - bulk * (ratio - sbri_wide_all(1));
  sbri_wide k[6];
  for (int i = 0; i < 6; i++) k[i] = sbri_wide_load(block->stiffness[i] + lane);
  sbri_wide a = k[0] + k[3] + k[5], b = k[3] + k[1] + k[4], c = k[5] + k[4] + k[2];
  sbri_wide3 out = sbri_wide3_add(sbri_wide3_add(n[0], n[1]), n[2]);
  sbri_wide3 f = sbri_wide3_add(
      sbri_wide3_add(sbri_wide3_scale(d[0], a), sbri_wide3_scale(d[1], b)), sbri_wide3_scale(d[2], c));
  s->force = sbri_wide3_add(s->force, sbri_wide3_sub(f, sbri_wide3_scale(out, p)));
  sbri_descent_add(s, a + b + c, bulk * inverse_volume, out);
}

/* One block in one iteration. `predicted` holds the displacements y - x of this substep, `moved` the
 * displacements so far. */
static inline void sbri_descent_move(const sbri_island_tick *t, const sbri_descent_block *block,
    float per_square, const sbri_point *predicted, sbri_point *moved) {
  const sbri_descent *table = t->island->descent;
  sbri_wide rate = sbri_wide_sqrt(sbri_wide_all(per_square));
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
    const uint32_t *slots = block->slots + lane;
    sbri_wide m = sbri_wide_load(block->masses + lane) * sbri_wide_all(per_square), zero = sbri_wide_all(0);
    sbri_wide3 x = sbri_wide_gather(t->positions, slots);
    sbri_wide3 so_far = sbri_wide_gather(moved, slots),
               remaining = sbri_wide3_sub(sbri_wide_gather(predicted, slots), so_far);
    sbri_descent_sum s = {sbri_wide3_scale(remaining, m), {m, m, m, zero, zero, zero}};
    for (uint32_t i = block->first_spring; i < block->spring_end; i++) {
      const float *slack = table->slack ? table->slack + (size_t)i * SBRI_BLOCK : NULL;
      sbri_descent_edge edge = sbri_descent_spring(t, &table->springs[i], slack, lane, x, &s);
      if (!table->damping) continue;
      sbri_wide damping = sbri_wide_load(table->damping + (size_t)i * SBRI_BLOCK + lane) * rate;
      sbri_wide3 other = sbri_wide_gather(moved, table->springs[i].others + lane);
      sbri_descent_damp(edge, damping, sbri_wide3_sub(other, so_far), &s);
    }
    for (uint32_t i = block->first_corner; i < block->corner_end; i++)
      sbri_descent_corner(t, &table->corners[i], lane, x, &s);
    /* Cramer's rule; H is positive definite because of m, except in padding lanes */
    sbri_wide3 u = {s.h[0], s.h[3], s.h[5]}, v = {s.h[3], s.h[1], s.h[4]}, w = {s.h[5], s.h[4], s.h[2]};
    sbri_wide3 vw = sbri_wide3_cross(v, w), wu = sbri_wide3_cross(w, u), uv = sbri_wide3_cross(u, v);
    sbri_wide det = sbri_wide3_dot(u, vw);
    sbri_mask good = (det > zero) & (m > zero);
    sbri_wide fraction = sbri_wide_select(good, sbri_wide_all(1) / det, zero);
    sbri_wide3 step = {sbri_wide3_dot(vw, s.force) * fraction, sbri_wide3_dot(wu, s.force) * fraction,
        sbri_wide3_dot(uv, s.force) * fraction};
    step.x = sbri_wide_select(good, step.x, zero), step.y = sbri_wide_select(good, step.y, zero);
    step.z = sbri_wide_select(good, step.z, zero);
    sbri_wide_scatter_add(t->positions, slots, step);
    sbri_wide_scatter_add(moved, slots, step);
  }
}

/* Writes the rigid motion of the body to t->accelerations: of its drivers, or its own without pins. */
static inline void sbri_descent_begin(const sbri_island_tick *t, const sbri_body *body) {
  size_t first = 3 * (size_t)body->slots.begin,
         size = 3 * (size_t)(body->slots.end - body->slots.begin) * sizeof(float);
  memcpy(t->scratch.accelerations + first, (body->is_pinned ? t->driver_velocities : t->velocities) + first,
      size);
  if (!body->is_pinned) sbri_rigid_motion_damp(t->island, body, t->positions, t->scratch.accelerations, 0, 0);
}

/* v += h (gravity and external forces); `predicted` = h v. Points begin at the rigid motion of the body. */
static inline void sbri_descent_predict(
    const sbri_island_tick *t, float h, sbri_point *predicted, sbri_point *moved) {
  const sbri_island *island = t->island;
  sbri_wide step = sbri_wide_all(h);
  sbri_decay_all(t, h); /* before gravity, so that a resting body feels its full weight */
  for (uint32_t slot = 0; slot < island->free_count; slot += SBRI_LANES) {
    float *velocity = sbri_triple(t->velocities, slot);
    sbri_wide3 v = sbri_load3(velocity), f = {sbri_wide_all(0), sbri_wide_all(0), sbri_wide_all(0)};
    if (t->scratch.external_forces) f = sbri_wide_load_points(t->scratch.external_forces + slot);
    sbri_wide w = sbri_wide_load(island->inverse_masses + slot),
              g = sbri_wide_load(island->gravity_scales + slot);
    v.x = v.x + step * (f.x * w + g * sbri_wide_all(t->environment.gravity.x));
    v.y = v.y + step * (f.y * w + g * sbri_wide_all(t->environment.gravity.y));
    v.z = v.z + step * (f.z * w + g * sbri_wide_all(t->environment.gravity.z));
    sbri_store3(velocity, v);
  }
  for (uint32_t b = 0; b < island->body_count; b++)
    sbri_descent_begin(t, &t->model->bodies[island->bodies[b]]);
  for (uint32_t slot = 0; slot < island->free_count; slot += SBRI_LANES) {
    sbri_wide3 x = sbri_wide_load_points(t->positions + slot);
    sbri_wide3 v = sbri_wide3_scale(sbri_load3(sbri_triple(t->scratch.accelerations, slot)), step);
    sbri_wide_store_points(
        predicted + slot, sbri_wide3_scale(sbri_load3(sbri_triple(t->velocities, slot)), step));
    sbri_wide_store_points(moved + slot, v);
    sbri_wide_store_points(t->scratch.begins + slot, x);
    sbri_wide_store_points(t->positions + slot, sbri_wide3_add(x, v));
  }
  for (uint32_t slot = island->free_count; slot < island->slot_count; slot++) {
    sbf_vec3 v = sbri_slot_velocity(t, t->velocities, slot);
    moved[slot] = (sbri_point){v.x * h, v.y * h, v.z * h, 0};
  }
}

/* Restores the positions at the beginning of the substep and sets the velocities that the iterations found.
 */
static inline void sbri_descent_end(const sbri_island_tick *t, float h, const sbri_point *moved) {
  sbri_wide rate = sbri_wide_all(1 / h);
  for (uint32_t slot = 0; slot < t->island->free_count; slot += SBRI_LANES) {
    sbri_wide_store_points(t->positions + slot, sbri_wide_load_points(t->scratch.begins + slot));
    sbri_store3(
        sbri_triple(t->velocities, slot), sbri_wide3_scale(sbri_wide_load_points(moved + slot), rate));
  }
}

static inline void sbri_lanes_block_descent_tick(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  const sbri_descent *table = island->descent;
  uint32_t substeps = sbri_scheme_substeps(island, t->tick_s, *t->springs.stretch);
  float h = t->tick_s / (float)substeps, per_square = 1 / (h * h);
  sbri_point *predicted = t->scratch.element_forces,
             *moved = t->scratch.moves;                          /* scratch that is unused here */
  uint32_t corners = island->tetrahedra.block_count > 0 ? 4 : 2; /* number of points per element */
  sbri_store_pinned_begin(t);
  sbri_mark_all_compressed(t);
  for (uint32_t s = 0; s < substeps; s++) {
    if (t->scratch.external_forces) sbri_compute_external_forces(t, h);
    sbri_move_pinned(t, s + 1 == substeps ? 1 : (float)(s + 1) / (float)substeps);
    sbri_descent_predict(t, h, predicted, moved);
    for (int sweep = 0; sweep < SBRI_DESCENT_SWEEPS; sweep++)
      for (uint32_t b = 0; b < table->block_count; b++)
        sbri_descent_move(t, &table->blocks[b], per_square, predicted, moved);
    sbri_descent_end(t, h, moved);
    sbri_drift(t, h);
    if (island->tetrahedra.block_count > 0) sbri_update_compression(t);
    sbri_count_element_visits(t, SBRI_DESCENT_SWEEPS * corners);
    sbri_finish_substep(t, h);
    if (t->reactions) sbri_react_at_end(t, h);
  }
  if (island->tetrahedra.block_count > 0) sbri_tetrahedron_pass(t, true); /* updates J */
}

#endif
