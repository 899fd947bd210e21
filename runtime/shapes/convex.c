#include "shapes/convex.h"

#include <float.h>

enum { MAX_ITERATIONS = 64, MAX_ADVANCES = 128 };
/* Distances below this fraction of the shapes' extent are contact, with this minimum in m. */
static const double TOUCHING_FRACTION = 1e-7, TOUCHING_M = 2e-6;

void sbri_convex_set_frame(sbri_convex *convex, sbfi_d3 position, sbf_quat rotation, double scale) {
  double x = (double)rotation.x, y = (double)rotation.y, z = (double)rotation.z, w = (double)rotation.w;
  convex->position = position;
  convex->axes[0] =
      sbfi_d3_scale((sbfi_d3){1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)}, scale);
  convex->axes[1] =
      sbfi_d3_scale((sbfi_d3){2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)}, scale);
  convex->axes[2] =
      sbfi_d3_scale((sbfi_d3){2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}, scale);
}

/* ---- Simplices ---- */

/* Points of the Minkowski difference a - b, with the point of b that each comes from. */
typedef struct simplex {
  sbfi_d3 at[4], of_b[4];
  double weights[4]; /* of the point nearest to the origin */
  int count;
} simplex;

/* Support point: the point of the hull farthest along a direction. */
static sbfi_d3 support(const sbri_convex *c, sbfi_d3 direction) {
  double along[3], max = -DBL_MAX;
  uint32_t best = 0;
  for (int k = 0; k < 3; k++) along[k] = sbfi_d3_dot(c->axes[k], direction);
  for (uint32_t i = 0; i < c->count; i++) {
    const sbf_vec3 *p = &c->points[i];
    double here = along[0] * (double)p->x + along[1] * (double)p->y + along[2] * (double)p->z;
    if (here > max) max = here, best = i;
  }
  return sbri_convex_point(c, best);
}

static void keep(simplex *s, int count, const int order[4], const double weights[4]) {
  const simplex before = *s;
  s->count = count;
  for (int k = 0; k < count; k++)
    s->at[k] = before.at[order[k]], s->of_b[k] = before.of_b[order[k]], s->weights[k] = weights[k];
}

/* Weights of the point of a segment nearest to the origin. */
static void reduce_segment(simplex *s) {
  sbfi_d3 d = sbfi_d3_sub(s->at[1], s->at[0]);
  double square = sbfi_d3_dot(d, d), t = square > 0 ? -sbfi_d3_dot(s->at[0], d) / square : 0;
  if (t <= 0)
    keep(s, 1, (const int[4]){0}, (const double[4]){1});
  else if (t >= 1)
    keep(s, 1, (const int[4]){1}, (const double[4]){1});
  else
    s->weights[0] = 1 - t, s->weights[1] = t;
}

/* Weights of the point of a triangle nearest to the origin (C. Ericson, Real-Time Collision Detection,
 * 2005, 5.1.5). */
static void reduce_triangle(simplex *s) {
  sbfi_d3 a = s->at[0], b = s->at[1], c = s->at[2], ab = sbfi_d3_sub(b, a), ac = sbfi_d3_sub(c, a);
  double a1 = -sbfi_d3_dot(ab, a), a2 = -sbfi_d3_dot(ac, a), b1 = -sbfi_d3_dot(ab, b),
         b2 = -sbfi_d3_dot(ac, b), c1 = -sbfi_d3_dot(ab, c), c2 = -sbfi_d3_dot(ac, c);
  double wc = a1 * b2 - b1 * a2, wb = c1 * a2 - a1 * c2, wa = b1 * c2 - c1 * b2, sum = wa + wb + wc;
  if (a1 <= 0 && a2 <= 0) {
    keep(s, 1, (const int[4]){0}, (const double[4]){1});
  } else if (b1 >= 0 && b2 <= b1) {
    keep(s, 1, (const int[4]){1}, (const double[4]){1});
  } else if (c2 >= 0 && c1 <= c2) {
    keep(s, 1, (const int[4]){2}, (const double[4]){1});
  } else if (wc <= 0 && a1 >= 0 && b1 <= 0) {
    double t = a1 / (a1 - b1);
    keep(s, 2, (const int[4]){0, 1}, (const double[4]){1 - t, t});
  } else if (wb <= 0 && a2 >= 0 && c2 <= 0) {
    double t = a2 / (a2 - c2);
    keep(s, 2, (const int[4]){0, 2}, (const double[4]){1 - t, t});
  } else if (wa <= 0 && b2 - b1 >= 0 && c1 - c2 >= 0) {
    double t = (b2 - b1) / ((b2 - b1) + (c1 - c2));
    keep(s, 2, (const int[4]){1, 2}, (const double[4]){1 - t, t});
  } else {
    s->weights[0] = wa / sum, s->weights[1] = wb / sum, s->weights[2] = wc / sum;
  }
}

