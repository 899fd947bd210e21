#include "grid_scenes.h"

#include <math.h>
#include <string.h>

#include "harness.h"
#include "math/vec3.h"

enum { MAX_POINTS = 640 };

static bool joined(const grid *g, uint32_t a, uint32_t b) {
  return g->cut == 0 || (a / g->columns < g->cut) == (b / g->columns < g->cut);
}

static void add_surface(scene *s, const grid *g) {
  static uint32_t sizes[MAX_POINTS], corners[4 * MAX_POINTS];
  uint32_t count = 0;
  for (uint32_t a = 0; a + g->columns < g->columns * g->rows; a++) {
    const uint32_t square[4] = {a, a + g->columns, a + g->columns + 1, a + 1};
    if (a % g->columns == g->columns - 1 || !joined(g, a, a + g->columns)) continue;
    memcpy(corners + 4 * (size_t)count, square, sizeof square);
    sizes[count++] = 4;
  }
  sbf_polygon_mesh *mesh = &scene_body(s, 0)->surface;
  mesh->positions = (sbf_vec3_list){g->at, g->columns * g->rows};
  mesh->polygon_sizes = (sbf_u32_list){sizes, count};
  mesh->polygon_points = (sbf_u32_list){corners, 4 * count};
}

scene grid_begin(const grid *g) {
  static float masses[MAX_POINTS], stiffness[6 * MAX_POINTS];
  static sbf_uint2 ends[6 * MAX_POINTS];
  scene s = scene_begin();
  uint32_t count = g->columns * g->rows, springs = 0;
  ck_assert_uint_le(count, MAX_POINTS);
  for (uint32_t i = 0; i < count; i++) {
    static const int steps[6][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}};
    masses[i] = g->point_kg;
    for (int k = 0; k < 6; k++) {
      int x = (int)(i % g->columns) + steps[k][0], y = (int)(i / g->columns) + steps[k][1];
      uint32_t to = (uint32_t)(y * (int)g->columns + x);
      if (x < 0 || x >= (int)g->columns || y >= (int)g->rows || !joined(g, i, to)) continue;
      ends[springs] = (sbf_uint2){{i, to}};
      stiffness[springs++] = k < 2 ? g->stiffness : k < 4 ? 0.3f * g->stiffness : g->bending;
    }
  }
  sbf_level *level = scene_points(&s, 0, g->at, masses, count);
  scene_springs(&s, level, ends, stiffness, springs);
  add_surface(&s, g);
  scene_body(&s, 0)->attributes.mass_damping = 1;
  scene_body(&s, 0)->attributes.friction = 1;
  scene_body(&s, 0)->collision.self = true;
  scene_body(&s, 0)->collision.outer_thickness = 0.005f;
  return s;
}

bool grid_pierces(sbf_vec3 a, sbf_vec3 b, sbf_vec3 p, sbf_vec3 q, sbf_vec3 r) {
  sbf_vec3 n = sbri_cross(sbri_sub(q, p), sbri_sub(r, p));
  float from = sbri_dot(n, sbri_sub(a, p)), to = sbri_dot(n, sbri_sub(b, p));
  if ((from > 0) == (to > 0) || fabsf(from - to) < 1e-9f) return false;
  sbf_vec3 x = sbri_add_scaled(a, sbri_sub(b, a), from / (from - to));
  return sbri_dot(n, sbri_cross(sbri_sub(q, p), sbri_sub(x, p))) > 0 &&
         sbri_dot(n, sbri_cross(sbri_sub(r, q), sbri_sub(x, q))) > 0 &&
         sbri_dot(n, sbri_cross(sbri_sub(p, r), sbri_sub(x, r))) > 0;
}
