/* Resolves self-intersections. A sheet has no inside from which points could be pushed out, but its
 * intersection is a contour, which can be shortened until it vanishes.
 *
 * The contour has a corner wherever an edge of the surface crosses a triangle. If the edge moves by d
 * relative to the triangle, the corner moves by d - (d.n / e.n) e, with e along the edge and n normal to the
 * triangle. The two pieces of the contour at the corner run along R1 and R2 in the triangles beside the edge,
 * and shorten by (R1 + R2) times that motion. So d is along R1 + R2 - ((R1 + R2).e / e.n) n (after P. Volino
 * and N. Magnenat-Thalmann, Resolving Surface Collisions through Intersection Contour Minimization, 2006).
 * Contacts of points and triangles stay active meanwhile, on the present side of each point. */
#include "contact/self_query.h"
#include "shapes/sides.h"

/* Speed at which edges leave triangles, m/s, where the contour bends by this much. It is proportional to the
 * bend below that. */
static const float EXIT_M_S = 0.2f, FULL_BEND = 0.5f;
/* Minimum angle between an edge and a triangle in the formula, as a sine. */
static const float MIN_SINE = 0.1f;

typedef struct crossing_edge {
  const sbri_self_search *looking;
  uint32_t ends[2],
      beside[2]; /* slots of the ends; slots of the third corners of its triangles, or SBRI_RIM */
  sbf_vec3 from, displacement;
} crossing_edge;

static sbf_vec3 position(const crossing_edge *s, uint32_t slot) {
  return sbri_self_position(s->looking->tick->positions, slot);
}

static crossing_edge edge_of(const sbri_self_search *l, uint32_t number) {
  const uint32_t *c = l->body->self.faces + number / 3 * 3;
  crossing_edge s = {.looking = l,
      .ends = {c[number % 3], c[(number + 1) % 3]},
      .beside = {c[(number + 2) % 3], l->body->self.sides[number]}};
  s.from = position(&s, s.ends[0]);
  s.displacement = sbri_sub(position(&s, s.ends[1]), s.from);
  return s;
}

/* Adds the direction of the contour in n's triangle towards the triangle beside the edge. */
static sbf_vec3 add_contour_direction(
    const crossing_edge *s, sbf_vec3 e, sbf_vec3 n, uint32_t beside, sbf_vec3 sum) {
  if (beside == SBRI_RIM) return sum;
  sbf_vec3 inward = sbri_sub(position(s, beside), s->from);
  inward = sbri_add_scaled(inward, e, -sbri_dot(inward, e));
  sbf_vec3 contour = sbri_cross(n, sbri_cross(e, inward));
  float length = sbri_length(contour);
  if (!(length > 1e-6f * sbri_length(inward))) return sum;
  return sbri_add_scaled(sum, contour, (sbri_dot(contour, inward) < 0 ? -1 : 1) / length);
}

/* Direction in which the edge leaves the triangle with corners p; not of unit length. */
static sbf_vec3 exit_displacement(const crossing_edge *s, const sbf_vec3 p[3]) {
  sbf_vec3 none = {0, 0, 0}, e = sbri_normalize(s->displacement, none),
           n = sbri_normalize(sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0])), none);
  sbf_vec3 direction =
      add_contour_direction(s, e, n, s->beside[1], add_contour_direction(s, e, n, s->beside[0], none));
  float sine = sbri_dot(e, n);
  if (fabsf(sine) < MIN_SINE) sine = sine < 0 ? -MIN_SINE : MIN_SINE;
  return sbri_add_scaled(direction, n, -sbri_dot(direction, e) / sine);
}

/* Whether they touch at rest. Such parts count as connected. */
static bool are_together(const crossing_edge *s, const uint32_t *c) {
  const sbri_point *rest = s->looking->tick->island->rest;
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 3; k++) {
      sbf_vec3 offset = sbri_sub(sbri_self_position(rest, s->ends[i]), sbri_self_position(rest, c[k]));
      if (sbri_dot(offset, offset) < SBRI_SELF_TOGETHER_M * SBRI_SELF_TOGETHER_M) return true;
    }
  return false;
}

/* A contact has four points: the corner with the smallest weight is dropped, and its weight divided among the
 * others. */
