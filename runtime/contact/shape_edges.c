/* Contacts of a body's edges with convex edges of shapes. The cross product of both is a separating axis if
 * it lies between the normals of the faces beside the shape's edge (D. Gregorius, The Separating Axis Test
 * between Convex Polyhedra, 2013). An edge that has passed is moved back over it, unless a face is a shorter
 * exit. */
#include "contact/shape_edges.h"

#include "contact/sample_motion.h"
#include "model/reach.h"
#include "shapes/colliders.h"
#include "shapes/ridge_query.h"

/* Tolerance of the test whether an axis lies between the normals, as a sine. */
static const float NORMAL_TOLERANCE = 0.1f;
/* Range of weights of a sample that is extrapolated from the points of another one. */
static const float MIN_WEIGHT = -1, MAX_WEIGHT = 2;
/* Smaller weights are dropped. */
static const float MIN_PART_WEIGHT = 1e-5f;

/* ---- Samples on edges ---- */

/* Sets the effective mass of the sample; returns false if it has no free point. */
static bool set_mass(const sbri_island_tick *t, sbri_sample *s) {
  float sum = 0;
  for (int k = 0; k < 4; k++)
    if (s->slots[k] < t->island->free_count)
      sum += s->weights[k] * s->weights[k] * t->island->inverse_masses[s->slots[k]];
  s->mass_kg = sum > 0 ? 1 / sum : 0;
  return sum > 0;
}

static sbf_vec3 position(const sbri_island_tick *t, uint32_t slot) {
  const sbri_point *p = &t->positions[slot];
  return sbri_vec3(p->x, p->y, p->z);
}

/* x as a combination of the points of a nearby sample, extrapolated affinely. */
static bool extrapolate(const sbri_island_tick *t, const sbri_sample *source, sbf_vec3 x, sbri_sample *to) {
  sbf_vec3 at = position(t, source->slots[0]), offset = sbri_sub(x, at), e[3];
  for (int k = 0; k < 3; k++) e[k] = sbri_sub(position(t, source->slots[k + 1]), at);
  float determinant = sbri_dot(e[0], sbri_cross(e[1], e[2]));
  *to = *source;
  to->weights[0] = 1;
  for (int k = 0; k < 3; k++) {
    float w = sbri_dot(offset, sbri_cross(e[(k + 1) % 3], e[(k + 2) % 3])) / determinant;
    if (!(w >= MIN_WEIGHT && w <= MAX_WEIGHT)) return false;
    to->weights[k + 1] = w, to->weights[0] -= w;
  }
  return to->weights[0] >= MIN_WEIGHT && to->weights[0] <= MAX_WEIGHT && set_mass(t, to);
}

static bool sample_between(
    const sbri_island_tick *t, const sbri_sample ends[2], float fraction, sbri_sample *to) {
  const float parts[2] = {1 - fraction, fraction};
  uint32_t count = 0, slots[8];
  float weights[8];
  for (int i = 0; i < 8; i++) {
    const sbri_sample *s = &ends[i / 4];
    uint32_t slot = s->slots[i % 4], k = 0;
    float weight = parts[i / 4] * s->weights[i % 4];
    if (fabsf(weight) < MIN_PART_WEIGHT) continue; /* rounding error of a position at a corner */
    while (k < count && slots[k] != slot) k++;
    if (k == count) slots[count] = slot, weights[count++] = 0;
    weights[k] += weight;
  }
  if (count > 4) {
    sbf_vec3 x = sbri_lerp(sbri_sample_position(t, &ends[0]), sbri_sample_position(t, &ends[1]), fraction);
    return extrapolate(t, &ends[fraction > 0.5f], x, to) || extrapolate(t, &ends[fraction <= 0.5f], x, to);
  }
  *to = (sbri_sample){.vertex = UINT32_MAX};
  float sum = 0;
  for (uint32_t k = 0; k < count; k++) sum += weights[k];
  for (uint32_t k = 0; k < 4; k++) {
    to->slots[k] = k < count ? slots[k] : slots[0];
    to->weights[k] = k < count ? weights[k] / sum : 0;
  }
  return set_mass(t, to);
}

/* ---- Edges ---- */