static sbfi_d3 nearest_of(const simplex *s) {
  sbfi_d3 sum = {0, 0, 0};
  for (int k = 0; k < s->count; k++) sum = sbfi_d3_add(sum, sbfi_d3_scale(s->at[k], s->weights[k]));
  return sum;
}

/* Reduces to the nearest face that has the origin outside; returns false if the origin is inside. */
static bool reduce_tetrahedron(simplex *s) {
  static const int faces[4][4] = {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}};
  const simplex whole = *s;
  double min = DBL_MAX;
  bool outside = false;
  for (int f = 0; f < 4; f++) {
    sbfi_d3 a = whole.at[faces[f][0]];
    sbfi_d3 n = sbfi_d3_cross(sbfi_d3_sub(whole.at[faces[f][1]], a), sbfi_d3_sub(whole.at[faces[f][2]], a));
    double apex = sbfi_d3_dot(n, sbfi_d3_sub(whole.at[faces[f][3]], a)), origin = -sbfi_d3_dot(n, a);
    if (apex != 0 && apex * origin >= 0) continue; /* on the same side as the apex */
    simplex face = whole;
    keep(&face, 3, faces[f], (const double[4]){0});
    reduce_triangle(&face);
    sbfi_d3 x = nearest_of(&face);
    double square = sbfi_d3_dot(x, x);
    outside = true;
    if (square < min) min = square, *s = face;
  }
  return outside;
}

static bool reduce(simplex *s) {
  if (s->count == 1) s->weights[0] = 1;
  if (s->count == 2) reduce_segment(s);
  if (s->count == 3) reduce_triangle(s);
  return s->count < 4 || reduce_tetrahedron(s);
}

/* ---- Distance ---- */

static void add_support(
    simplex *s, const sbri_convex *a, sbfi_d3 offset, const sbri_convex *b, sbfi_d3 direction) {
  sbfi_d3 of_a = sbfi_d3_add(support(a, direction), offset), of_b = support(b, sbfi_d3_scale(direction, -1));
  s->at[s->count] = sbfi_d3_sub(of_a, of_b), s->of_b[s->count] = of_b;
  s->count++;
}

static bool has(const simplex *s, sbfi_d3 x) {
  for (int k = 0; k < s->count; k++)
    if (s->at[k].x == x.x && s->at[k].y == x.y && s->at[k].z == x.z) return true;
  return false;
}

sbri_closest sbri_convex_distance(const sbri_convex *a, sbfi_d3 offset, const sbri_convex *b) {
  simplex s = {.count = 0};
  sbfi_d3 first = sbfi_d3_sub(sbfi_d3_add(a->position, offset), b->position);
  add_support(&s, a, offset, b, sbfi_d3_scale(first, -1));
  s.weights[0] = 1;
  sbfi_d3 nearest = s.at[0];
  const sbri_closest overlap = {.distance = -1};
  for (int i = 0; i < MAX_ITERATIONS; i++) {
    double square = sbfi_d3_dot(nearest, nearest);
    if (!(square > 1e-24)) return overlap;
    simplex next = s;
    add_support(&next, a, offset, b, sbfi_d3_scale(nearest, -1));
    sbfi_d3 added = next.at[next.count - 1];
    if (has(&s, added) || square - sbfi_d3_dot(nearest, added) <= 1e-14 * square) break;
    if (!reduce(&next)) return overlap;
    sbfi_d3 nearer = nearest_of(&next);
    if (!(sbfi_d3_dot(nearer, nearer) < square)) break; /* converged to rounding */
    s = next, nearest = nearer;
  }
  double distance = sbfi_d3_length(nearest);
  sbri_closest found = {
      .distance = distance - a->radius - b->radius, .normal = sbfi_d3_scale(nearest, 1 / distance)};
  for (int k = 0; k < s.count; k++)
    found.on_b = sbfi_d3_add(found.on_b, sbfi_d3_scale(s.of_b[k], s.weights[k]));
  found.on_b = sbfi_d3_add(found.on_b, sbfi_d3_scale(found.normal, b->radius));
  return found;
}

double sbri_convex_cast(
    const sbri_convex *a, sbfi_d3 displacement, const sbri_convex *b, sbri_closest *contact) {
  double length = sbfi_d3_length(displacement), touching = TOUCHING_FRACTION * length, fraction = 0;
  if (!(touching > TOUCHING_M)) touching = TOUCHING_M;
  for (int i = 0; i < MAX_ADVANCES && fraction <= 1; i++) {
    sbri_closest found = sbri_convex_distance(a, sbfi_d3_scale(displacement, fraction), b);
    if (found.distance < 0 && i == 0) {
      *contact = (sbri_closest){.distance = found.distance, .on_b = found.on_b};
      return 0;
    }
    if (found.distance < 0) return fraction; /* contact of the previous advance */
    *contact = found;
    double rate = -sbfi_d3_dot(found.normal, displacement);
    if (!(rate > 0)) return 2;
    if (found.distance <= touching) return fraction;
    fraction += found.distance / rate;
  }
  return fraction <= 1 ? fraction : 2;
}
