/* Bodies that nothing twists.
 *
 * Over a step h the angular momentum p, seen from the body, turns backwards by what the body turns forwards,
 * and the body turns at w = I^-1 (p + p') / 2, the implicit midpoint rule of Euler's equation:
 *   (1 + h/2 w^) p' = (1 - h/2 w^) p,      R' = R cay(h w).
 * The angular momentum in space stays what it is by construction, and p' - p is square to w, so that the
 * energy stays too (Lewis and Simo, Conserving algorithms for the dynamics of Hamiltonian systems on Lie
 * groups, 1994): a body that tumbles about its middle axis does so for ever, at any step. */
#include "rigid/rigid_state.h"

static sbf_vec3 times(sbf_vec3 a, sbf_vec3 b) {
  return (sbf_vec3){a.x * b.x, a.y * b.y, a.z * b.z};
}

/* p turned backwards by what cay turns forwards, a being half the turn: (1 + a^)^-1 (1 - a^) p. */
static sbf_vec3 turned_back(sbf_vec3 a, sbf_vec3 p) {
  float square = sbri_dot(a, a), share = 1 / (1 + square), along = 2 * sbri_dot(a, p);
  sbf_vec3 across = sbri_cross(a, p);
  return (sbf_vec3){((1 - square) * p.x + along * a.x - 2 * across.x) * share,
      ((1 - square) * p.y + along * a.y - 2 * across.y) * share,
      ((1 - square) * p.z + along * a.z - 2 * across.z) * share};
}

/* Each pass leaves of the error about as much as the body turns in half a step. */
static int passes_for(float square) {
  return square < 1e-9f ? 0 : square < 1e-6f ? 2 : square < 1e-3f ? 3 : 6;
}

sbf_vec3 sbri_free_turn(
    const sbri_rigid_body *body, sbf_quat turn, sbf_vec3 spin, float step_s, sbf_quat *to) {
  sbf_vec3 p = sbri_rotate(sbri_quat_conjugate(turn), spin), w = times(body->inverse_inertia, p);
  sbf_vec3 half = sbri_scale(w, 0.5f * step_s);
  for (int pass = passes_for(sbri_dot(half, half)); pass > 0; pass--) {
    w = times(body->inverse_inertia, sbri_scale(sbri_add(p, turned_back(half, p)), 0.5f));
    half = sbri_scale(w, 0.5f * step_s);
  }
  *to = sbri_quat_normalize(sbri_quat_multiply(turn, (sbf_quat){half.x, half.y, half.z, 1}));
  return sbri_rotate(turn, w);
}

sbf_vec3 sbri_spin_velocity(const sbri_rigid_body *body, sbf_quat turn, sbf_vec3 spin) {
  sbf_vec3 p = sbri_rotate(sbri_quat_conjugate(turn), spin);
  return sbri_rotate(turn, times(body->inverse_inertia, p));
}

sbf_vec3 sbri_spin_from(const sbri_rigid_body *body, sbf_quat turn, sbf_vec3 velocity) {
  sbf_vec3 w = sbri_rotate(sbri_quat_conjugate(turn), velocity);
  return sbri_rotate(turn, times(body->inertia, w));
}
