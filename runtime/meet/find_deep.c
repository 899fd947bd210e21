/* The way out for what is so deep in a soft body that no face of it is near any more.
 *
 * Touches look as deep as a body's `inner_thickness`, within which the face in front of a place is the one by
 * which it came in. A hard blow drives parts deeper, and a body that is put back into its rest shape may find
 * another one there. Whether a place is inside is told by how often a ray from it passes the surface outwards
 * more than inwards, and the nearest place of the surface is then the way out. */
#include "collide/surface_look.h"
#include "meet/finding.h"

/* m: nearer than that to the surface is on it. */
static const float ON_IT_M = 1e-6f;
/* How far the way out is looked for at first, then twice as far and so on: of the body's size. */
static const float FIRST_SHARE = 0.02f;
/* Along a way: of the most. */
static const float FIRST_REACH_SHARE = 0.125f;

/* ---- Surfaces that are closed ---- */

static uint64_t mixed(uint64_t x) {
  x = (x ^ x >> 31) * 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 29) * 0xbf58476d1ce4e5b9u;
  return x ^ x >> 32;
}

/* Each side is passed as often to as fro: then what a number drawn for each gives, forwards added and
 * backwards taken off, is 0. */
bool sbri_meet_is_closed(const sbri_meet_surface *s) {
  uint64_t sum = 0;
  for (uint32_t t = 0; t < s->triangle_count; t++)
    for (uint32_t k = 0; k < 3; k++) {
      uint32_t from = s->triangles[3 * (size_t)t + k], to = s->triangles[3 * (size_t)t + (k + 1) % 3];
      if (from < to)
        sum += mixed((uint64_t)from << 32 | to);
      else
        sum -= mixed((uint64_t)to << 32 | from);
    }
  return s->triangle_count > 0 && sum == 0;
}

/* ---- Inside ---- */

/* Whether the side from a to b, seen along Y, passes beyond x on its line along X: of the two triangles at a
 * side, and of the sides at a corner, exactly those that do so once. */
static bool passes(sbf_vec3 x, sbf_vec3 a, sbf_vec3 b) {
  if ((a.z > x.z) == (b.z > x.z)) return false;
  sbf_vec3 low = a.z < b.z ? a : b, high = a.z < b.z ? b : a;
  return x.x < low.x + (high.x - low.x) * ((x.z - low.z) / (high.z - low.z));
}

/* What passing the triangle on the way along Y from x, up or down, counts: 1 outwards, -1 inwards. */
static int passage(sbf_vec3 x, const sbf_vec3 p[3], float up) {
  if ((passes(x, p[0], p[1]) ^ passes(x, p[1], p[2]) ^ passes(x, p[2], p[0])) == 0) return 0;
  sbf_vec3 normal = sbri_cross(sbri_sub(p[1], p[0]), sbri_sub(p[2], p[0]));
  float ahead = normal.y * sbri_dot(sbri_sub(p[0], x), normal) * up; /* of its sign */
  return !(ahead > 0) ? 0 : normal.y * up > 0 ? 1 : -1;
}

static void corners_of(const sbri_meet_surface *s, uint32_t triangle, sbf_vec3 p[3]) {
  for (uint32_t k = 0; k < 3; k++) p[k] = s->places[s->triangles[3 * (size_t)triangle + k]];
}

bool sbri_meet_is_inside(const sbri_meet_surface *s, sbf_vec3 x) {
  const sbri_box *all = &s->tree.nodes[0].box;
  sbri_box ray = sbri_box_of_point(x);
  if (!sbri_box_meets(all, &ray)) return false;
  float up = all->high.y - x.y < x.y - all->low.y ? 1.0f : -1.0f;
  ray = sbri_box_with(ray, sbri_vec3(x.x, up > 0 ? all->high.y : all->low.y, x.z));
  sbri_bounds_walk walk;
  uint32_t triangle;
  int around = 0;
  sbri_bounds_walk_begin(&walk, &s->tree, ray);
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    sbf_vec3 p[3];
    corners_of(s, triangle, p);
    around += passage(x, p, up);
  }
  return around > 0;
}

