/* Exits for points deeper than the search for faces.
 *
 * Contacts search faces within the body's `inner_thickness`. A hard impact pushes parts deeper, and a body
 * that is reset to its rest shape may overlap another. A winding count along a ray tells whether a point is
 * inside; the nearest surface point is then its exit. */
#include "coupling/body_contact/narrow_phase.h"
#include "shapes/surface_query.h"

/* m; nearer points lie on the surface */
static const float ON_SURFACE_M = 1e-6f;
/* First search radius, as a fraction of the body's size; doubled until found. */
static const float FIRST_FRACTION = 0.02f;
/* First search length along a ray, as a fraction of the maximum. */
static const float FIRST_REACH_FRACTION = 0.125f;

/* ---- Surfaces that are closed ---- */

static uint64_t hash(uint64_t x) {
  x = (x ^ x >> 31) * 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 29) * 0xbf58476d1ce4e5b9u;
  return x ^ x >> 32;
}

/* Every directed edge needs its opposite: the sum of edge hashes, added forwards and subtracted backwards, is
 * then 0. */
bool sbri_contact_surface_is_closed(const sbri_contact_surface *s) {
  uint64_t sum = 0;
  for (uint32_t t = 0; t < s->triangle_count; t++)
    for (uint32_t k = 0; k < 3; k++) {
      uint32_t from = s->triangles[3 * (size_t)t + k], to = s->triangles[3 * (size_t)t + (k + 1) % 3];
      if (from < to)
        sum += hash((uint64_t)from << 32 | to);
      else
        sum -= hash((uint64_t)to << 32 | from);
    }
  return s->triangle_count > 0 && sum == 0;
}

/* ---- Inside ---- */

/* Whether the edge, projected along Y, crosses the ray from x along X. Half-open intervals: of two triangles
 * at an edge, and of the edges at a vertex, exactly one counts. */
static bool edge_crosses_ray(sbf_vec3 x, sbf_vec3 a, sbf_vec3 b) {
  if ((a.z > x.z) == (b.z > x.z)) return false;
  sbf_vec3 low = a.z < b.z ? a : b, high = a.z < b.z ? b : a;
  return x.x < low.x + (high.x - low.x) * ((x.z - low.z) / (high.z - low.z));
}

/* Winding of a crossing of the triangle by the ray from x along Y, up or down: 1 outwards, -1 inwards, 0
 * none. */
static int crossing_sign(sbf_vec3 x, const sbf_vec3 p[3], float up) {
  if ((edge_crosses_ray(x, p[0], p[1]) ^ edge_crosses_ray(x, p[1], p[2]) ^ edge_crosses_ray(x, p[2], p[0])) ==
      0)
    return 0;
  sbf_vec3 normal = sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0]));
  float ahead = normal.y * sbri_dot(sbri_sub(p[0], x), normal) * up; /* only the sign matters */
  return !(ahead > 0) ? 0 : normal.y * up > 0 ? 1 : -1;
}

static void corners_of(const sbri_contact_surface *s, uint32_t triangle, sbf_vec3 p[3]) {
  for (uint32_t k = 0; k < 3; k++) p[k] = s->positions[s->triangles[3 * (size_t)triangle + k]];
}

bool sbri_surface_contains(const sbri_contact_surface *s, sbf_vec3 x) {
  const sbri_box *all = &s->tree.nodes[0].box;
  sbri_box ray = sbri_box_of_point(x);
  if (!sbri_boxes_overlap(all, &ray)) return false;
  float up = all->high.y - x.y < x.y - all->low.y ? 1.0f : -1.0f;
  ray = sbri_box_with(ray, sbri_vec3(x.x, up > 0 ? all->high.y : all->low.y, x.z));
  sbri_bounds_walk walk;
  uint32_t triangle;
  int winding = 0;
  sbri_bounds_walk_begin(&walk, &s->tree, ray);
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    sbf_vec3 p[3];
    corners_of(s, triangle, p);
    winding += crossing_sign(x, p, up);
  }
  return winding > 0;
}

/* ---- Out ---- */

