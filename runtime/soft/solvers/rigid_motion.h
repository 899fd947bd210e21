/* Rigid motion of a soft body: the one with the same momentum and angular momentum.
 *
 * Written for the lanes of the including file; see model/kernels.h. */
#ifndef SBRI_RIGID_MOTION_H
#define SBRI_RIGID_MOTION_H

#include "math/reduce.h"
#include "math/trig.h"
#include "math/vec3.h"
#include "model/runtime_model.h"

typedef struct sbri_rigid_motion {
  float mass_kg;
  sbf_vec3 center, velocity, angular_velocity; /* m, m/s, rad/s about the centre */
  float inertia[6]; /* about the centre, kg m^2: xx, yy, zz, xy, xz, yz of the matrix */
} sbri_rigid_motion;

enum { SBRI_RIGID_SUMS = 9 };

static inline sbri_wide3 sbri_velocity_at(const float *velocities, uint32_t slot) {
  const float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
  return (sbri_wide3){sbri_wide_load(v), sbri_wide_load(v + SBRI_BLOCK), sbri_wide_load(v + 2 * SBRI_BLOCK)};
}

/* Angular velocity of an angular momentum for an inertia matrix (xx, yy, zz, xy, xz, yz). A millionth of the
 * trace is added, so that a body on a line does not rotate about it. */
static inline sbf_vec3 sbri_angular_velocity_from_inertia(const float inertia[6], sbf_vec3 momentum) {
  float min = 1e-6f * (inertia[0] + inertia[1] + inertia[2]);
  float a = inertia[0] + min, b = inertia[1] + min, c = inertia[2] + min;
  float d = inertia[3], e = inertia[4], f = inertia[5];
  sbf_vec3 x = {b * c - f * f, e * f - c * d, d * f - b * e};
  sbf_vec3 y = {x.y, a * c - e * e, d * e - a * f}, z = {x.z, y.z, a * b - d * d};
  float determinant = a * x.x + d * x.y + e * x.z;
  if (!(determinant > 0)) return (sbf_vec3){0, 0, 0};
  return sbri_scale(
      (sbf_vec3){sbri_dot(x, momentum), sbri_dot(y, momentum), sbri_dot(z, momentum)}, 1 / determinant);
}

/* Moment of inertia about a unit axis. */
static inline float sbri_inertia_about(const float inertia[6], sbf_vec3 u) {
  float even = inertia[0] * u.x * u.x + inertia[1] * u.y * u.y + inertia[2] * u.z * u.z;
  return even + 2 * (inertia[3] * u.x * u.y + inertia[4] * u.x * u.z + inertia[5] * u.y * u.z);
}

/* Rigid motion of the body's free points; the arrays belong to its island. */
static inline sbri_rigid_motion sbri_rigid_motion_find(
    const sbri_island *island, const sbri_body *body, const sbri_point *positions, const float *velocities) {
  float lanes[SBRI_RIGID_SUMS][SBRI_BLOCK] = {{0}}, sums[SBRI_RIGID_SUMS];
  sbri_rigid_motion motion = {0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0}};
  if (body->slots.begin == body->slots.end) return motion;
  const sbri_point *near = &positions[body->slots.begin]; /* sums relative to it lose fewer bits */
  sbri_wide nx = sbri_wide_all(near->x), ny = sbri_wide_all(near->y), nz = sbri_wide_all(near->z);
  for (uint32_t lane = 0; lane < SBRI_BLOCK;
       lane += SBRI_LANES) { /* lane by lane, so that sums stay in registers */
    sbri_wide a = sbri_wide_all(0), b = a, c = a, d = a, e = a, f = a, g = a;
    for (uint32_t slot = body->slots.begin + lane; slot < body->slots.end; slot += SBRI_BLOCK) {
      sbri_wide m = sbri_wide_load(island->masses + slot);
      sbri_wide3 x = sbri_wide_load_points(positions + slot), v = sbri_velocity_at(velocities, slot);
      a = a + m;
      b = b + m * (x.x - nx), c = c + m * (x.y - ny), d = d + m * (x.z - nz);
      e = e + m * v.x, f = f + m * v.y, g = g + m * v.z;
    }
    const sbri_wide of[7] = {a, b, c, d, e, f, g};
    for (int i = 0; i < 7; i++) sbri_wide_store(lanes[i] + lane, of[i]);
  }
  for (int i = 0; i < 7; i++) sums[i] = sbri_tree_sum(lanes[i]);
  if (!(sums[0] > 0)) return motion;
  float s = 1 / sums[0];
  motion.mass_kg = sums[0];
  motion.center = (sbf_vec3){near->x + sums[1] * s, near->y + sums[2] * s, near->z + sums[3] * s};
  motion.velocity = (sbf_vec3){sums[4] * s, sums[5] * s, sums[6] * s};

  sbri_wide cx = sbri_wide_all(motion.center.x), cy = sbri_wide_all(motion.center.y);
  sbri_wide cz = sbri_wide_all(motion.center.z);
  sbri_wide ux = sbri_wide_all(motion.velocity.x), uy = sbri_wide_all(motion.velocity.y);
  sbri_wide uz = sbri_wide_all(motion.velocity.z);
  for (uint32_t lane = 0; lane < SBRI_BLOCK; lane += SBRI_LANES) {
    sbri_wide a = sbri_wide_all(0), b = a, c = a, d = a, e = a, f = a, g = a, h = a, i = a;
    for (uint32_t slot = body->slots.begin + lane; slot < body->slots.end; slot += SBRI_BLOCK) {
      sbri_wide m = sbri_wide_load(island->masses + slot);
      sbri_wide3 x = sbri_wide_load_points(positions + slot), v = sbri_velocity_at(velocities, slot);
      sbri_wide rx = x.x - cx, ry = x.y - cy, rz = x.z - cz, wx = v.x - ux, wy = v.y - uy, wz = v.z - uz;
      a = a + m * (ry * wz - rz * wy), b = b + m * (rz * wx - rx * wz), c = c + m * (rx * wy - ry * wx);
      d = d + m * (ry * ry + rz * rz), e = e + m * (rx * rx + rz * rz), f = f + m * (rx * rx + ry * ry);
      g = g - m * (rx * ry), h = h - m * (rx * rz), i = i - m * (ry * rz);
    }
    const sbri_wide of[SBRI_RIGID_SUMS] = {a, b, c, d, e, f, g, h, i};
    for (int k = 0; k < SBRI_RIGID_SUMS; k++) sbri_wide_store(lanes[k] + lane, of[k]);
  }
  for (int i = 0; i < SBRI_RIGID_SUMS; i++) sums[i] = sbri_tree_sum(lanes[i]);
  for (int i = 0; i < 6; i++) motion.inertia[i] = sums[3 + i];
  motion.angular_velocity =
      sbri_angular_velocity_from_inertia(sums + 3, (sbf_vec3){sums[0], sums[1], sums[2]});
  return motion;
}

