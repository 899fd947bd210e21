#include "soft/solvers/slide_damping.h"

#include "math/trig.h"
#include "math/vec3.h"
#include "soft/solvers/rigid_motion.h"
#include "soft/solvers/soft_contacts.h"

/* The constant k. Blocks of 0.05 to 0.15 by 0.3 m, of 10 kPa to 1 MPa and Poisson's ratios up to 0.45, slide
 * down slopes and stop on them as Coulomb predicts with k >= 3 for friction coefficients up to 1.2; with k =
 * 1 only up to 1. With k = 3, jelly that slides at 3 m/s still flutters and loses 1.4e-3 of gravity. */
static const float DAMPING = 4;

/* Maximum separation of a point in contact, m. */
static const float CONTACT_DISTANCE_M = 1e-5f;
/* Speed below which a contact sticks, m/s. */
static const float STICKS_M_S = 1e-6f;

/* For bodies whose points have one ground plane each; all contacts have equal weight. */
static void add_planes(
    const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule, sbri_sliding *to) {
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    uint32_t block = slot / SBRI_BLOCK, lane = slot % SBRI_BLOCK;
    if (!t->contacts.near_ground[block]) continue;
    const float *plane = t->contacts.planes + 4 * SBRI_BLOCK * (size_t)block + lane;
    sbf_vec3 n = {plane[0], plane[SBRI_BLOCK], plane[2 * SBRI_BLOCK]};
    sbf_vec3 x = {t->positions[slot].x, t->positions[slot].y, t->positions[slot].z};
    if (sbri_dot(n, x) - plane[3 * SBRI_BLOCK] > CONTACT_DISTANCE_M) continue;
    sbf_vec3 v = sbri_slot_velocity(t, t->velocities, slot);
    sbf_vec3 sideways = sbri_add_scaled(v, n, -sbri_dot(n, v));
    float friction = rule->frictions ? rule->frictions[slot] : rule->friction, speed = sbri_length(sideways);
    to->load += 1, to->limit += friction;
    if (speed > STICKS_M_S) to->friction = sbri_add_scaled(to->friction, sideways, -friction / speed);
  }
}

/* Minimum fraction of velocities that may stay: a symplectic step h whose velocities are scaled by k after
 * the positions moved is stable while (w h)^2 < 2 (1 + k). */
static float min_fraction(const sbri_island_tick *t, float step_s) {
  float swing = step_s * (float)t->island->stability.fastest_rad_s;
  float fraction = 0.5f * swing * swing * *t->solids.stiffening * *t->solids.max_flow_stretch - 1;
  return fraction < 1 ? fraction : 1;
}

void sbri_slide_damp(const sbri_island_tick *t, const sbri_body *body, const sbri_contact_rule *rule) {
  if (!(body->damping.sliding_rad_s > 0)) return;
  sbri_sliding sliding = sbri_soft_contacts_sum_sliding(t, body, rule);
  if (!body->contact.samples) add_planes(t, body, rule, &sliding);
  float friction = sbri_length(sliding.friction);
  if (!(friction > 0)) return;
  float coefficient = sliding.limit / sliding.load, fraction = friction / sliding.limit;
  float rate = 2 * DAMPING * coefficient * coefficient * fraction * body->damping.sliding_rad_s;
  float remaining = sbri_exp(-rate * rule->step_s), min = min_fraction(t, rule->step_s);
  sbri_rigid_motion_damp(t->island, body, t->positions, t->velocities, remaining > min ? remaining : min, 0);
}