typedef struct edge_query {
  const sbri_shape_pair *is;
  sbri_sample ends[2];
  sbri_soft_edge edge; /* in the shape's frame */
  float outer, past;
} edge_query;

/* Displacement of the whole edge to leave by the nearer one of the two faces, m. */
static float depth_by_faces(const sbri_soft_edge *edge, const sbri_shape_ridge *r) {
  float min = INFINITY;
  for (int k = 0; k < 2; k++) {
    float one = sbri_dot(r->normals[k], sbri_sub(r->at[0], edge->at[0])),
          other = sbri_dot(r->normals[k], sbri_sub(r->at[0], edge->at[1]));
    min = fminf(min, fmaxf(one, other));
  }
  return min;
}

static bool is_separating(const sbri_shape_ridge *r, sbf_vec3 n) {
  sbf_vec3 direction = sbri_sub(r->at[1], r->at[0]);
  float min = -NORMAL_TOLERANCE * sbri_length(direction);
  return sbri_dot(sbri_cross(r->normals[0], n), direction) >= min &&
         sbri_dot(sbri_cross(n, r->normals[1]), direction) >= min;
}

static void check(const edge_query *l, const sbri_shape_ridge *r) {
  const sbri_soft_edge ridge = {{r->at[0], r->at[1]}, {{0, 0, 0}, {0, 0, 0}}};
  sbri_edge_hit found;
  if (!sbri_edges_cross(&l->edge, &ridge, &found)) return;
  if (sbri_dot(found.normal, sbri_add(r->normals[0], r->normals[1])) < 0)
    found.normal = sbri_scale(found.normal, -1), found.distance = -found.distance;
  if (found.distance < -l->past || !is_separating(r, found.normal)) return;
  if (!sbri_edges_contact(&l->edge, &ridge, l->outer, &found)) return;
  if (found.distance < -SBRI_RIDGE_ON_IT_M &&
      -found.distance > SBRI_RIDGE_NEARER * depth_by_faces(&l->edge, r))
    return;
  sbri_sample s;
  if (!sample_between(l->is->tick, l->ends, found.fractions[0], &s)) return;
  sbri_shape_contact_add(l->is, &s, sbri_lerp(r->at[0], r->at[1], found.fractions[1]), found.normal);
}

static sbri_sample end_of(const sbri_shape_pair *m, uint32_t number) {
  return m->body->contact.samples ? m->body->contact.samples[number] : sbri_point_sample(m->tick, number);
}

void sbri_shape_edges_add(const sbri_shape_pair *m) {
  const sbri_island_tick *t = m->tick;
  const sbr_shape *shape = m->frame.collider->shape;
  const sbri_shape_ridges *ridges = &shape->ridges;
  if (!ridges->count || t->island->splits) return; /* torn bodies have other edges */
  edge_query l = {.is = m};
  l.past = shape->kind == SBR_SHAPE_MESH ? m->body->source->collision.inner_thickness * t->environment.scale
                                         : ridges->past_m;
  l.outer = sbri_reach_of(m->body, t->environment.scale, 0, 0);
  for (uint32_t i = 0; i < m->body->contact.coarse_edge_count; i++) {
    sbri_box box;
    for (int k = 0; k < 2; k++) {
      l.ends[k] = end_of(m, m->body->contact.coarse_edges[2 * i + (uint32_t)k]);
      sbf_vec3 x = sbri_sample_position(t, &l.ends[k]), v = sbri_sample_velocity(t, &l.ends[k]);
      sbf_vec3 end = sbri_into_shape(&m->frame, sbri_add_scaled(x, v, t->tick_s), true);
      l.edge.at[k] = sbri_into_shape(&m->frame, x, false);
      l.edge.directions[k] = sbri_sub(end, l.edge.at[k]);
      box = sbri_box_with(k ? sbri_box_with(box, l.edge.at[k]) : sbri_box_of_point(l.edge.at[k]), end);
    }
    box = sbri_box_grown(box, l.outer);
    if (!sbri_boxes_overlap(&box, &shape->bounds)) continue;
    sbri_bounds_walk walk;
    uint32_t item;
    sbri_bounds_walk_begin(&walk, &ridges->tree, box);
    while (sbri_bounds_walk_next(&walk, &item)) check(&l, &ridges->at[item]);
  }
}
