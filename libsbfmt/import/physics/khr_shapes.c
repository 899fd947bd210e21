/* Shapes of KHR_implicit_shapes as points and volume integrals.
 *
 * Round shapes turn a profile about +Y: r^2 is a polynomial of degree 2 on each of its pieces, so that
 * Gauss's rule with three points integrates r^4, r^2 y and r^2 y^2 exactly. */
#include <math.h>
#include <string.h>

#include "import/physics/physics.h"

enum { SEGMENTS = 16, CAP_RINGS = 4, PIECES = 3 };
static const double PI = 3.14159265358979323846;
/* Half the size of an infinite plane, its thickness, and that of a finite one relative to its size. */
static const double PLANE_HALF = 100, PLANE_THICKNESS = 1, PLANE_FRACTION = 0.05;

/* r(y)^2 = a + b y + c y^2 from `low` to `high`. */
typedef struct piece {
  double low, high, a, b, c;
} piece;

typedef struct profile {
  piece pieces[PIECES];
  int count;
} profile;

static bool add_point(const sbfi_physics *p, sbfi_physics_shape *shape, const sbfi_matrix *to_asset, double x,
    double y, double z) {
  sbf_vec3 point = sbfi_transform_point(to_asset, (sbf_vec3){(float)x, (float)y, (float)z});
  if (sbfi_array_append(&shape->points, &point, 1)) return true;
  sbfi_diagnose(p->file.error, SBF_CODE_OUT_OF_MEMORY, "memory ran out while reading the collision shapes");
  return false;
}

static double radius_at(const piece *s, double y) {
  double square = s->a + s->b * y + s->c * y * y;
  return square > 0 ? sqrt(square) : 0;
}

static bool add_ring(
    const sbfi_physics *p, sbfi_physics_shape *shape, const sbfi_matrix *to_asset, double y, double radius) {
  for (int i = 0; i < (radius > 0 ? SEGMENTS : 1); i++) {
    double angle = 2 * PI * i / SEGMENTS;
    if (!add_point(p, shape, to_asset, radius * cos(angle), y, radius * sin(angle))) return false;
  }
  return true;
}

