/* A cloth that is pulled in two: its polygons open along the tear, by springs along their sides. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "momentum.h"
#include "scene_state.h"
#include "scenes.h"
#include "state/state.h"
#include "state/world.h"

enum {
  CELLS = 8,
  POINTS = (CELLS + 1) * (CELLS + 1),
  QUADS = CELLS * CELLS,
  SPRINGS = 2 * CELLS * (CELLS + 1)
};
static const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_POSITION_BASED, SBF_SCHEME_HEUN};
static scene s;
static sbf_vec3 positions[POINTS];
static uint32_t sizes[QUADS], corners[4 * QUADS];

static uint32_t point(uint32_t x, uint32_t z) {
  return x * (CELLS + 1) + z;
}

/* A square metre of 1 kg, weakest in the middle, whose halves fly apart; in free fall without weight. */
static void begin(sbf_scheme scheme) {
  static float masses[POINTS], stiffness[SPRINGS], weights[POINTS];
  static sbf_uint2 ends[SPRINGS];
  uint32_t springs = 0, quads = 0;
  for (uint32_t x = 0; x <= CELLS; x++)
    for (uint32_t z = 0; z <= CELLS; z++) {
      uint32_t at = point(x, z);
      positions[at] = (sbf_vec3){(float)x / CELLS, 0, (float)z / CELLS};
      masses[at] = 1.0f / POINTS;
      weights[at] = x == CELLS / 2 ? 0.2f : 1;
      if (x < CELLS) ends[springs++] = (sbf_uint2){{at, point(x + 1, z)}};
      if (z < CELLS) ends[springs++] = (sbf_uint2){{at, point(x, z + 1)}};
      if (x == CELLS || z == CELLS) continue;
      const uint32_t quad[4] = {at, point(x, z + 1), point(x + 1, z + 1), point(x + 1, z)};
      memcpy(corners + 4 * quads, quad, sizeof quad);
      sizes[quads++] = 4;
    }
  for (uint32_t i = 0; i < SPRINGS; i++) stiffness[i] = 5;
  s = scene_begin();
  sbf_level *level = scene_points(&s, 0, positions, masses, POINTS);
  scene_springs(&s, level, ends, stiffness, SPRINGS);
  sbf_soft_body *body = scene_body(&s, 0);
  body->surface.positions = level->positions;
  body->surface.polygon_sizes = (sbf_u32_list){sizes, QUADS};
  body->surface.polygon_points = (sbf_u32_list){corners, 4 * QUADS};
  body->attributes.tear_strain = 0.6f;
  sbf_weight_map *map = sbf_asset_allocate(s.asset, 1, sizeof *map);
  sbf_weight_map_init(map);
  map->property = SBF_WEIGHT_PROPERTY_TEAR_STRAIN;
  map->values = (sbf_f32_list){weights, POINTS};
  body->weight_maps = (sbf_weight_map_list){map, 1};
  scene_skin(&s, 0);
  s.model_options.scheme = scheme;
  s.world_definition.has_gravity = true, s.world_definition.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) {
    float *v = scene_velocity(&s, i);
    if (s.model->islands[0].masses[i] > 0) v[0] = 4 * (sbri_positions(c)[i].x - 0.5f) + 0.1f;
  }
}

START_TEST(a_cloth_is_pulled_in_two)
{
  uint8_t torn[QUADS];
  sbf_vec3 points[POINTS];
  begin(schemes[_i]);
  double before = scene_momentum_of(&s).linear[0];
  ck_assert_uint_eq(sbr_character_get_torn_polygons(s.world, s.character, 0, 0, torn, QUADS), QUADS);
  for (uint32_t q = 0; q < QUADS; q++) ck_assert_uint_eq(torn[q], 0);
  scene_ticks(&s, 60);
  sbr_body_health health = sbr_character_get_body_health(s.world, s.character, 0);
  ck_assert(health.finite);
  ck_assert_uint_ge(health.torn, CELLS + 1);
  ck_assert_uint_eq(health.recoveries, 0);
  ck_assert_double_eq_tol(scene_momentum_of(&s).linear[0], before, 1e-4);
  sbr_character_get_skin(s.world, s.character, 0, points, NULL, NULL, POINTS);
  sbr_character_get_torn_polygons(s.world, s.character, 0, 0, torn, QUADS);
  uint32_t open = 0;
  for (uint32_t q = 0; q < QUADS; q++) {
    float low = 1, high = 0, longest = 0;
    for (uint32_t k = 0; k < 4; k++) {
      sbf_vec3 a = points[corners[4 * q + k]], b = points[corners[4 * q + (k + 1) % 4]];
      float x = positions[corners[4 * q + k]].x;
      low = x < low ? x : low, high = x > high ? x : high;
      longest = fmaxf(
          longest, sqrtf((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z)));
    }
    open += torn[q];
    if (torn[q]) ck_assert(low <= 0.5f && high >= 0.5f); /* where it is weak */
    if (!torn[q]) ck_assert_float_lt(longest, 1.7f / CELLS);
  }
  ck_assert_uint_ge(open, CELLS);
  ck_assert_uint_le(open, 2 * CELLS);
  ck_assert_float_gt(points[point(CELLS, 0)].x - points[point(0, 0)].x, 1.5f);
  sbr_character_reset(s.world, s.character);
  sbr_character_get_torn_polygons(s.world, s.character, 0, 0, torn, QUADS);
  for (uint32_t q = 0; q < QUADS; q++) ck_assert_uint_eq(torn[q], 0);
  scene_free(&s);
}
END_TEST

