/* The impulses of touches that act on each other.
 *
 * What each needs is found in turn, corrected by what the others have left of it, never pulling and never
 * rubbing by more than its friction (projected Gauss-Seidel over gathered impulses; E. Catto, Iterative
 * Dynamics with Temporal Coherence, 2005), the three directions of a touch at once where it sticks; to and
 * fro. What that has changed is a gradient of what it lowers: each pass goes on along the ways of those
 * before as conjugate gradients do (M. Silcowitz-Hansen, S. Niebe, K. Erleben, A nonsmooth nonlinear
 * conjugate gradient method for interactive contact force problems, 2010), or a tower would need a pass for
 * nearly every pair of its boxes. */
#include "meet/settle.h"

enum { PASSES = 60 }; /* at most */
/* A pass that changes no speed by more is the last. */
static const float SETTLED_M_S = 2e-5f;
/* m^2/s^2: slower across than this is no direction. */
static const float NO_SLIP = 1e-20f;

static sbf_vec3 answer(const float m[6], sbf_vec3 v) {
  return sbri_vec3(m[0] * v.x + m[3] * v.y + m[4] * v.z, m[3] * v.x + m[1] * v.y + m[5] * v.z,
      m[4] * v.x + m[5] * v.y + m[2] * v.z);
}

static sbf_vec3 impulse_of(const sbri_meet_row *r) {
  return sbri_add_scaled(r->rub, r->normal, r->gain);
}

static sbf_vec3 within_friction(const sbri_meet_row *r, sbf_vec3 rub, float gain) {
  float most = r->friction * gain, size = sbri_dot(rub, rub);
  return size > most * most ? sbri_scale(rub, most / sqrtf(size)) : rub;
}

static void take(sbri_meet_row *r, float gain, sbf_vec3 rub) {
  sbf_vec3 before = impulse_of(r);
  r->gain = gain, r->rub = rub;
  sbri_meet_give(r, sbri_sub(impulse_of(r), before));
}

/* Returns the square of the speed that it has changed. */
static float correct(sbri_meet_row *r) {
  if (!r->bears) return 0;
  sbf_vec3 n = r->normal, before = impulse_of(r), off = sbri_sub(r->wanted, sbri_meet_between(r));
  float along = sbri_dot(n, off), gain = r->gain + r->mass * along;
  if (!(gain > 0) && r->gain == 0) return 0;
  sbf_vec3 sticks = sbri_add(before, answer(r->block, off));
  float bears = sbri_dot(sticks, n), most = r->friction * bears;
  sbf_vec3 rub = sbri_add_scaled(sticks, n, -bears);
  if (bears > 0 && sbri_dot(rub, rub) <= most * most) {
    take(r, bears, rub);
  } else {
    if (!(gain > 0)) gain = 0;
    sbf_vec3 side = sbri_add_scaled(off, n, -along);
    float slip = sbri_dot(side, side);
    rub = slip > NO_SLIP ? sbri_add_scaled(r->rub, side, slip / sbri_dot(side, answer(r->eases, side)))
                         : r->rub;
    take(r, gain, within_friction(r, rub, gain));
  }
  sbf_vec3 change = sbri_sub(impulse_of(r), before);
  return sbri_dot(change, change) / (r->mass * r->mass);
}

/* On along the way, as far as a touch may. */
static void go_on(sbri_meet_row *r, float share) {
  sbf_vec3 p = sbri_add_scaled(impulse_of(r), r->way, share);
  float gain = sbri_dot(p, r->normal);
  sbf_vec3 rub = sbri_add_scaled(p, r->normal, -gain);
  if (!(gain > 0)) gain = 0;
  take(r, gain, within_friction(r, rub, gain));
}

void sbri_meet_settle(sbri_meet_row *rows, uint32_t count) {
  const float settled = SETTLED_M_S * SETTLED_M_S;
  float last = 0;
  for (uint32_t i = 0; i < count; i++) rows[i].way = sbri_vec3(0, 0, 0);
  for (int pass = 0; pass < PASSES; pass++) {
    float most = 0, sum = 0;
    for (uint32_t i = 0; i < count; i++) {
      rows[i].change = sbri_scale(impulse_of(&rows[i]), -1);
      most = fmaxf(most, correct(&rows[i]));
    }
    for (uint32_t i = count; i-- > 0;) most = fmaxf(most, correct(&rows[i]));
    if (most < settled) return;
    for (uint32_t i = 0; i < count; i++) {
      sbri_meet_row *r = &rows[i];
      if (!r->bears) continue;
      r->change = sbri_add(r->change, impulse_of(r));
      sum += sbri_dot(r->change, r->change) / r->mass;
    }
    float share = last > 0 && sum <= last ? sum / last : 0;
    last = sum;
    for (uint32_t i = 0; i < count; i++) {
      sbri_meet_row *r = &rows[i];
      if (!r->bears) continue;
      if (share > 0) go_on(r, share);
      r->way = sbri_add_scaled(r->change, r->way, share);
    }
  }
}
