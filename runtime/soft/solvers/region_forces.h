/* Forces of regions that keep their shape (mechanics/shape_region.h), eight regions at a time, one per lane.
 * A force is a stiffness a w^2 times the displacement from the point's position in the region, so no mode is
 * faster than w in any state: regions are stable with w h < 2, inverted or not.
 *
 * The rotation of each region is updated from that of the previous substep by Newton's method on the angle.
 * With M = R^T A and A = sum a (x - c) r^T, the next rotation is ((tr M) 1 - sym M)^-1 times the axis of the
 * skew part of M. (Mueller, Bender, Chentanez and Macklin, A Robust Method to Extract the Rotational Part of
 * Deformations, 2016, divide by a number instead, which converges linearly, by thirds; this converges
 * quadratically.) Where that matrix is not positive definite, as for flat or mirrored regions, their division
 * is used. Rotations are state.
 *
 * Damping of a region is beta times the second derivative at rest: each point is damped relative to the rigid
 * motion that fits the velocities of the region best.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_REGION_FORCES_H
#define SBRI_REGION_FORCES_H

#include "soft/solvers/tetrahedron_forces.h"

/* Iterations of the rotation: enough for half a radian per substep to full precision. */
enum { SBRI_ROTATION_ITERATIONS = 4 };

typedef struct sbri_wide_columns {
  sbri_wide3 at[3];
} sbri_wide_columns;

SBRI_INLINE sbri_wide_columns sbri_wide_columns_of(const sbri_wide q[4]) {
  sbri_wide one = sbri_wide_all(1), two = sbri_wide_all(2), x = q[0], y = q[1], z = q[2], w = q[3];
  return (sbri_wide_columns){{{one - two * (y * y + z * z), two * (x * y + w * z), two * (x * z - w * y)},
      {two * (x * y - w * z), one - two * (x * x + z * z), two * (y * z + w * x)},
      {two * (x * z + w * y), two * (y * z - w * x), one - two * (x * x + y * y)}}};
}

SBRI_INLINE sbri_wide3 sbri_wide_rotated(const sbri_wide_columns *m, sbri_wide3 v) {
  return sbri_wide3_add(sbri_wide3_add(sbri_wide3_scale(m->at[0], v.x), sbri_wide3_scale(m->at[1], v.y)),
      sbri_wide3_scale(m->at[2], v.z));
}

/* Solves g x = b for the symmetric g = (xx, yy, zz, xy, yz, zx) if its determinant is above `min` times the
 * cube of its trace. Otherwise returns b over half the trace, or 0 if that is not positive. */
SBRI_INLINE sbri_wide3 sbri_wide_solve(const sbri_wide g[6], sbri_wide3 b, float min) {
  sbri_wide3 u = {g[0], g[3], g[5]}, v = {g[3], g[1], g[4]}, w = {g[5], g[4], g[2]};
  sbri_wide3 vw = sbri_wide3_cross(v, w), wu = sbri_wide3_cross(w, u), uv = sbri_wide3_cross(u, v);
  sbri_wide zero = sbri_wide_all(0), half = sbri_wide_all(0.5f), det = sbri_wide3_dot(u, vw);
  sbri_wide trace = g[0] + g[1] + g[2];
  trace = sbri_wide_max(trace, zero - trace);
  sbri_mask good = det > sbri_wide_all(min) * trace * trace * trace;
  sbri_wide size = sbri_wide_select(good, det, half * trace);
  sbri_wide fraction = sbri_wide_select(size > sbri_wide_all(1e-30f), sbri_wide_all(1) / size, zero);
  sbri_wide3 solved = {sbri_wide3_dot(vw, b), sbri_wide3_dot(wu, b), sbri_wide3_dot(uv, b)};
  return sbri_wide3_scale((sbri_wide3){sbri_wide_select(good, solved.x, b.x),
                              sbri_wide_select(good, solved.y, b.y), sbri_wide_select(good, solved.z, b.z)},
      fraction);
}

