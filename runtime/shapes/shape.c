#include "shapes/shape.h"

#include "shapes/triangle.h"

static const sbf_vec3 up = {0, 1, 0};

sbf_vec3 sbri_triangle_normal(sbf_vec3 a, sbf_vec3 b, sbf_vec3 c) {
  return sbri_normalize(sbri_cross(sbri_sub(b, a), sbri_sub(c, a)), sbri_vec3(0, 0, 0));
}

/* ---- Nearest points ---- */

static sbri_nearest nearest_on_ball(sbf_vec3 x, sbf_vec3 center, float radius) {
  sbf_vec3 offset = sbri_sub(x, center), n = sbri_normalize(offset, up);
  return (sbri_nearest){sbri_length(offset) - radius, sbri_add_scaled(center, n, radius), n};
}

static sbf_vec3 on_axis(const sbr_shape *s, sbf_vec3 x) {
  return sbri_vec3(0, sbri_clamp(x.y, -s->half_sizes.y, s->half_sizes.y), 0);
}

static sbri_nearest nearest_on_box(sbf_vec3 half, sbf_vec3 x) {
  const float at[3] = {x.x, x.y, x.z}, to[3] = {half.x, half.y, half.z};
  float position[3], best = -INFINITY;
  int axis = 0;
  for (int k = 0; k < 3; k++) {
    position[k] = sbri_clamp(at[k], -to[k], to[k]);
    float out = fabsf(at[k]) - to[k];
    if (out > best) best = out, axis = k;
  }
  float n[3] = {0, 0, 0};
  n[axis] = at[axis] < 0 ? -1.0f : 1.0f;
  if (best <= 0) {
    position[axis] = n[axis] * to[axis];
    return (sbri_nearest){best, {position[0], position[1], position[2]}, {n[0], n[1], n[2]}};
  }
  sbf_vec3 on = {position[0], position[1], position[2]}, offset = sbri_sub(x, on);
  return (sbri_nearest){sbri_length(offset), on, sbri_normalize(offset, sbri_vec3(n[0], n[1], n[2]))};
}

/* The nearest triangle. If several have the same nearest point, for example at an edge, the one that faces x
 * most decides whether x is inside. */
static bool nearest_on_triangles(
    const sbri_triangles *t, sbf_vec3 x, float reach, float depth, sbri_nearest *found) {
  sbri_bounds_walk walk;
  float limit = reach > depth ? reach : depth, min = limit * limit, facing = -1;
  bool any = false;
  uint32_t i;
  sbri_bounds_walk_begin(&walk, &t->tree, sbri_box_grown(sbri_box_of_point(x), limit));
  while (sbri_bounds_walk_next(&walk, &i)) {
    const uint32_t *c = t->corners + 3 * (size_t)i;
    sbf_vec3 a = t->points[c[0]], b = t->points[c[1]], d = t->points[c[2]];
    float weights[3];
    sbri_triangle_find_nearest(x, a, b, d, weights);
    sbf_vec3 on = sbri_triangle_point(weights, a, b, d), offset = sbri_sub(x, on),
             n = sbri_triangle_normal(a, b, d);
    float square = sbri_dot(offset, offset), height = sbri_dot(offset, n);
    if (square > min * (1 + 1e-5f) || sbri_dot(n, n) == 0) continue;
    if (square >= min * (1 - 1e-5f) && any && !(fabsf(height) > facing)) continue;
    min = square < min ? square : min;
    facing = fabsf(height), any = true;
    float distance = sqrtf(square);
    bool inside = height < 0;
    *found = (sbri_nearest){inside ? -distance : distance, on,
        distance > 1e-9f ? sbri_scale(offset, inside ? -1 / distance : 1 / distance) : n};
  }
  return any && found->gap <= reach && found->gap >= -depth;
}

bool sbri_shape_nearest(const sbr_shape *s, sbf_vec3 x, float reach, float depth, sbri_nearest *found) {
  switch (s->kind) {
  case SBR_SHAPE_PLANE:
    *found = (sbri_nearest){x.y, {x.x, 0, x.z}, up};
    break;
  case SBR_SHAPE_SPHERE:
    *found = nearest_on_ball(x, sbri_vec3(0, 0, 0), s->radius);
    break;
  case SBR_SHAPE_CAPSULE:
    *found = nearest_on_ball(x, on_axis(s, x), s->radius);
    break;
  case SBR_SHAPE_BOX:
    *found = nearest_on_box(s->half_sizes, x);
    break;
  case SBR_SHAPE_HULL:
    found->gap = sbri_hull_nearest(&s->hull, x, &found->position, &found->normal);
    break;
  case SBR_SHAPE_MESH:
  case SBR_SHAPE_HEIGHT_FIELD:
    return nearest_on_triangles(&s->triangles, x, reach, depth, found);
  case SBR_SHAPE_HOST:
    found->normal = up;
    found->gap = s->host.distance(s->host.user, x, reach, &found->normal);
    found->position = sbri_add_scaled(x, found->normal, -found->gap);
    break;
  }
  return found->gap <= reach;
}

