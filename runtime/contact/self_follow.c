/* Updates self-contacts in every substep. With planes fixed for a whole tick, points that rotate about a fold
 * would approach within the tick and be lifted in the next; that adds energy, and they would swing for ever.
 */
#include "collide/edge_query.h"
#include "contact/self_contacts.h"
#include "contact/self_query.h"

/* A contact point farther beside its triangle than this fraction of it keeps its barycentric weights. */
static const float BESIDE = 0.5f;

/* Barycentric weights of x projected onto a triangle's plane. */
static void over_plane(sbf_vec3 x, const sbf_vec3 p[3], float weights[3]) {
  sbf_vec3 ab = sbri_sub(p[1], p[0]), ac = sbri_sub(p[2], p[0]), off = sbri_sub(x, p[0]);
  float bb = sbri_dot(ab, ab), bc = sbri_dot(ab, ac), cc = sbri_dot(ac, ac), b = sbri_dot(ab, off),
        c = sbri_dot(ac, off), whole = bb * cc - bc * bc;
  if (!(whole > 0)) return;
  weights[1] = (cc * b - bc * c) / whole, weights[2] = (bb * c - bc * b) / whole;
  weights[0] = 1 - weights[1] - weights[2];
}

/* On a side's line, if the place was on that. */
static void over_side(sbf_vec3 x, const sbf_vec3 p[3], float weights[3]) {
  int from = 0, to = 2;
  while (from < 2 && weights[from] == 0) from++;
  while (to > from && weights[to] == 0) to--;
  sbf_vec3 side = sbri_sub(p[to], p[from]);
  float length2 = sbri_dot(side, side);
  if (!(length2 > 0)) return;
  weights[to] = sbri_dot(sbri_sub(x, p[from]), side) / length2, weights[from] = 1 - weights[to];
}

static bool follow_point(const sbf_vec3 p[4], float weights[4]) {
  float on[3] = {-weights[1], -weights[2], -weights[3]};
  if (on[0] != 0 && on[1] != 0 && on[2] != 0)
    over_plane(p[0], p + 1, on);
  else
    over_side(p[0], p + 1, on);
  for (int k = 0; k < 3; k++)
    if (!(on[k] >= -BESIDE && on[k] <= 1 + BESIDE)) return false;
  for (int k = 0; k < 3; k++) weights[1 + k] = -on[k];
  return true;
}

static bool follow_edges(const sbf_vec3 p[4], float weights[4]) {
  float fractions[2];
  if (!sbri_lines_cross(p, p + 2, fractions)) return false;
  for (int k = 0; k < 2; k++)
    if (!(fractions[k] >= 0 && fractions[k] <= 1)) return false;
  weights[0] = 1 - fractions[0], weights[1] = fractions[0], weights[2] = fractions[1] - 1,
  weights[3] = -fractions[1];
  return true;
}

void sbri_self_contact_update(const sbri_island_tick *t, sbri_soft_contact *contact) {
  float weights[4];
  sbf_vec3 p[4], off = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    weights[k] = contact->sample.weights[k];
    p[k] = sbri_self_position(t->positions, contact->sample.slots[k]);
  }
  if (!(contact->edges ? follow_edges : follow_point)(p, weights)) return;
  for (int k = 0; k < 4; k++) off = sbri_add_scaled(off, p[k], weights[k]);
  float distance = sbri_length(off), along = sbri_dot(off, contact->normal);
  if (!(fabsf(along) > 0.5f * distance) || distance < 1e-6f) return; /* it does not say which side is which */
  sbri_sample s = sbri_self_sample(t->island, contact->sample.slots, weights);
  if (!(s.mass_kg > 0)) return;
  contact->sample = s;
  contact->normal = sbri_scale(off, (along < 0 ? -1 : 1) / distance);
  contact->friction_impulse = sbri_add_scaled(
      contact->friction_impulse, contact->normal, -sbri_dot(contact->friction_impulse, contact->normal));
}