/* Rotation nearest to the matrix `a` (columns), starting at `q`. */
SBRI_INLINE sbri_wide_columns sbri_wide_nearest_rotation(const sbri_wide3 a[3], sbri_wide q[4]) {
  sbri_wide half = sbri_wide_all(0.5f), one = sbri_wide_all(1);
  sbri_wide_columns r = sbri_wide_columns_of(q);
  for (int iteration = 0; iteration < SBRI_ROTATION_ITERATIONS; iteration++) {
    /* In world axes: the columns of A R^T = sum a_k r_k^T. */
    sbri_wide m[3][3];
    const sbri_wide *rows[3][3] = {
        {&a[0].x, &a[1].x, &a[2].x}, {&a[0].y, &a[1].y, &a[2].y}, {&a[0].z, &a[1].z, &a[2].z}};
    for (int i = 0; i < 3; i++) {
      m[i][0] = *rows[i][0] * r.at[0].x + *rows[i][1] * r.at[1].x + *rows[i][2] * r.at[2].x;
      m[i][1] = *rows[i][0] * r.at[0].y + *rows[i][1] * r.at[1].y + *rows[i][2] * r.at[2].y;
      m[i][2] = *rows[i][0] * r.at[0].z + *rows[i][1] * r.at[1].z + *rows[i][2] * r.at[2].z;
    }
    sbri_wide zero = sbri_wide_all(0);
    const sbri_wide g[6] = {m[1][1] + m[2][2], m[2][2] + m[0][0], m[0][0] + m[1][1],
        zero - half * (m[0][1] + m[1][0]), zero - half * (m[1][2] + m[2][1]),
        zero - half * (m[2][0] + m[0][2])};
    sbri_wide3 axis = {m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]};
    sbri_wide3 w = sbri_wide_solve(g, axis, 1e-4f);
    /* Cayley transform: exact to third order, at most 180 degrees. */
    sbri_wide x = half * w.x, y = half * w.y, z = half * w.z;
    sbri_wide next[4] = {q[0] + x * q[3] + y * q[2] - z * q[1], q[1] + y * q[3] + z * q[0] - x * q[2],
        q[2] + z * q[3] + x * q[1] - y * q[0], q[3] - x * q[0] - y * q[1] - z * q[2]};
    sbri_wide size =
        one / sbri_wide_sqrt(next[0] * next[0] + next[1] * next[1] + next[2] * next[2] + next[3] * next[3]);
    for (int k = 0; k < 4; k++) q[k] = next[k] * size;
    r = sbri_wide_columns_of(q);
  }
  return r;
}

typedef struct sbri_wide_rigid_motion {
  sbri_wide3 drift, angular_velocity; /* linear velocity of the region's centre; angular velocity */
} sbri_wide_rigid_motion;

/* Best fit of a rigid motion to the velocities. */
SBRI_INLINE sbri_wide_rigid_motion sbri_region_rigid_motion(const sbri_island_tick *t,
    const sbri_region_block *block, const sbri_region_member *members, uint32_t lane, sbri_wide3 center) {
  sbri_wide zero = sbri_wide_all(0), whole = sbri_wide_load(block->inverse_sums + lane);
  sbri_wide g[6] = {zero, zero, zero, zero, zero, zero};
  sbri_wide_rigid_motion s = {{zero, zero, zero}, {zero, zero, zero}};
  for (uint32_t i = 0; i < block->member_count; i++) {
    sbri_wide k = sbri_wide_load(members[i].stiffness + lane);
    sbri_wide3 r = sbri_wide3_sub(sbri_wide_gather(t->positions, members[i].slots + lane), center);
    sbri_wide3 v = sbri_wide_gather(t->scratch.velocity_points, members[i].slots + lane);
    s.drift = sbri_wide3_add(s.drift, sbri_wide3_scale(v, k));
    s.angular_velocity = sbri_wide3_add(s.angular_velocity, sbri_wide3_scale(sbri_wide3_cross(r, v), k));
    g[0] = g[0] + k * (r.y * r.y + r.z * r.z), g[1] = g[1] + k * (r.z * r.z + r.x * r.x);
    g[2] = g[2] + k * (r.x * r.x + r.y * r.y), g[3] = g[3] - k * r.x * r.y;
    g[4] = g[4] - k * r.y * r.z, g[5] = g[5] - k * r.z * r.x;
  }
  s.drift = sbri_wide3_scale(s.drift, whole);
  s.angular_velocity = sbri_wide_solve(g, s.angular_velocity, 1e-5f);
  return s;
}

/* Present centre and rotation of eight regions. */
typedef struct sbri_region_pose {
  sbri_wide3 center;
  sbri_wide_columns rotation;
  sbri_wide_rigid_motion rigid_motion;
} sbri_region_pose;