/* The same cloth carries a skin of its own, four times as fine, each vertex by the three points around it:
 * the polygons over the gap are reported, and no other polygon spans it. */
START_TEST(a_skin_on_torn_springs_opens)
{
  enum { FINE = 4 * CELLS, VERTICES = (FINE + 1) * (FINE + 1), FINE_QUADS = FINE * FINE };
  static sbf_vec3 rest[VERTICES], locations[VERTICES];
  static sbf_uint4 points[VERTICES];
  static sbf_vec4 weights[VERTICES];
  static uint32_t fine_sizes[FINE_QUADS], fine_corners[4 * FINE_QUADS];
  static uint8_t torn[FINE_QUADS];
  uint32_t quads = 0;
  begin(SBF_SCHEME_SYMPLECTIC);
  for (uint32_t x = 0; x <= FINE; x++)
    for (uint32_t z = 0; z <= FINE; z++) {
      uint32_t at = x * (FINE + 1) + z, cx = x < FINE ? x / 4 : CELLS - 1, cz = z < FINE ? z / 4 : CELLS - 1;
      float u = (float)x / 4 - (float)cx, w = (float)z / 4 - (float)cz;
      rest[at] = (sbf_vec3){(float)x / FINE, 0.01f, (float)z / FINE};
      bool low = u + w <= 1;
      uint32_t corner = low ? point(cx, cz) : point(cx + 1, cz + 1);
      points[at] = (sbf_uint4){{corner, point(cx + 1, cz), point(cx, cz + 1), corner}};
      weights[at] = low ? (sbf_vec4){1 - u - w, u, w, 0} : (sbf_vec4){u + w - 1, 1 - w, 1 - u, 0};
      if (x == FINE || z == FINE) continue;
      const uint32_t quad[4] = {at, at + 1, at + FINE + 2, at + FINE + 1};
      memcpy(fine_corners + 4 * quads, quad, sizeof quad);
      fine_sizes[quads++] = 4;
    }
  sbr_world_destroy(s.world);
  sbr_model_destroy(s.model);
  sbf_render_mesh *mesh = (sbf_render_mesh *)(uintptr_t)s.asset->render_meshes.at;
  mesh->mesh.positions = (sbf_vec3_list){rest, VERTICES};
  mesh->mesh.polygon_sizes = (sbf_u32_list){fine_sizes, FINE_QUADS};
  mesh->mesh.polygon_points = (sbf_u32_list){fine_corners, 4 * FINE_QUADS};
  sbf_level *level = (sbf_level *)(uintptr_t)s.asset->soft_bodies.at[0].levels.at;
  sbf_embedding *embedding = (sbf_embedding *)(uintptr_t)level->embeddings.at;
  embedding->points = (sbf_uint4_list){points, VERTICES};
  embedding->weights = (sbf_vec4_list){weights, VERTICES};
  scene_start(&s);
  sbri_character *c = &s.world->characters[0];
  for (uint32_t i = 0; i < s.model->islands[0].free_count; i++) {
    float *v = scene_velocity(&s, i);
    if (s.model->islands[0].masses[i] > 0) v[0] = 4 * (sbri_positions(c)[i].x - 0.5f) + 0.1f;
  }
  ck_assert_uint_eq(
      sbr_character_get_torn_polygons(s.world, s.character, 0, 0, torn, FINE_QUADS), FINE_QUADS);
  for (uint32_t q = 0; q < FINE_QUADS; q++) ck_assert_uint_eq(torn[q], 0);
  scene_ticks(&s, 60);
  sbr_character_get_skin(s.world, s.character, 0, locations, NULL, NULL, VERTICES);
  sbr_character_get_torn_polygons(s.world, s.character, 0, 0, torn, FINE_QUADS);
  uint32_t open = 0;
  for (uint32_t q = 0; q < FINE_QUADS; q++) {
    float longest = 0;
    for (uint32_t k = 0; k < 4; k++) {
      sbf_vec3 a = locations[fine_corners[4 * q + k]], b = locations[fine_corners[4 * q + (k + 1) % 4]];
      longest = fmaxf(longest, fabsf(a.x - b.x));
    }
    open += torn[q];
    if (!torn[q]) ck_assert_msg(longest < 3.0f / FINE, "polygon %u: %g m", q, (double)longest);
  }
  /* No vertex is left between the halves: each lies within a cell of a point of its own. */
  for (uint32_t v = 0; v < VERTICES; v++) {
    float nearest = 1;
    for (uint32_t p = 0; p < POINTS; p++) {
      sbf_vec3 at = scene_point(&s, 0, p);
      float x = at.x - locations[v].x, z = at.z - locations[v].z;
      nearest = fminf(nearest, sqrtf(x * x + z * z));
    }
    ck_assert_msg(nearest < 1.0f / CELLS, "vertex %u is %g m from any point", v, (double)nearest);
  }
  ck_assert_uint_ge(open, FINE);     /* all along the tear */
  ck_assert_uint_le(open, 6 * FINE); /* and nowhere else */
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("torn_sides");
  TCase *c = tcase_create("torn_sides");
  tcase_add_loop_test(c, a_cloth_is_pulled_in_two, 0, 3);
  tcase_add_test(c, a_skin_on_torn_springs_opens);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
