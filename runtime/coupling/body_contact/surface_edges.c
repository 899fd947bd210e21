/* Edges that can touch other edges: boundary edges and folds of sheets, ridges of closed surfaces. */
#include "coupling/body_contact/body_contacts.h"
#include "math/vec3.h"
#include "shapes/sides.h"

static bool is_bent(const sbri_contact_surface *s, uint32_t t, uint32_t k) {
  const uint32_t *c = s->triangles + 3 * (size_t)t;
  return sbri_side_is_bent(s->positions[c[k]], s->positions[c[(k + 1) % 3]], s->positions[c[(k + 2) % 3]],
      s->positions[s->opposite_vertices[3 * (size_t)t + k]]);
}

/* Normals of the two triangles at an edge, not normalized. */
static void normals_of(const sbri_contact_surface *s, uint32_t t, uint32_t k, sbf_vec3 normals[2]) {
  const uint32_t *c = s->triangles + 3 * (size_t)t;
  sbf_vec3 a = s->positions[c[k]], edge = sbri_sub(s->positions[c[(k + 1) % 3]], a);
  normals[0] = sbri_cross(edge, sbri_sub(s->positions[c[(k + 2) % 3]], a));
  normals[1] = sbri_cross(sbri_sub(s->positions[s->opposite_vertices[3 * (size_t)t + k]], a), edge);
}

/* Whether the opposite vertex is behind the triangle. */
static bool is_convex(const sbri_contact_surface *s, uint32_t t, uint32_t k, sbf_vec3 normal) {
  sbf_vec3 opposite = s->positions[s->opposite_vertices[3 * (size_t)t + k]];
  return sbri_dot(normal, sbri_sub(opposite, s->positions[s->triangles[3 * (size_t)t + k]])) < 0;
}

/* Penetration, per metre of an edge that lies across the ridge, without a vertex inside: half of the tangent
 * of half the angle between the normals. */
static float sharpness_of(const sbf_vec3 normals[2]) {
  float size = sqrtf(sbri_dot(normals[0], normals[0]) * sbri_dot(normals[1], normals[1]));
  float cosine = size > 0 ? sbri_dot(normals[0], normals[1]) / size : 1;
  return cosine > -1 ? 0.5f * sqrtf((1 - cosine) / (1 + cosine)) : INFINITY;
}

static void find_ridges(sbri_contact_surface *s) {
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    s->edge_flags[t] = 0;
    for (uint32_t k = 0; k < 3; k++) {
      if (s->opposite_vertices[3 * (size_t)t + k] >= s->vertex_count || !is_bent(s, t, k)) continue;
      const uint32_t *c = s->triangles + 3 * (size_t)t;
      sbf_vec3 normals[2];
      normals_of(s, t, k, normals);
      if (!is_convex(s, t, k, normals[0])) continue;
      s->edge_flags[t] |= (uint8_t)(1u << k);
      s->longest_ridge_m =
          fmaxf(s->longest_ridge_m, sbri_length(sbri_sub(s->positions[c[(k + 1) % 3]], s->positions[c[k]])));
      s->sharpness = fmaxf(s->sharpness, sharpness_of(normals));
    }
  }
}

/* The edge table uses the tree's memory as scratch: the tree is not built yet and is larger. */
bool sbri_surface_edges_create(sbri_contact_surface *s, sbfi_arena *arena) {
  _Static_assert(
      sizeof(sbri_bounds_node) >= 8 * sizeof(uint32_t), "a table has less than 12 entries per triangle");
  s->edge_flags = sbfi_arena_allocate(arena, (size_t)s->triangle_count + 1, 1);
  s->opposite_vertices =
      sbfi_arena_allocate(arena, 3 * (size_t)s->triangle_count + 1, sizeof *s->opposite_vertices);
  if (!s->edge_flags || !s->opposite_vertices) return false;
  sbri_sides_find(s->triangles, s->triangle_count, s->opposite_vertices, (uint32_t *)(void *)s->tree.nodes);
  s->longest_ridge_m = s->sharpness = 0;
  if (s->closed) find_ridges(s);
  return true;
}

/* ---- Of a tick ---- */

void sbri_surface_edges_update(sbri_contact_surface *s) {
  for (uint32_t t = 0; t < s->triangle_count; t++) {
    const uint32_t *opposite = s->opposite_vertices + 3 * (size_t)t;
    s->edge_flags[t] = 0;
    for (uint32_t k = 0; k < 3; k++) {
      if (opposite[k] == SBRI_SAME_SIDE) continue;
      if (opposite[k] == SBRI_RIM || is_bent(s, t, k)) s->edge_flags[t] |= (uint8_t)(1u << k);
    }
  }
}