/* Nearest surface point within `reach`, as a contact to leave by. */
static bool find_nearest(const sbri_contact_surface *s, sbf_vec3 x, float reach, sbri_surface_hit *best) {
  sbri_bounds_walk walk;
  uint32_t triangle;
  float min_distance = reach;
  sbri_bounds_walk_begin(&walk, &s->tree, sbri_box_grown(sbri_box_of_point(x), reach));
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    sbf_vec3 p[3];
    float weights[3];
    corners_of(s, triangle, p);
    sbri_triangle_find_nearest(x, p[0], p[1], p[2], weights);
    sbf_vec3 to_surface = sbri_sub(sbri_triangle_point(weights, p[0], p[1], p[2]), x);
    float distance = sbri_length(to_surface);
    if (!(distance < min_distance) || distance < ON_SURFACE_M) continue;
    min_distance = distance;
    best->face = triangle, best->normal = sbri_scale(to_surface, 1 / distance), best->behind = true;
    for (int k = 0; k < 3; k++) best->weights[k] = weights[k];
  }
  return min_distance < reach;
}

bool sbri_find_nearest_exit(const sbri_pair_body *b, sbf_vec3 x, sbri_surface_hit *best) {
  const sbri_contact_surface *s = b->surface;
  if (!s->closed || !sbri_surface_contains(s, x)) return false;
  float size = sbri_pair_body_size(b);
  for (float reach = FIRST_FRACTION * size; reach < size; reach *= 2)
    if (find_nearest(s, x, reach, best)) return true;
  return false;
}

/* ---- Exit along a ray ---- */

static sbf_vec3 to_ray_frame(const sbri_ray_frame *w, sbf_vec3 x) {
  return sbri_vec3(sbri_dot(x, w->x), sbri_dot(x, w->direction), sbri_dot(x, w->z));
}

sbri_ray_frame sbri_ray_frame_make(sbf_vec3 direction) {
  sbf_vec3 reference = fabsf(direction.x) < 0.6f ? sbri_vec3(1, 0, 0) : sbri_vec3(0, 1, 0);
  sbri_ray_frame w = {
      .direction = direction, .x = sbri_normalize(sbri_cross(direction, reference), reference)};
  w.z = sbri_cross(w.x, direction);
  return w;
}

/* The same crossing test as sbri_surface_contains: rays cannot slip between two triangles. */
static void test_triangle_along(const sbri_contact_surface *s, const sbri_ray_frame *w, sbf_vec3 x,
    uint32_t triangle, float *min_distance, sbri_surface_hit *best) {
  sbf_vec3 p[3], q[3], from = to_ray_frame(w, x);
  corners_of(s, triangle, p);
  for (int k = 0; k < 3; k++) q[k] = to_ray_frame(w, p[k]);
  if (crossing_sign(from, q, 1) <= 0) return;
  sbf_vec3 normal = sbri_cross(sbri_sub(q[1], q[0]), sbri_sub(q[2], q[0]));
  float ahead = sbri_dot(sbri_sub(q[0], from), normal) / normal.y;
  if (!(ahead < *min_distance)) return;
  *min_distance = ahead;
  best->face = triangle, best->normal = w->direction, best->behind = true;
  sbri_triangle_find_nearest(sbri_add_scaled(x, w->direction, ahead), p[0], p[1], p[2], best->weights);
}

float sbri_find_exit_along(const sbri_contact_surface *s, const sbri_ray_frame *w, sbf_vec3 x,
    float max_distance, sbri_surface_hit *best) {
  for (float reach = FIRST_REACH_FRACTION * max_distance;; reach *= 2) {
    float far = reach < max_distance ? reach : max_distance, min_distance = far;
    sbri_box ray = sbri_box_with(sbri_box_of_point(x), sbri_add_scaled(x, w->direction, far));
    sbri_bounds_walk walk;
    uint32_t triangle;
    sbri_bounds_walk_begin(&walk, &s->tree, sbri_box_grown(ray, ON_SURFACE_M));
    while (sbri_bounds_walk_next(&walk, &triangle))
      test_triangle_along(s, w, x, triangle, &min_distance, best);
    if (min_distance < far) return min_distance;
    if (far >= max_distance) return INFINITY;
  }
}