/* ---- Ray entry ---- */

/* The smallest t in 0..1 at which x + t displacement is at `radius` from the origin; -1: none. */
static float enter_round(sbf_vec3 x, sbf_vec3 displacement, float radius) {
  float a = sbri_dot(displacement, displacement), b = sbri_dot(x, displacement),
        c = sbri_dot(x, x) - radius * radius;
  float root = b * b - a * c;
  if (c < 0 || b >= 0 || root < 0 || !(a > 0)) return -1;
  float t = (-b - sqrtf(root)) / a;
  return t >= 0 && t <= 1 ? t : -1;
}

static bool enter_capsule(
    const sbr_shape *s, sbf_vec3 x, sbf_vec3 displacement, float *fraction, sbf_vec3 *normal) {
  float best = 2;
  sbf_vec3 axis_position = {0, 0, 0};
  for (int end = -1; end <= 1; end++) {
    sbf_vec3 middle = {0, (float)end * s->half_sizes.y, 0};
    sbf_vec3 from = sbri_sub(x, middle), direction = displacement;
    if (end == 0) from.y = direction.y = 0; /* the cylinder part */
    float t = enter_round(from, direction, s->radius);
    if (t < 0 || t >= best) continue;
    sbf_vec3 at = sbri_add_scaled(x, displacement, t);
    if (end == 0 && fabsf(at.y) > s->half_sizes.y) continue;
    best = t, axis_position = on_axis(s, at);
  }
  if (best > 1) return false;
  *fraction = best;
  *normal = sbri_normalize(sbri_sub(sbri_add_scaled(x, displacement, best), axis_position), up);
  return true;
}

bool sbri_hull_enter(
    const sbri_hull *hull, sbf_vec3 x, sbf_vec3 displacement, float *fraction, sbf_vec3 *normal) {
  float in = -1, out = 1;
  for (uint32_t f = 0; f < hull->face_count; f++) {
    const sbri_hull_face *face = &hull->faces[f];
    float height = sbri_dot(face->normal, x) - face->offset, rate = sbri_dot(face->normal, displacement);
    if (rate == 0 && height > 0) return false;
    if (rate == 0) continue;
    float t = -height / rate;
    if (rate > 0) {
      out = t < out ? t : out;
    } else if (t > in) {
      in = t, *normal = face->normal;
    }
  }
  *fraction = in;
  return in >= 0 && in <= out;
}

static bool enter_triangles(
    const sbri_triangles *t, sbf_vec3 x, sbf_vec3 displacement, float *fraction, sbf_vec3 *normal) {
  sbri_bounds_walk walk;
  float best = 2;
  uint32_t i;
  sbri_bounds_walk_begin(&walk, &t->tree, sbri_box_with(sbri_box_of_point(x), sbri_add(x, displacement)));
  while (sbri_bounds_walk_next(&walk, &i)) {
    const uint32_t *c = t->corners + 3 * (size_t)i;
    sbf_vec3 a = t->points[c[0]], b = t->points[c[1]], d = t->points[c[2]];
    sbf_vec3 n = sbri_triangle_normal(a, b, d);
    float at = sbri_dot(n, displacement) < 0 ? sbri_triangle_cross(x, displacement, a, b, d) : -1;
    if (at >= 0 && at < best) best = at, *normal = n;
  }
  *fraction = best;
  return best <= 1;
}

bool sbri_shape_enter(
    const sbr_shape *s, sbf_vec3 x, sbf_vec3 displacement, float *fraction, sbf_vec3 *normal) {
  switch (s->kind) {
  case SBR_SHAPE_PLANE:
    if (!(x.y >= 0) || !(x.y + displacement.y < 0)) return false;
    *fraction = x.y / -displacement.y, *normal = up;
    return true;
  case SBR_SHAPE_SPHERE:
    *fraction = enter_round(x, displacement, s->radius);
    *normal = sbri_normalize(sbri_add_scaled(x, displacement, *fraction), up);
    return *fraction >= 0;
  case SBR_SHAPE_CAPSULE:
    return enter_capsule(s, x, displacement, fraction, normal);
  case SBR_SHAPE_BOX:
  case SBR_SHAPE_HULL:
    return sbri_hull_enter(&s->hull, x, displacement, fraction, normal);
  case SBR_SHAPE_MESH:
  case SBR_SHAPE_HEIGHT_FIELD:
    return enter_triangles(&s->triangles, x, displacement, fraction, normal);
  case SBR_SHAPE_HOST:
    *fraction = s->host.cast ? s->host.cast(s->host.user, x, displacement, normal) : -1;
    return *fraction >= 0 && *fraction <= 1;
  }
  return false;
}
