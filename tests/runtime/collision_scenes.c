#include "collision_scenes.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

#include "sbfmt/mechanics.h"

void collision_surface(scene *s, uint32_t body, const sbf_vec3 *at, uint32_t columns, uint32_t rows) {
  uint32_t cells = columns - 1, count = columns * rows, squares = cells * (rows - 1);
  sbf_vec3 *points = sbf_asset_allocate(s->asset, count, sizeof *points);
  uint32_t *sizes = sbf_asset_allocate(s->asset, squares, sizeof *sizes);
  uint32_t *corners = sbf_asset_allocate(s->asset, 4 * (size_t)squares, sizeof *corners);
  ck_assert(points && sizes && corners);
  for (uint32_t i = 0; i < count; i++) points[i] = at[i];
  for (uint32_t i = 0; i < squares; i++) {
    uint32_t a = i / cells * columns + i % cells;
    const uint32_t square[4] = {a, a + columns, a + columns + 1, a + 1};
    sizes[i] = 4;
    for (int k = 0; k < 4; k++) corners[4 * i + (uint32_t)k] = square[k];
  }
  sbf_polygon_mesh *mesh = &scene_body(s, body)->surface;
  mesh->positions = (sbf_vec3_list){points, count};
  mesh->polygon_sizes = (sbf_u32_list){sizes, squares};
  mesh->polygon_points = (sbf_u32_list){corners, 4 * squares};
}

sbf_level *collision_sheet(
    scene *s, uint32_t body, sbf_vec3 center, float side, uint32_t cells, bool pinned) {
  uint32_t n = cells + 1, springs = 0, pinned_points = 0;
  sbf_vec3 *at = calloc((size_t)n * n, sizeof *at);
  float *masses = calloc((size_t)n * n, sizeof *masses),
        *stiffness = calloc(6 * (size_t)n * n, sizeof *stiffness);
  sbf_uint2 *ends = calloc(6 * (size_t)n * n, sizeof *ends);
  uint32_t *rim = calloc((size_t)n * n, sizeof *rim);
  ck_assert(at && masses && stiffness && ends && rim);
  for (uint32_t i = 0; i < n * n; i++) {
    uint32_t x = i % n, z = i / n;
    at[i] = (sbf_vec3){center.x + side * ((float)x / (float)cells - 0.5f), center.y,
        center.z + side * ((float)z / (float)cells - 0.5f)};
    masses[i] = 0.2f * side * side / (float)(n * n);
    if (pinned && (x == 0 || z == 0 || x == cells || z == cells)) rim[pinned_points++] = i;
    const int steps[6][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}};
    for (int k = 0; k < 6; k++) {
      int64_t to_x = (int64_t)x + steps[k][0], to_z = (int64_t)z + steps[k][1];
      if (to_x < 0 || to_x >= n || to_z >= n) continue;
      ends[springs] = (sbf_uint2){{i, (uint32_t)(to_z * n + to_x)}};
      stiffness[springs++] = k < 2 ? 500.0f : k < 4 ? 100.0f : 1.0f;
    }
  }
  sbf_level *level = scene_points(s, body, at, masses, n * n);
  scene_springs(s, level, ends, stiffness, springs);
  if (pinned) scene_pin(s, level, -1, rim, pinned_points);
  collision_surface(s, body, at, n, n);
  free(at), free(masses), free(stiffness), free(ends), free(rim);
  return level;
}

sbr_shape_definition collision_ball(float radius) {
  sbr_shape_definition d = sbr_default_shape_definition();
  d.radius = radius;
  return d;
}

sbr_shape_definition collision_box(float x, float y, float z) {
  sbr_shape_definition d = sbr_default_shape_definition();
  d.kind = SBR_SHAPE_BOX, d.half_sizes = (sbf_vec3){x, y, z};
  return d;
}

sbr_shape *collision_shape(sbr_shape_definition definition) {
  sbr_shape *shape = NULL;
  sbf_diagnostic error;
  ck_assert_msg(sbr_shape_create(NULL, &definition, &shape, &error) == SBF_OK, "%s", error.message);
  return shape;
}

sbr_collider_id collision_collider(scene *s, const sbr_shape *shape, sbr_double3 position) {
  sbr_collider_definition d = sbr_default_collider_definition();
  sbr_collider_id id;
  d.shape = shape, d.position = position;
  ck_assert(sbr_collider_create(s->world, &d, &id, NULL) == SBF_OK);
  return id;
}

void collision_check_over(scene *s, float (*over)(const scene *), bool collides) {
  float min = 9;
  for (int i = 0; i < 60; i++) {
    scene_ticks(s, 1);
    min = fminf(min, over(s));
  }
  if (collides)
    ck_assert_float_ge(min, 0.002f);
  else
    ck_assert_float_le(min, -0.05f);
}