/* ---- Out ---- */

/* The nearest place of the surface within `reach`: in `best` as what is to be touched. */
static bool find_nearest(const sbri_meet_surface *s, sbf_vec3 x, float reach, sbri_surface_finding *best) {
  sbri_bounds_walk walk;
  uint32_t triangle;
  float least = reach;
  sbri_bounds_walk_begin(&walk, &s->tree, sbri_box_grown(sbri_box_of_point(x), reach));
  while (sbri_bounds_walk_next(&walk, &triangle)) {
    sbf_vec3 p[3];
    float weights[3];
    corners_of(s, triangle, p);
    sbri_triangle_nearest(x, p[0], p[1], p[2], weights);
    sbf_vec3 out = sbri_sub(sbri_triangle_place(weights, p[0], p[1], p[2]), x);
    float distance = sbri_length(out);
    if (!(distance < least) || distance < ON_IT_M) continue;
    least = distance;
    best->face = triangle, best->normal = sbri_scale(out, 1 / distance), best->behind = true;
    for (int k = 0; k < 3; k++) best->weights[k] = weights[k];
  }
  return least < reach;
}

bool sbri_meet_way_out(const sbri_party *b, sbf_vec3 x, sbri_surface_finding *best) {
  const sbri_meet_surface *s = b->surface;
  if (!s->closed || !sbri_meet_is_inside(s, x)) return false;
  float size = sbri_party_size(b);
  for (float reach = FIRST_SHARE * size; reach < size; reach *= 2)
    if (find_nearest(s, x, reach, best)) return true;
  return false;
}

/* ---- Out along a way ---- */

static sbf_vec3 into_way(const sbri_meet_way *w, sbf_vec3 x) {
  return sbri_vec3(sbri_dot(x, w->across), sbri_dot(x, w->along), sbri_dot(x, w->beside));
}

sbri_meet_way sbri_meet_way_along(sbf_vec3 along) {
  sbf_vec3 off = fabsf(along.x) < 0.6f ? sbri_vec3(1, 0, 0) : sbri_vec3(0, 1, 0);
  sbri_meet_way w = {.along = along, .across = sbri_normalize(sbri_cross(along, off), off)};
  w.beside = sbri_cross(w.across, along);
  return w;
}

/* As is_inside tells it: between two triangles nothing slips through. */
static void look_along(const sbri_meet_surface *s, const sbri_meet_way *w, sbf_vec3 x, uint32_t triangle,
    float *least, sbri_surface_finding *best) {
  sbf_vec3 p[3], q[3], from = into_way(w, x);
  corners_of(s, triangle, p);
  for (int k = 0; k < 3; k++) q[k] = into_way(w, p[k]);
  if (passage(from, q, 1) <= 0) return;
  sbf_vec3 normal = sbri_cross(sbri_sub(q[1], q[0]), sbri_sub(q[2], q[0]));
  float ahead = sbri_dot(sbri_sub(q[0], from), normal) / normal.y;
  if (!(ahead < *least)) return;
  *least = ahead;
  best->face = triangle, best->normal = w->along, best->behind = true;
  sbri_triangle_nearest(sbri_add_scaled(x, w->along, ahead), p[0], p[1], p[2], best->weights);
}

float sbri_meet_way_along_out(
    const sbri_meet_surface *s, const sbri_meet_way *w, sbf_vec3 x, float most, sbri_surface_finding *best) {
  for (float reach = FIRST_REACH_SHARE * most;; reach *= 2) {
    float far = reach < most ? reach : most, least = far;
    sbri_box ray = sbri_box_with(sbri_box_of_point(x), sbri_add_scaled(x, w->along, far));
    sbri_bounds_walk walk;
    uint32_t triangle;
    sbri_bounds_walk_begin(&walk, &s->tree, sbri_box_grown(ray, ON_IT_M));
    while (sbri_bounds_walk_next(&walk, &triangle)) look_along(s, w, x, triangle, &least, best);
    if (least < far) return least;
    if (far >= most) return INFINITY;
  }
}
