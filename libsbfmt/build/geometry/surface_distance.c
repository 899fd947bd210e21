#include "build/geometry/surface_distance.h"

#include <math.h>

#include "build/geometry/triangle_cover.h"

enum { MAX_HALVINGS = 6 };
static const double MIN_FRACTION = 1e-5, SLACK = 1.05;

typedef struct comparison {
  const sbfi_triangle_tree *to;
  double reached; /* lower bound: some position has this distance */
  double bound;   /* upper bound for the visited parts */
  double no_less; /* a bound below it is good enough */
} comparison;

static double distance_of(const double a[3], const double b[3]) {
  double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return sqrt(x * x + y * y + z * z);
}

static void load(sbf_vec3 from, double to[3]) {
  to[0] = (double)from.x, to[1] = (double)from.y, to[2] = (double)from.z;
}

static double square_from(const comparison *c, const double at[3], uint32_t triangle) {
  double t[3][3], weights[3];
  for (int k = 0; k < 3; k++) load(c->to->positions[c->to->triangles[triangle].points[k]], t[k]);
  return sbfi_triangle_closest(t[0], t[1], t[2], at, weights);
}

/* Distance to the surface. `*triangle` is a guess, and becomes the nearest. */
static double nearest(const comparison *c, const double at[3], uint32_t *triangle) {
  sbf_vec3 position = {(float)at[0], (float)at[1], (float)at[2]};
  double squared = square_from(c, at, *triangle);
  uint32_t found = sbfi_triangle_tree_nearest(c->to, position, &squared);
  if (found != UINT32_MAX) *triangle = found;
  return sqrt(squared);
}

/* Largest distance of three corners from one triangle. */
static double farthest_corner(const comparison *c, const double corners[3][3], uint32_t triangle) {
  double max = 0;
  for (int k = 0; k < 3; k++) {
    double squared = square_from(c, corners[k], triangle);
    if (squared > max) max = squared;
  }
  return sqrt(max);
}

static void check(comparison *c, const double corners[3][3], uint32_t *near, int halvings) {
  double middle[3], sides[3][3], reach = 0;
  for (int k = 0; k < 3; k++) middle[k] = (corners[0][k] + corners[1][k] + corners[2][k]) / 3;
  for (int k = 0; k < 3; k++) {
    double r = distance_of(corners[k], middle);
    if (r > reach) reach = r;
  }
  double here = nearest(c, middle, near);
  if (here > c->reached) c->reached = here;
  double bound = here + reach;
  if (bound > c->reached * SLACK) {
    double convex = farthest_corner(c, corners, *near);
    if (convex < bound) bound = convex;
  }
  double enough = fmax(c->reached * SLACK, c->no_less);
  if (bound > enough && sbfi_triangle_is_covered(c->to, corners, enough)) bound = enough;
  if (bound <= enough || halvings == 0) {
    if (bound > c->bound) c->bound = bound;
    return;
  }
  for (int k = 0; k < 3; k++)
    for (int axis = 0; axis < 3; axis++) sides[k][axis] = (corners[k][axis] + corners[(k + 1) % 3][axis]) / 2;
  for (int k = 0; k < 4; k++) {
    double part[3][3];
    for (int axis = 0; axis < 3; axis++) {
      part[0][axis] = k < 3 ? corners[k][axis] : sides[0][axis];
      part[1][axis] = k < 3 ? sides[k][axis] : sides[1][axis];
      part[2][axis] = k < 3 ? sides[(k + 2) % 3][axis] : sides[2][axis];
    }
    check(c, (const double(*)[3])part, near, halvings - 1);
  }
}

/* Skips triangles without area. */
static bool has_area(const double corners[3][3]) {
  double a[3], b[3], normal = 0, sides = 0;
  for (int k = 0; k < 3; k++) {
    a[k] = corners[1][k] - corners[0][k];
    b[k] = corners[2][k] - corners[0][k];
    sides += a[k] * a[k] + b[k] * b[k];
  }
  for (int k = 0; k < 3; k++) {
    double n = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    normal += n * n;
  }
  return sqrt(normal) > 1e-6 * sides;
}

/* Corners first: they give a lower bound quickly. */
static bool compare(comparison *c, const sbfi_triangle_tree *from, sbfi_progress progress) {
  uint32_t near = 0;
  for (int pass = 0; pass < 2; pass++)
    for (uint32_t t = 0; t < from->triangle_count; t++) {
      double corners[3][3];
      if (!sbfi_progress_step(
              sbfi_progress_part(progress, pass * 0.2, pass ? 1 : 0.2), t, from->triangle_count))
        return false;
      for (int k = 0; k < 3; k++) load(from->positions[from->triangles[t].points[k]], corners[k]);
      if (pass == 1) {
        if (!has_area((const double(*)[3])corners)) continue;
        check(c, (const double(*)[3])corners, &near, MAX_HALVINGS);
        continue;
      }
      double far = nearest(c, corners[t % 3], &near);
      if (far > c->reached) c->reached = far;
    }
  return true;
}

bool sbfi_surface_distance(
    double *distance, const sbfi_triangle_tree *a, const sbfi_triangle_tree *b, sbfi_progress progress) {
  *distance = 0;
  if (a->triangle_count == 0 || b->triangle_count == 0) return true;
  const sbfi_box *box = &a->tree.nodes[0].box;
  double low[3], high[3];
  for (int k = 0; k < 3; k++) low[k] = (double)box->low[k], high[k] = (double)box->high[k];
  comparison c = {.to = b, .no_less = MIN_FRACTION * distance_of(low, high)};
  if (!compare(&c, a, sbfi_progress_part(progress, 0, 0.5))) return false;
  c.to = a;
  if (!compare(&c, b, sbfi_progress_part(progress, 0.5, 1))) return false;
  *distance = c.bound > c.reached ? c.bound : c.reached;
  return true;
}
