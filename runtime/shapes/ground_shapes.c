/* Planes, height fields, obstacles, and rays of the host. */
#include <math.h>

#include "math/trig.h"
#include "sbrun/terrain.h"

static const sbf_vec3 up = {0, 1, 0};

static sbf_vec3 normal_of(double slope_x, double slope_z) {
  double s = 1 / sqrt(1 + slope_x * slope_x + slope_z * slope_z);
  return (sbf_vec3){(float)(-slope_x * s), (float)s, (float)(-slope_z * s)};
}

/* ---- Plane ---- */

static double plane(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  const double *p = ground->parameters;
  *normal = normal_of(p[1], p[2]);
  return p[0] + p[1] * x + p[2] * z;
}

sbr_ground sbr_ground_plane(double height_m, sbf_vec3 normal) {
  double slope_x = 0, slope_z = 0;
  if (normal.y > 0) {
    slope_x = -(double)normal.x / (double)normal.y;
    slope_z = -(double)normal.z / (double)normal.y;
  }
  return (sbr_ground){plane, NULL, {height_m, slope_x, slope_z, 0}};
}

/* ---- Height field ---- */

/* The cell of a coordinate, and the fraction in it, 0 to 1; beyond the edge, the edge of the last cell. */
static uint32_t square_of(double at, uint32_t corners, double *fraction, bool *inside) {
  double last = corners - 1;
  *inside = at >= 0 && at <= last;
  at = at < 0 ? 0 : at > last ? last : at;
  uint32_t square = (uint32_t)at;
  if (square > corners - 2) square = corners - 2;
  *fraction = at - square;
  return square;
}

static double height_field(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  const sbr_height_field *f = ground->user;
  double u, v;
  bool inside_x, inside_z;
  uint32_t column = square_of((x - f->x) / f->cell_m, f->columns, &u, &inside_x);
  uint32_t row = square_of((z - f->z) / f->cell_m, f->rows, &v, &inside_z);
  const float *near = f->heights_m + (size_t)row * f->columns + column, *far = near + f->columns;
  double a = (double)near[0], b = (double)near[1], c = (double)far[0], d = (double)far[1];
  double slope_x = inside_x ? ((b - a) * (1 - v) + (d - c) * v) / f->cell_m : 0;
  double slope_z = inside_z ? ((c - a) * (1 - u) + (d - b) * u) / f->cell_m : 0;
  *normal = normal_of(slope_x, slope_z);
  return (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
}

sbr_ground sbr_ground_height_field(const sbr_height_field *field) {
  if (!field || !field->heights_m || field->columns < 2 || field->rows < 2 || !(field->cell_m > 0))
    return sbr_ground_flat(0);
  return (sbr_ground){height_field, field, {0, 0, 0, 0}};
}

/* ---- Obstacles ---- */

/* Height of the obstacle's top; false outside it. */
static bool top_of(const sbr_obstacle *o, double x, double z, double *y, sbf_vec3 *normal) {
  double dx = x - o->center.x, dz = z - o->center.z, radius = (double)o->half_sizes.x;
  *normal = up;
  *y = o->center.y + (double)o->half_sizes.y;
  if (o->kind == SBR_OBSTACLE_CYLINDER) return dx * dx + dz * dz <= radius * radius;
  if (o->kind == SBR_OBSTACLE_SPHERE) {
    double left = radius * radius - dx * dx - dz * dz;
    if (left < 0) return false;
    *y = o->center.y + sqrt(left);
    *normal = (sbf_vec3){(float)(dx / radius), (float)(sqrt(left) / radius), (float)(dz / radius)};
    return true;
  }
  float s, c;
  sbri_sincos(o->heading, &s, &c);
  double own_x = dx * (double)c - dz * (double)s, own_z = dx * (double)s + dz * (double)c;
  return fabs(own_x) <= radius && fabs(own_z) <= (double)o->half_sizes.z;
}

static double obstacles(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  const sbr_obstacle_set *set = ground->user;
  double highest = set->base->height(set->base, x, z, normal), y;
  for (uint32_t i = 0; i < set->count; i++) {
    sbf_vec3 other;
    if (!top_of(&set->obstacles[i], x, z, &y, &other) || y <= highest) continue;
    highest = y;
    *normal = other;
  }
  return highest;
}

sbr_ground sbr_ground_with_obstacles(const sbr_obstacle_set *set) {
  if (!set || !set->base || !set->base->height) return sbr_ground_flat(0);
  return (sbr_ground){obstacles, set, {0, 0, 0, 0}};
}

/* ---- Rays ---- */

static double rays(const sbr_ground *ground, double x, double z, sbf_vec3 *normal) {
  const sbr_ray_caster *caster = ground->user;
  *normal = up;
  double distance = caster->cast(caster->user, (sbr_double3){x, caster->top_m, z}, caster->length_m, normal);
  if (distance >= 0) return caster->top_m - distance;
  *normal = up;
  return caster->otherwise_m;
}

sbr_ground sbr_ground_from_rays(const sbr_ray_caster *caster) {
  if (!caster || !caster->cast) return sbr_ground_flat(0);
  return (sbr_ground){rays, caster, {0, 0, 0, 0}};
}