static void integrate(const piece *s, sbfi_moments *to) {
  static const double nodes[3] = {-0.77459666924148337704, 0, 0.77459666924148337704};
  static const double weights[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  double half = 0.5 * (s->high - s->low), middle = 0.5 * (s->high + s->low);
  for (int i = 0; i < 3; i++) {
    double y = middle + half * nodes[i], square = s->a + s->b * y + s->c * y * y;
    double area = PI * square * half * weights[i];
    to->volume += area;
    to->first[1] += area * y;
    to->second[0][0] += 0.25 * area * square;
    to->second[1][1] += area * y * y;
    to->second[2][2] += 0.25 * area * square;
  }
}

static bool add_profile(
    const sbfi_physics *p, const profile *from, const sbfi_matrix *to_asset, sbfi_physics_shape *shape) {
  sbfi_moments local = {0};
  for (int i = 0; i < from->count; i++) {
    const piece *s = &from->pieces[i];
    int rings = s->c < 0 ? CAP_RINGS : 1; /* a part of a ball, or a straight side */
    integrate(s, &local);
    for (int k = i ? 1 : 0; k <= rings; k++) {
      /* Rings at equal angles of a ball. */
      double radius = s->c < 0 ? sqrt(s->a + 0.25 * s->b * s->b) : 0, center = s->c < 0 ? 0.5 * s->b : 0;
      double from_angle = radius > 0 ? asin(fmax(-1, fmin(1, (s->low - center) / radius))) : 0;
      double to_angle = radius > 0 ? asin(fmax(-1, fmin(1, (s->high - center) / radius))) : 0;
      double y = radius > 0 ? center + radius * sin(from_angle + (to_angle - from_angle) * k / rings)
                            : s->low + (s->high - s->low) * k / rings;
      bool at_end = (i == 0 && k == 0 && s->c < 0) || (i == from->count - 1 && k == rings && s->c < 0);
      if (!add_ring(p, shape, to_asset, y, at_end ? 0 : radius_at(s, y))) return false;
    }
  }
  sbfi_moments_add(&shape->moments, &local, to_asset);
  return true;
}

static piece ball_piece(double center, double radius, double low, double high) {
  return (piece){low, high, radius * radius - center * center, 2 * center, -1};
}

static piece cone_piece(double low, double low_radius, double high, double high_radius) {
  double slope = (high_radius - low_radius) / (high - low), at_zero = low_radius - slope * low;
  return (piece){low, high, at_zero * at_zero, 2 * at_zero * slope, slope * slope};
}

/* The convex hull of two balls, or the larger one if it contains the other. */
static profile capsule_profile(double height, double bottom, double top) {
  double low = -0.5 * height, high = 0.5 * height;
  if (fabs(bottom - top) >= height) {
    double center = bottom > top ? low : high, radius = fmax(bottom, top);
    return (profile){{ball_piece(center, radius, center - radius, center + radius)}, 1};
  }
  double sine = (bottom - top) / height, cosine = sqrt(1 - sine * sine);
  double from = low + bottom * sine, to = high + top * sine;
  profile made = {.count = 0};
  if (bottom > 0) made.pieces[made.count++] = ball_piece(low, bottom, low - bottom, from);
  made.pieces[made.count++] = cone_piece(from, bottom * cosine, to, top * cosine);
  if (top > 0) made.pieces[made.count++] = ball_piece(high, top, to, high + top);
  return made;
}

static bool read_ends(
    const sbfi_physics *p, const sbfi_json *values, const char *what, float *height, float radii[2]) {
  if (!sbfi_physics_number_from(p, values, "height", 0.5f, 0, true, height) ||
      !sbfi_physics_number_from(p, values, "radiusBottom", 0.25f, 0, false, &radii[0]) ||
      !sbfi_physics_number_from(p, values, "radiusTop", 0.25f, 0, false, &radii[1]))
    return false;
  return radii[0] > 0 || radii[1] > 0 || sbfi_physics_fault(p, "a %s has two radii of 0", what);
}

static bool add_box(const sbfi_physics *p, const double half[3], double down, const sbfi_matrix *to_asset,
    sbfi_physics_shape *shape) {
  sbfi_moments local = {.volume = 8 * half[0] * half[1] * half[2]};
  local.first[1] = -down * local.volume;
  for (int k = 0; k < 3; k++) local.second[k][k] = local.volume * half[k] * half[k] / 3;
  local.second[1][1] += local.volume * down * down;
  for (int i = 0; i < 8; i++)
    if (!add_point(p, shape, to_asset, i & 1 ? half[0] : -half[0], (i & 2 ? half[1] : -half[1]) - down,
            i & 4 ? half[2] : -half[2]))
      return false;
  sbfi_moments_add(&shape->moments, &local, to_asset);
  return true;
}

/* A slab whose upper side is the plane. */
static bool add_plane(
    sbfi_physics *p, const sbfi_json *values, const sbfi_matrix *to_asset, sbfi_physics_shape *shape) {
  float x, z;
  bool finite = sbfi_json_get(values, "sizeX") && sbfi_json_get(values, "sizeZ");
  if (!sbfi_physics_number_from(p, values, "sizeX", (float)(2 * PLANE_HALF), 0, true, &x) ||
      !sbfi_physics_number_from(p, values, "sizeZ", (float)(2 * PLANE_HALF), 0, true, &z))
    return false;
  double half[3] = {0.5 * (double)x, 0, 0.5 * (double)z};
  half[1] = 0.5 * (finite ? fmin(PLANE_THICKNESS, PLANE_FRACTION * fmax(x, z)) : PLANE_THICKNESS);
  p->losses[SBFI_LOSS_PLANE]++;
  return add_box(p, half, half[1], to_asset, shape);
}

bool sbfi_physics_add_implicit(
    sbfi_physics *p, uint32_t index, const sbfi_matrix *to_asset, sbfi_physics_shape *shape) {
  static const char *const kinds[] = {"sphere", "box", "capsule", "cylinder", "plane"};
  const sbfi_json *json = sbfi_json_at(p->shapes, index), *type = sbfi_json_get(json, "type");
  float radii[2], height, size[3] = {1, 1, 1};
  size_t kind = 0, kind_count = sizeof kinds / sizeof *kinds;
  if (!type || type->type != SBFI_JSON_STRING)
    return sbfi_physics_fault(p, "implicit shape %u states no type", index);
  while (kind < kind_count && !sbfi_json_is_string(type, kinds[kind])) kind++;
  if (kind == kind_count) {
    p->losses[SBFI_LOSS_SHAPE_TYPE]++;
    return true;
  }
  const sbfi_json *values = sbfi_json_get(json, kinds[kind]);
  profile made;
  switch (kind) {
  case 0:
    if (!sbfi_physics_number_from(p, values, "radius", 0.5f, 0, true, &radii[0])) return false;
    made = (profile){{ball_piece(0, (double)radii[0], -(double)radii[0], (double)radii[0])}, 1};
    return add_profile(p, &made, to_asset, shape);
  case 1:
    if (!sbfi_physics_numbers(p, values, "size", 3, size)) return false;
    if (!(size[0] > 0 && size[1] > 0 && size[2] > 0))
      return sbfi_physics_fault(p, "the box of implicit shape %u has a size of 0 or less", index);
    return add_box(p, (const double[3]){0.5 * (double)size[0], 0.5 * (double)size[1], 0.5 * (double)size[2]},
        0, to_asset, shape);
  case 2:
    if (!read_ends(p, values, kinds[kind], &height, radii)) return false;
    made = capsule_profile((double)height, (double)radii[0], (double)radii[1]);
    return add_profile(p, &made, to_asset, shape);
  case 3:
    if (!read_ends(p, values, kinds[kind], &height, radii)) return false;
    made = (profile){
        {cone_piece(-0.5 * (double)height, (double)radii[0], 0.5 * (double)height, (double)radii[1])}, 1};
    return add_profile(p, &made, to_asset, shape);
  default:
    return add_plane(p, values, to_asset, shape);
  }
}