static sbri_sample sample_of(
    const crossing_edge *s, float fraction, const uint32_t *c, const float weights[3]) {
  int min = weights[1] < weights[0] ? 1 : 0;
  if (weights[2] < weights[min]) min = 2;
  int i = (min + 1) % 3, k = (min + 2) % 3;
  const float half = 0.5f * weights[min],
              on[4] = {1 - fraction, fraction, -weights[i] - half, -weights[k] - half};
  const uint32_t slots[4] = {s->ends[0], s->ends[1], c[i], c[k]};
  return sbri_self_sample(s->looking->tick->island, slots, on);
}

static void add_crossing(const crossing_edge *s, uint32_t number) {
  const sbri_self_search *l = s->looking;
  const uint32_t *c = l->body->self.faces + 3 * (size_t)number;
  uint32_t *count = &l->tables->contact_counts[l->body - l->tick->model->bodies];
  sbf_vec3 p[3];
  for (int k = 0; k < 3; k++) {
    if (c[k] == s->ends[0] || c[k] == s->ends[1]) return;
    p[k] = position(s, c[k]);
  }
  float fraction = sbri_triangle_cross(s->from, s->displacement, p[0], p[1], p[2]), weights[3];
  if (fraction < 0 || *count >= l->body->contact.max_count || are_together(s, c)) return;
  sbri_triangle_find_nearest(sbri_add_scaled(s->from, s->displacement, fraction), p[0], p[1], p[2], weights);
  sbri_sample sample = sample_of(s, fraction, c, weights);
  sbf_vec3 direction = exit_displacement(s, p);
  float bend = sbri_length(direction);
  if (!(bend > 1e-3f) || !(sample.mass_kg > 0)) return;
  sbf_vec3 n = sbri_scale(direction, 1 / bend);
  l->tables->contacts[l->body->contact.first + (*count)++] = (sbri_soft_contact){.sample = sample,
      .normal = n,
      .offset = sbri_dot(n, sbri_sample_position(l->tick, &sample)),
      .velocity = sbri_scale(n, EXIT_M_S * sbri_min(bend / FULL_BEND, 1)),
      .collider = SBRI_ITSELF,
      .is_crossed = true};
}

/* A triangle and its plane. */
typedef struct plane_triangle {
  uint32_t number;
  const uint32_t *c;
  sbf_vec3 at, normal;
  sbri_box box;
} plane_triangle;

static plane_triangle plane_triangle_of(const sbri_self_search *l, uint32_t number) {
  const uint32_t *c = l->body->self.faces + 3 * (size_t)number;
  const sbri_point *at = l->tick->positions;
  sbf_vec3 p[3];
  for (int k = 0; k < 3; k++) p[k] = sbri_self_position(at, c[k]);
  return (plane_triangle){number, c, p[0], sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0])),
      sbri_box_with(sbri_box_with(sbri_box_of_point(p[0]), p[1]), p[2])};
}

/* Whether another triangle is on one side of its plane, or shares an edge with it. */
static bool cannot_cross(const sbri_self_search *l, const plane_triangle *f, const uint32_t *c) {
  int shared = 0, above = 0, below = 0;
  for (int k = 0; k < 3; k++) {
    if (c[k] == f->c[0] || c[k] == f->c[1] || c[k] == f->c[2]) {
      shared++;
      continue;
    }
    float height = sbri_dot(f->normal, sbri_sub(sbri_self_position(l->tick->positions, c[k]), f->at));
    above += height >= 0, below += height <= 0;
  }
  return shared > 1 || !above || !below;
}

/* Tests the edges of triangle `of` against triangle `number`, without the edges that belong to another
 * triangle in the table. */
static void add_crossings(const sbri_self_search *l, uint32_t of, uint32_t number) {
  for (uint32_t i = 3 * of; i < 3 * of + 3; i++) {
    if (l->body->self.sides[i] == SBRI_SAME_SIDE) continue;
    crossing_edge s = edge_of(l, i);
    add_crossing(&s, number);
  }
}

void sbri_self_crossings_add(const sbri_self_search *l) {
  for (uint32_t number = 0; number < l->body->self.face_count; number++) {
    const plane_triangle f = plane_triangle_of(l, number);
    sbri_bounds_walk walk;
    uint32_t other;
    sbri_bounds_walk_begin(&walk, l->tree, f.box);
    while (sbri_bounds_walk_next(&walk, &other)) {
      if (other <= number || !sbri_boxes_overlap(&f.box, &l->boxes[other])) continue;
      if (cannot_cross(l, &f, l->body->self.faces + 3 * (size_t)other)) continue;
      add_crossings(l, number, other);
      add_crossings(l, other, number);
    }
  }
}
