/* Resolves self-intersections. A sheet has no inside to be pushed out of, but its intersection is a contour,
 * which can be shortened until it vanishes.
 *
 * The contour has a corner wherever a side of the surface crosses a triangle. If the side moves by d relative
 * to the triangle, the corner moves by d - (d.n / e.n) e, with e along the side and n normal to the triangle.
 * The two pieces of the contour at the corner run along R1 and R2 in the triangles beside the side, and
 * shorten by (R1 + R2) times that motion. So d is along R1 + R2 - ((R1 + R2).e / e.n) n (after P. Volino and
 * N. Magnenat-Thalmann, Resolving Surface Collisions through Intersection Contour Minimization, 2006).
 * Contacts of points and triangles stay active meanwhile, on the side that each point is on. */
#include "collide/sides.h"
#include "contact/self_query.h"

/* Speed at which sides leave triangles, m/s, where the contour bends this much; in proportion where it bends
 * less.
 */
static const float OUT_M_S = 0.2f, CROOKED = 0.5f;
/* As steep as this, at least, a side is taken to stand on a triangle: sine of the angle. */
static const float STEEP = 0.1f;

typedef struct side {
  const sbri_self_looking *looking;
  uint32_t ends[2], beside[2]; /* slots; of the third corners of its triangles, or SBRI_RIM */
  sbf_vec3 from, displacement;
} side;

static sbf_vec3 position(const side *s, uint32_t slot) {
  return sbri_self_position(s->looking->tick->positions, slot);
}

static side side_of(const sbri_self_looking *l, uint32_t number) {
  const uint32_t *c = l->body->self_faces + number / 3 * 3;
  side s = {.looking = l,
      .ends = {c[number % 3], c[(number + 1) % 3]},
      .beside = {c[(number + 2) % 3], l->body->self_sides[number]}};
  s.from = position(&s, s.ends[0]);
  s.displacement = sbri_sub(position(&s, s.ends[1]), s.from);
  return s;
}

/* Adds the direction in which the contour runs along n's triangle into the one beside the side. */
static sbf_vec3 with_line(const side *s, sbf_vec3 e, sbf_vec3 n, uint32_t beside, sbf_vec3 sum) {
  if (beside == SBRI_RIM) return sum;
  sbf_vec3 across = sbri_sub(position(s, beside), s->from);
  across = sbri_add_scaled(across, e, -sbri_dot(across, e));
  sbf_vec3 line = sbri_cross(n, sbri_cross(e, across));
  float length = sbri_length(line);
  if (!(length > 1e-6f * sbri_length(across))) return sum;
  return sbri_add_scaled(sum, line, (sbri_dot(line, across) < 0 ? -1 : 1) / length);
}

/* Where the side is to go against the triangle whose corners are p; not of unit length. */
static sbf_vec3 exit_displacement(const side *s, const sbf_vec3 p[3]) {
  sbf_vec3 none = {0, 0, 0}, e = sbri_normalize(s->displacement, none),
           n = sbri_normalize(sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0])), none);
  sbf_vec3 out = with_line(s, e, n, s->beside[1], with_line(s, e, n, s->beside[0], none));
  float steep = sbri_dot(e, n);
  if (fabsf(steep) < STEEP) steep = steep < 0 ? -STEEP : STEEP;
  return sbri_add_scaled(out, n, -sbri_dot(out, e) / steep);
}

/* Parts that touch at rest are one, however they are joined. */
static bool are_one(const side *s, const uint32_t *c) {
  const sbri_point *rest = s->looking->tick->island->rest;
  for (int i = 0; i < 2; i++)
    for (int k = 0; k < 3; k++) {
      sbf_vec3 off = sbri_sub(sbri_self_position(rest, s->ends[i]), sbri_self_position(rest, c[k]));
      if (sbri_dot(off, off) < SBRI_SELF_TOGETHER_M * SBRI_SELF_TOGETHER_M) return true;
    }
  return false;
}

/* A contact has four points: the triangle's corner of least weight is dropped, and its weight divided among
 * the others. */
