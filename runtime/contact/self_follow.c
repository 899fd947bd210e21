/* Updates self-contacts in every substep. With planes fixed for a whole tick, points that rotate about a fold
 * would approach within the tick and be corrected in the next; that adds energy, and they would oscillate
 * forever. */
#include "contact/self_contacts.h"
#include "contact/self_query.h"
#include "shapes/edge_query.h"

/* A contact point farther outside its triangle than this fraction of it keeps its barycentric weights. */
static const float MAX_OUTSIDE = 0.5f;

/* Barycentric weights of x projected onto a triangle's plane. */
static void project_to_plane(sbf_vec3 x, const sbf_vec3 p[3], float weights[3]) {
  sbf_vec3 ab = sbri_sub(p[1], p[0]), ac = sbri_sub(p[2], p[0]), offset = sbri_sub(x, p[0]);
  float bb = sbri_dot(ab, ab), bc = sbri_dot(ab, ac), cc = sbri_dot(ac, ac), b = sbri_dot(ab, offset),
        c = sbri_dot(ac, offset), determinant = bb * cc - bc * bc;
  if (!(determinant > 0)) return;
  weights[1] = (cc * b - bc * c) / determinant, weights[2] = (bb * c - bc * b) / determinant;
  weights[0] = 1 - weights[1] - weights[2];
}

/* Weights of x projected onto an edge, for a contact on an edge. */
static void project_to_edge(sbf_vec3 x, const sbf_vec3 p[3], float weights[3]) {
  int from = 0, to = 2;
  while (from < 2 && weights[from] == 0) from++;
  while (to > from && weights[to] == 0) to--;
  sbf_vec3 side = sbri_sub(p[to], p[from]);
  float length2 = sbri_dot(side, side);
  if (!(length2 > 0)) return;
  weights[to] = sbri_dot(sbri_sub(x, p[from]), side) / length2, weights[from] = 1 - weights[to];
}

static bool follow_point(const sbf_vec3 p[4], float weights[4]) {
  float barycentric[3] = {-weights[1], -weights[2], -weights[3]};
  if (barycentric[0] != 0 && barycentric[1] != 0 && barycentric[2] != 0)
    project_to_plane(p[0], p + 1, barycentric);
  else
    project_to_edge(p[0], p + 1, barycentric);
  for (int k = 0; k < 3; k++)
    if (!(barycentric[k] >= -MAX_OUTSIDE && barycentric[k] <= 1 + MAX_OUTSIDE)) return false;
  for (int k = 0; k < 3; k++) weights[1 + k] = -barycentric[k];
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
  sbf_vec3 p[4], offset = {0, 0, 0};
  for (int k = 0; k < 4; k++) {
    weights[k] = contact->sample.weights[k];
    p[k] = sbri_self_position(t->positions, contact->sample.slots[k]);
  }
  if (!(contact->edges ? follow_edges : follow_point)(p, weights)) return;
  for (int k = 0; k < 4; k++) offset = sbri_add_scaled(offset, p[k], weights[k]);
  float distance = sbri_length(offset), normal_part = sbri_dot(offset, contact->normal);
  if (!(fabsf(normal_part) > 0.5f * distance) || distance < 1e-6f)
    return; /* the sides are not distinguishable */
  sbri_sample s = sbri_self_sample(t->island, contact->sample.slots, weights);
  if (!(s.mass_kg > 0)) return;
  contact->sample = s;
  contact->normal = sbri_scale(offset, (normal_part < 0 ? -1 : 1) / distance);
  contact->friction_impulse = sbri_add_scaled(
      contact->friction_impulse, contact->normal, -sbri_dot(contact->friction_impulse, contact->normal));
}
