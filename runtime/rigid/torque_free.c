/* Torque-free rotation.
 *
 * In the body's frame the angular momentum p rotates opposite to the body. The body's angular velocity over a
 * step h is w = I^-1 (p + p') / 2, the implicit midpoint rule of Euler's equation:
 *   (1 + h/2 w^) p' = (1 - h/2 w^) p,      R' = R cay(h w).
 * The angular momentum in space is constant by construction. p' - p is perpendicular to w, so the energy is
 * constant too (Lewis and Simo, Conserving algorithms for the dynamics of Hamiltonian systems on Lie groups,
 * 1994): a body that tumbles about its middle axis keeps tumbling, at any step size. */
#include "rigid/torque_free.h"

static sbf_vec3 times(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* Rotates p by the inverse Cayley transform of a, half the rotation: (1 + a^)^-1 (1 - a^) p. */
static sbf_vec3 inverse_rotated(sbf_vec3 a, sbf_vec3 p) {
  float square = sbri_dot(a, a), fraction = 1 / (1 + square), along = 2 * sbri_dot(a, p);
  sbf_vec3 across = sbri_cross(a, p);
  return (sbf_vec3){((1 - square) * p.x + along * a.x - 2 * across.x) * fraction,
      ((1 - square) * p.y + along * a.y - 2 * across.y) * fraction,
      ((1 - square) * p.z + along * a.z - 2 * across.z) * fraction};
}

/* An iteration reduces the error by a factor of about half the rotation of a step. */
static int passes_for(float square) {
  return square < 1e-9f ? 0 : square < 1e-6f ? 2 : square < 1e-3f ? 3 : 6;
}

sbf_vec3 sbri_torque_free_rotation(
    const sbri_rigid_body *body, sbf_quat rotation, sbf_vec3 angular_momentum, float step_s, sbf_quat *to) {
  sbf_vec3 p = sbri_rotate(sbri_quat_conjugate(rotation), angular_momentum),
           w = times(body->inverse_inertia, p);
  sbf_vec3 half = sbri_scale(w, 0.5f * step_s);
  for (int pass = passes_for(sbri_dot(half, half)); pass > 0; pass--) {
    w = times(body->inverse_inertia, sbri_scale(sbri_add(p, inverse_rotated(half, p)), 0.5f));
    half = sbri_scale(w, 0.5f * step_s);
  }
  *to = sbri_quat_normalize(sbri_quat_multiply(rotation, (sbf_quat){half.x, half.y, half.z, 1}));
  return sbri_rotate(rotation, w);
}

/* ---- The same operations for one body per lane ---- */

static sbri_wide3 cross(sbri_wide3 a, sbri_wide3 b) {
  return (sbri_wide3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static sbri_wide dot(sbri_wide3 a, sbri_wide3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

static sbri_wide3 scale(sbri_wide3 a, sbri_wide s) {
  return (sbri_wide3){a.x * s, a.y * s, a.z * s};
}

static sbri_wide3 add(sbri_wide3 a, sbri_wide3 b) {
  return (sbri_wide3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static sbri_wide3 rotate_by(sbri_wide3 u, sbri_wide w, sbri_wide3 v) {
  sbri_wide3 t = scale(cross(u, v), sbri_wide_all(2));
  return add(add(v, scale(t, w)), cross(u, t));
}

static sbri_wide3 all_inverse_rotated(sbri_wide3 a, sbri_wide3 p) {
  const sbri_wide one = sbri_wide_all(1), two = sbri_wide_all(2);
  sbri_wide square = dot(a, a), fraction = one / (one + square), along = two * dot(a, p);
  sbri_wide3 across = cross(a, p);
  return (sbri_wide3){((one - square) * p.x + along * a.x - two * across.x) * fraction,
      ((one - square) * p.y + along * a.y - two * across.y) * fraction,
      ((one - square) * p.z + along * a.z - two * across.z) * fraction};
}

static sbri_wide3 all_times(sbri_wide3 a, sbri_wide3 b) {
  return (sbri_wide3){a.x * b.x, a.y * b.y, a.z * b.z};
}

static sbri_wide3 chosen(sbri_mask mask, sbri_wide3 a, sbri_wide3 b) {
  return (sbri_wide3){
      sbri_wide_select(mask, a.x, b.x), sbri_wide_select(mask, a.y, b.y), sbri_wide_select(mask, a.z, b.z)};
}

void sbri_torque_free_lanes_rotate(sbri_torque_free_lanes *t, float step_s) {
  sbri_wide3 u = {sbri_wide_load(t->x), sbri_wide_load(t->y), sbri_wide_load(t->z)};
  sbri_wide w_of = sbri_wide_load(t->w), half_s = sbri_wide_all(0.5f * step_s);
  sbri_wide3 inverse_mass = {sbri_wide_load(t->inverse_inertia[0]), sbri_wide_load(t->inverse_inertia[1]),
      sbri_wide_load(t->inverse_inertia[2])};
  sbri_wide3 angular_momentum = {sbri_wide_load(t->angular_momentum[0]),
      sbri_wide_load(t->angular_momentum[1]), sbri_wide_load(t->angular_momentum[2])};
  sbri_wide3 p = rotate_by((sbri_wide3){-u.x, -u.y, -u.z}, w_of, angular_momentum),
             w = all_times(inverse_mass, p);
  sbri_wide3 half = scale(w, half_s);
  float squares[SBRI_LANES], passes[SBRI_LANES];
  int max = 0;
  sbri_wide_store(squares, dot(half, half));
  for (int k = 0; k < SBRI_LANES; k++) {
    int count = passes_for(squares[k]);
    max = count > max ? count : max;
    passes[k] = (float)count;
  }
  for (int pass = 0; pass < max; pass++) {
    sbri_mask continues = sbri_wide_load(passes) > sbri_wide_all((float)pass);
    sbri_wide3 mean = scale(add(p, all_inverse_rotated(half, p)), sbri_wide_all(0.5f));
    w = chosen(continues, all_times(inverse_mass, mean), w);
    half = scale(w, half_s);
  }
  /* rotation (half, 1) */
  sbri_wide x = w_of * half.x + u.x + u.y * half.z - u.z * half.y;
  sbri_wide y = w_of * half.y - u.x * half.z + u.y + u.z * half.x;
  sbri_wide z = w_of * half.z + u.x * half.y - u.y * half.x + u.z;
  sbri_wide r = w_of - u.x * half.x - u.y * half.y - u.z * half.z;
  sbri_wide fraction = sbri_wide_all(1) / sbri_wide_sqrt(x * x + y * y + z * z + r * r);
  sbri_wide3 velocity = rotate_by(u, w_of, w);
  sbri_wide_store(t->x, x * fraction), sbri_wide_store(t->y, y * fraction);
  sbri_wide_store(t->z, z * fraction), sbri_wide_store(t->w, r * fraction);
  sbri_wide_store(t->angular_momentum[0], velocity.x), sbri_wide_store(t->angular_momentum[1], velocity.y);
  sbri_wide_store(t->angular_momentum[2], velocity.z);
}

void sbri_torque_free_lanes_set(sbri_torque_free_lanes *t, int lane, const sbri_rigid_body *body,
    sbf_quat rotation, sbf_vec3 angular_momentum) {
  t->x[lane] = rotation.x, t->y[lane] = rotation.y, t->z[lane] = rotation.z, t->w[lane] = rotation.w;
  t->angular_momentum[0][lane] = angular_momentum.x, t->angular_momentum[1][lane] = angular_momentum.y,
  t->angular_momentum[2][lane] = angular_momentum.z;
  t->inverse_inertia[0][lane] = body->inverse_inertia.x,
  t->inverse_inertia[1][lane] = body->inverse_inertia.y;
  t->inverse_inertia[2][lane] = body->inverse_inertia.z;
}

sbf_vec3 sbri_angular_velocity_from_momentum(
    const sbri_rigid_body *body, sbf_quat rotation, sbf_vec3 angular_momentum) {
  sbf_vec3 p = sbri_rotate(sbri_quat_conjugate(rotation), angular_momentum);
  return sbri_rotate(rotation, times(body->inverse_inertia, p));
}

sbf_vec3 sbri_angular_momentum_from_velocity(
    const sbri_rigid_body *body, sbf_quat rotation, sbf_vec3 velocity) {
  sbf_vec3 w = sbri_rotate(sbri_quat_conjugate(rotation), velocity);
  return sbri_rotate(rotation, times(body->inertia, w));
}