/* Keeps the fraction `kept` of each velocity relative to the rigid motion, which does not change. Moves
 * points by the removed velocity times `ahead_s`. */
static inline void sbri_rigid_motion_damp(const sbri_island *island, const sbri_body *body,
    sbri_point *positions, float *velocities, float kept, float ahead_s) {
  sbri_rigid_motion m = sbri_rigid_motion_find(island, body, positions, velocities);
  sbri_wide k = sbri_wide_all(kept), zero = sbri_wide_all(0), ahead = sbri_wide_all(ahead_s);
  sbri_wide sx = sbri_wide_all(m.angular_velocity.x), sy = sbri_wide_all(m.angular_velocity.y),
            sz = sbri_wide_all(m.angular_velocity.z);
  sbri_wide cx = sbri_wide_all(m.center.x), cy = sbri_wide_all(m.center.y), cz = sbri_wide_all(m.center.z);
  sbri_wide vx = sbri_wide_all(m.velocity.x), vy = sbri_wide_all(m.velocity.y),
            vz = sbri_wide_all(m.velocity.z);
  for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot += SBRI_LANES) {
    sbri_wide3 x = sbri_wide_load_points(positions + slot), v = sbri_velocity_at(velocities, slot);
    sbri_wide rx = x.x - cx, ry = x.y - cy, rz = x.z - cz;
    sbri_wide ux = vx + (sy * rz - sz * ry), uy = vy + (sz * rx - sx * rz), uz = vz + (sx * ry - sy * rx);
    sbri_mask real = sbri_wide_load(island->masses + slot) > zero;
    float *to = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    ux = sbri_wide_select(real, ux + (v.x - ux) * k, v.x);
    uy = sbri_wide_select(real, uy + (v.y - uy) * k, v.y);
    uz = sbri_wide_select(real, uz + (v.z - uz) * k, v.z);
    sbri_wide_store(to, ux);
    sbri_wide_store(to + SBRI_BLOCK, uy);
    sbri_wide_store(to + 2 * SBRI_BLOCK, uz);
    if (!(ahead_s > 0)) continue;
    x.x = x.x + ahead * (v.x - ux), x.y = x.y + ahead * (v.y - uy), x.z = x.z + ahead * (v.z - uz);
    sbri_wide_store_points(positions + slot, x);
  }
}

/* The same with a rate per slot, 1/s, over `time_s` seconds. Restores the rigid motion afterwards. */
static inline void sbri_rigid_motion_damp_each(const sbri_island *island, const sbri_body *body,
    sbri_point *positions, float *velocities, const float *rates, float time_s, float ahead_s) {
  sbri_rigid_motion was = sbri_rigid_motion_find(island, body, positions, velocities), now;
  sbf_vec3 move = was.velocity, angular_velocity = was.angular_velocity;
  for (int pass = 0; pass < 2; pass++) {
    for (uint32_t slot = body->slots.begin; slot < body->slots.end; slot++) {
      sbri_point *x = &positions[slot];
      float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
      if (!(island->masses[slot] > 0)) continue;
      sbf_vec3 r = sbri_sub((sbf_vec3){x->x, x->y, x->z}, was.center);
      sbf_vec3 u = sbri_add(move, sbri_cross(angular_velocity, r)),
               w = {v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]}, had = w;
      if (pass == 0)
        w = sbri_add_scaled(u, sbri_sub(w, u), sbri_exp(-rates[slot] * time_s));
      else
        w = sbri_add(w, u);
      v[0] = w.x, v[SBRI_BLOCK] = w.y, v[2 * SBRI_BLOCK] = w.z;
      x->x += ahead_s * (had.x - w.x), x->y += ahead_s * (had.y - w.y), x->z += ahead_s * (had.z - w.z);
    }
    now = sbri_rigid_motion_find(island, body, positions, velocities);
    move = sbri_sub(was.velocity, now.velocity),
    angular_velocity = sbri_sub(was.angular_velocity, now.angular_velocity);
  }
}

#endif