static sbri_sample sample_of(const side *s, float fraction, const uint32_t *c, const float weights[3]) {
  int min = weights[1] < weights[0] ? 1 : 0;
  if (weights[2] < weights[min]) min = 2;
  int i = (min + 1) % 3, k = (min + 2) % 3;
  const float half = 0.5f * weights[min],
              on[4] = {1 - fraction, fraction, -weights[i] - half, -weights[k] - half};
  const uint32_t slots[4] = {s->ends[0], s->ends[1], c[i], c[k]};
  return sbri_self_sample(s->looking->tick->island, slots, on);
}

static void cross(const side *s, uint32_t number) {
  const sbri_self_looking *l = s->looking;
  const uint32_t *c = l->body->self_faces + 3 * (size_t)number;
  uint32_t *count = &l->tables->contact_counts[l->body - l->tick->model->bodies];
  sbf_vec3 p[3];
  for (int k = 0; k < 3; k++) {
    if (c[k] == s->ends[0] || c[k] == s->ends[1]) return;
    p[k] = position(s, c[k]);
  }
  float fraction = sbri_triangle_cross(s->from, s->displacement, p[0], p[1], p[2]), weights[3];
  if (fraction < 0 || *count >= l->body->max_contacts || are_one(s, c)) return;
  sbri_triangle_find_nearest(sbri_add_scaled(s->from, s->displacement, fraction), p[0], p[1], p[2], weights);
  sbri_sample sample = sample_of(s, fraction, c, weights);
  sbf_vec3 out = exit_displacement(s, p);
  float crooked = sbri_length(out);
  if (!(crooked > 1e-3f) || !(sample.mass_kg > 0)) return;
  sbf_vec3 n = sbri_scale(out, 1 / crooked);
  l->tables->contacts[l->body->first_soft_contact + (*count)++] = (sbri_soft_contact){.sample = sample,
      .normal = n,
      .offset = sbri_dot(n, sbri_sample_position(l->tick, &sample)),
      .velocity = sbri_scale(n, OUT_M_S * sbri_min(crooked / CROOKED, 1)),
      .collider = SBRI_ITSELF,
      .crosses = true};
}

/* A triangle and its plane. */
typedef struct flat {
  uint32_t number;
  const uint32_t *c;
  sbf_vec3 at, normal;
  sbri_box box;
} flat;

static flat flat_of(const sbri_self_looking *l, uint32_t number) {
  const uint32_t *c = l->body->self_faces + 3 * (size_t)number;
  const sbri_point *at = l->tick->positions;
  sbf_vec3 p[3];
  for (int k = 0; k < 3; k++) p[k] = sbri_self_position(at, c[k]);
  return (flat){number, c, p[0], sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0])),
      sbri_box_with(sbri_box_with(sbri_box_of_point(p[0]), p[1]), p[2])};
}

/* Whether another triangle is on one side of its plane, or shares a side with it. */
static bool is_clear(const sbri_self_looking *l, const flat *f, const uint32_t *c) {
  int shared = 0, over = 0, below = 0;
  for (int k = 0; k < 3; k++) {
    if (c[k] == f->c[0] || c[k] == f->c[1] || c[k] == f->c[2]) {
      shared++;
      continue;
    }
    float height = sbri_dot(f->normal, sbri_sub(sbri_self_position(l->tick->positions, c[k]), f->at));
    over += height >= 0, below += height <= 0;
  }
  return shared > 1 || !over || !below;
}

/* The sides of one triangle, but those that another has in the table, against another one. */
static void cross_sides(const sbri_self_looking *l, uint32_t of, uint32_t number) {
  for (uint32_t i = 3 * of; i < 3 * of + 3; i++) {
    if (l->body->self_sides[i] == SBRI_SAME_SIDE) continue;
    side s = side_of(l, i);
    cross(&s, number);
  }
}

void sbri_self_crossings_add(const sbri_self_looking *l) {
  for (uint32_t number = 0; number < l->body->self_face_count; number++) {
    const flat f = flat_of(l, number);
    sbri_bounds_walk walk;
    uint32_t other;
    sbri_bounds_walk_begin(&walk, l->tree, f.box);
    while (sbri_bounds_walk_next(&walk, &other)) {
      if (other <= number || !sbri_boxes_overlap(&f.box, &l->boxes[other])) continue;
      if (is_clear(l, &f, l->body->self_faces + 3 * (size_t)other)) continue;
      cross_sides(l, number, other);
      cross_sides(l, other, number);
    }
  }
}
