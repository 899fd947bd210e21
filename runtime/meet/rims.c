/* What stands out of a surface: rims of a sheet and what it is bent across, ridges of a closed one. */
#include "collide/sides.h"
#include "math/vec3.h"
#include "meet/meetings.h"

static bool bends(const sbri_meet_surface *s, uint32_t t, uint32_t k) {
  const uint32_t *c = s->triangles + 3 * (size_t)t;
  return sbri_side_is_bent(s->places[c[k]], s->places[c[(k + 1) % 3]], s->places[c[(k + 2) % 3]],
      s->places[s->sides[3 * (size_t)t + k]]);
}

/* The normals beside a side of a triangle, of any length. */
static void normals_of(const sbri_meet_surface *s, uint32_t t, uint32_t k, sbf_vec3 normals[2]) {
  const uint32_t *c = s->triangles + 3 * (size_t)t;
  sbf_vec3 a = s->places[c[k]], along = sbri_sub(s->places[c[(k + 1) % 3]], a);
  normals[0] = sbri_cross(along, sbri_sub(s->places[c[(k + 2) % 3]], a));
  normals[1] = sbri_cross(sbri_sub(s->places[s->sides[3 * (size_t)t + k]], a), along);
}

/* Whether what lies beyond the side is behind the triangle. */
static bool is_convex(const sbri_meet_surface *s, uint32_t t, uint32_t k, sbf_vec3 normal) {
  sbf_vec3 beyond = s->places[s->sides[3 * (size_t)t + k]];
  return sbri_dot(normal, sbri_sub(beyond, s->places[s->triangles[3 * (size_t)t + k]])) < 0;
}

/* How deep of something as long as 1 m may be at the ridge unnoticed: half of the tangent of half the angle
 * between the normals beside it. */
static float sharpness_of(const sbf_vec3 normals[2]) {
  float size = sqrtf(sbri_dot(normals[0], normals[0]) * sbri_dot(normals[1], normals[1]));
  float cosine = size > 0 ? sbri_dot(normals[0], normals[1]) / size : 1;
  return cosine > -1 ? 0.5f * sqrtf((1 - cosine) / (1 + cosine)) : INFINITY;
}

static void note_ridges(sbri_meet_surface *s) {
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    s->rims[t] = 0;
    for (uint32_t k = 0; k < 3; k++) {
      if (s->sides[3 * (size_t)t + k] >= s->vertex_count || !bends(s, t, k)) continue;
      const uint32_t *c = s->triangles + 3 * (size_t)t;
      sbf_vec3 normals[2];
      normals_of(s, t, k, normals);
      if (!is_convex(s, t, k, normals[0])) continue;
      s->rims[t] |= (uint8_t)(1u << k);
      s->ridge_m = fmaxf(s->ridge_m, sbri_length(sbri_sub(s->places[c[(k + 1) % 3]], s->places[c[k]])));
      s->sharpness = fmaxf(s->sharpness, sharpness_of(normals));
    }
  }
}

/* The table of sides is scratch: no tree is made yet, and its room is more. */
bool sbri_meet_rims_make(sbri_meet_surface *s, sbfi_arena *arena) {
  _Static_assert(
      sizeof(sbri_bounds_node) >= 8 * sizeof(uint32_t), "a table has less than 12 entries a triangle");
  s->rims = sbfi_arena_allocate(arena, (size_t)s->triangle_count + 1, 1);
  s->sides = sbfi_arena_allocate(arena, 3 * (size_t)s->triangle_count + 1, sizeof *s->sides);
  if (!s->rims || !s->sides) return false;
  sbri_sides_find(s->triangles, s->triangle_count, s->sides, (uint32_t *)(void *)s->tree.nodes);
  s->ridge_m = s->sharpness = 0;
  if (s->closed) note_ridges(s);
  return true;
}

/* ---- Of a tick ---- */

void sbri_meet_rims_look(sbri_meet_surface *s) {
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    const uint32_t *beside = s->sides + 3 * (size_t)t;
    s->rims[t] = 0;
    for (uint32_t k = 0; k < 3; k++) {
      if (beside[k] == SBRI_SAME_SIDE) continue;
      if (beside[k] == SBRI_RIM || bends(s, t, k)) s->rims[t] |= (uint8_t)(1u << k);
    }
  }
}