SBRI_INLINE sbri_region_pose sbri_region_pose_of(const sbri_island_tick *t, const sbri_region_block *block,
    const sbri_region_member *members, uint32_t lane, float *rotations) {
  sbri_wide zero = sbri_wide_all(0), q[4];
  sbri_wide3 none = {zero, zero, zero}, center = none, a[3] = {none, none, none};
  for (int k = 0; k < 4; k++) q[k] = sbri_wide_load(rotations + k * SBRI_BLOCK + lane);
  /* Relative to the first point, for precision. */
  sbri_wide3 first = sbri_wide_gather(t->positions, members->slots + lane);
  for (uint32_t i = 0; i < block->member_count; i++) {
    sbri_wide k = sbri_wide_load(members[i].stiffness + lane);
    sbri_wide3 x = sbri_wide3_sub(sbri_wide_gather(t->positions, members[i].slots + lane), first);
    x = sbri_wide3_scale(x, k);
    center = sbri_wide3_add(center, x);
    /* The sum of k times offsets is 0, so the centre is not needed yet. */
    for (int axis = 0; axis < 3; axis++)
      a[axis] = sbri_wide3_add(a[axis], sbri_wide3_scale(x, sbri_wide_load(members[i].offsets[axis] + lane)));
  }
  sbri_region_pose pose = {.rigid_motion = {none, none}};
  pose.center = sbri_wide3_add(first, sbri_wide3_scale(center, sbri_wide_load(block->inverse_sums + lane)));
  pose.rotation = sbri_wide_nearest_rotation(a, q);
  for (int k = 0; k < 4; k++) sbri_wide_store(rotations + k * SBRI_BLOCK + lane, q[k]);
  if (block->damping_s > 0)
    pose.rigid_motion = sbri_region_rigid_motion(t, block, members, lane, pose.center);
  return pose;
}

SBRI_INLINE sbri_wide3 sbri_region_force(const sbri_island_tick *t, const sbri_region_member *m,
    uint32_t lane, const sbri_region_pose *pose, float damping_s) {
  sbri_wide3 offset = {sbri_wide_load(m->offsets[0] + lane), sbri_wide_load(m->offsets[1] + lane),
      sbri_wide_load(m->offsets[2] + lane)};
  sbri_wide3 from_center = sbri_wide3_sub(sbri_wide_gather(t->positions, m->slots + lane), pose->center);
  sbri_wide3 f = sbri_wide3_sub(sbri_wide_rotated(&pose->rotation, offset), from_center);
  if (damping_s > 0) {
    sbri_wide3 v = sbri_wide3_sub(
        sbri_wide_gather(t->scratch.velocity_points, m->slots + lane), pose->rigid_motion.drift);
    v = sbri_wide3_sub(v, sbri_wide3_cross(pose->rigid_motion.angular_velocity, from_center));
    f = sbri_wide3_sub(f, sbri_wide3_scale(v, sbri_wide_all(damping_s)));
  }
  return sbri_wide3_scale(f, sbri_wide_load(m->stiffness + lane));
}

/* Visits the points of all eight regions in turn. Regions of a block may share points, and the order of sums
 * must not depend on the SIMD width. */
static inline void sbri_compute_region_block_forces(
    const sbri_island_tick *t, const sbri_region_block *block, float *rotations) {
  const sbri_region_member *members = t->island->regions.members + block->first_member;
  sbri_region_pose poses[SBRI_BLOCK / SBRI_LANES];
  for (uint32_t group = 0; group < SBRI_BLOCK / SBRI_LANES; group++)
    poses[group] = sbri_region_pose_of(t, block, members, group * SBRI_LANES, rotations);
  for (uint32_t i = 0; i < block->member_count; i++)
    for (uint32_t group = 0; group < SBRI_BLOCK / SBRI_LANES; group++) {
      uint32_t lane = group * SBRI_LANES;
      sbri_wide_scatter_add(t->scratch.element_forces, members[i].slots + lane,
          sbri_region_force(t, &members[i], lane, &poses[group], block->damping_s));
    }
}

/* Adds the forces of the island's regions to t->element_forces, N, which is zero before if there are no
 * tetrahedra. */
static inline void sbri_compute_region_forces(const sbri_island_tick *t) {
  const sbri_island *island = t->island;
  if (island->tetrahedra.block_count == 0)
    memset(t->scratch.element_forces, 0, island->slot_count * sizeof *t->scratch.element_forces);
  for (uint32_t b = 0; b < island->regions.block_count; b++)
    sbri_compute_region_block_forces(
        t, &island->regions.blocks[b], t->solids.rotations + 4 * SBRI_BLOCK * (size_t)b);
}

#endif
