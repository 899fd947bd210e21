/* Surfaces that pass through themselves separate again. */
#include <math.h>

#include "collision_scenes.h"
#include "grid_scenes.h"
#include "harness.h"
#include "math/vec3.h"
#include "state/world.h"

enum { COLUMNS = 21, ROWS = 25, ALL = COLUMNS * ROWS };

static bool are_separated(const uint32_t ends[2], const uint32_t t[3]) {
  for (int k = 0; k < 3; k++)
    if (t[k] == ends[0] || t[k] == ends[1]) return false;
  return true;
}

/* Number of triangles that an edge passes through. */
static uint32_t count_of_side(const sbf_vec3 at[ALL], const uint32_t ends[2]) {
  uint32_t count = 0;
  for (uint32_t c = 0; c + COLUMNS < ALL; c++) {
    const uint32_t two[2][3] = {{c, c + COLUMNS, c + COLUMNS + 1}, {c, c + COLUMNS + 1, c + 1}};
    for (int k = 0; k < 2 && c % COLUMNS < COLUMNS - 1; k++)
      count += are_separated(ends, two[k]) &&
               grid_pierces(at[ends[0]], at[ends[1]], at[two[k][0]], at[two[k][1]], at[two[k][2]]);
  }
  return count;
}

/* Sum over the edges of all triangles. */
static uint32_t count_all(const sbf_vec3 at[ALL]) {
  static const uint32_t steps[3] = {1, COLUMNS, COLUMNS + 1};
  uint32_t count = 0;
  for (uint32_t a = 0; a < ALL; a++)
    for (uint32_t k = 0; k < 3; k++) {
      const uint32_t ends[2] = {a, a + steps[k]};
      if (ends[1] < ALL && (k == 1 || a % COLUMNS < COLUMNS - 1)) count += count_of_side(at, ends);
    }
  return count;
}

/* A sheet dropped on its edge crumples and passes through itself at its corners. After two and a half seconds
 * no edge does. (40 of its edges used to.) */
START_TEST(a_crumpled_sheet_does_not_intersect_itself)
{
  static sbf_vec3 at[ALL], now[ALL];
  for (uint32_t i = 0; i < ALL; i++) {
    uint32_t x = i % COLUMNS, y = i / COLUMNS;
    at[i] = (sbf_vec3){
        0.025f * (float)x, 0.03f + 0.025f * (float)y, 0.004f * sinf((float)x * 0.9f + (float)y * 0.5f)};
  }
  grid g = {at, COLUMNS, ROWS, 0, 0.0002f, 60, 0.2f};
  scene s = grid_begin(&g);
  scene_body(&s, 0)->attributes.friction = 0.5f;
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  scene_start(&s);
  scene_ticks(&s, 150);
  scene_read(&s, 0, now, ALL);
  ck_assert_uint_eq(count_all(now), 0);
  ck_assert(sbr_character_get_body_health(s.world, s.character, 0).finite);
  scene_free(&s);
}
END_TEST

/* Two strips that cross at rest stay as they are. */
START_TEST(intersections_at_rest_stay)
{
  enum { STRIP = 12, POINTS = 2 * STRIP };
  static sbf_vec3 at[POINTS];
  for (uint32_t i = 0; i < POINTS; i++) {
    float u = 0.2f * (float)(i % STRIP / 2) - 0.5f, side = i % 2 ? 1.0f : -1.0f;
    at[i] = i < STRIP ? (sbf_vec3){u, 0, 0.04f * side} : (sbf_vec3){0.03f + 0.01f * side, u, 0.02f * side};
  }
  grid g = {at, 2, 12, 6, 0.01f, 1000, 100};
  scene s = grid_begin(&g);
  scene_body(&s, 0)->collision.outer_thickness = 0.2f;
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  scene_ticks(&s, 60);
  for (uint32_t i = 0; i < POINTS; i++)
    ck_assert_float_le(sbri_length(sbri_sub(scene_point(&s, 0, i), at[i])), 1e-5f);
  scene_free(&s);
}
END_TEST

/* ---- Closed surfaces ---- */

/* Of two cubes of 10 cm, or one and a thin bar, whose corners have springs to each other. */
static const uint32_t cube_quads[24] = {
    0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};

static void two_boxes(scene *s, bool bar) {
  static sbf_vec3 at[16];
  static float kg[16], stiffness[56];
  static sbf_uint2 ends[56];
  static uint32_t corners[48], sizes[12];
  uint32_t count = 0;
  for (uint32_t i = 0; i < 16; i++) {
    float x = i & 1 ? 0.05f : -0.05f, y = i & 2 ? 0.05f : -0.05f, z = i & 4 ? 0.05f : -0.05f;
    sbf_vec3 turned = {0.94f * x - 0.34f * z + 0.013f, y + 0.2f, 0.34f * x + 0.94f * z + 0.021f},
             thin = {0.2f * x + 0.03f, 3 * y + 0.3f, 0.2f * z - 0.02f};
    at[i] = i < 8 ? (sbf_vec3){x, y, z} : bar ? thin : turned;
    kg[i] = 0.05f;
    for (uint32_t j = i + 1; j < (i / 8 + 1) * 8; j++)
      ends[count] = (sbf_uint2){{i, j}}, stiffness[count++] = 500;
  }
  for (uint32_t i = 0; i < 48; i++) corners[i] = cube_quads[i % 24] + i / 24 * 8;
  for (uint32_t i = 0; i < 12; i++) sizes[i] = 4;
  scene_springs(s, scene_points(s, 0, at, kg, 16), ends, stiffness, count);
  sbf_polygon_mesh *mesh = &scene_body(s, 0)->surface;
  mesh->positions = (sbf_vec3_list){at, 16};
  mesh->polygon_sizes = (sbf_u32_list){sizes, 12};
  mesh->polygon_points = (sbf_u32_list){corners, 48};
}

/* Sides of one cube through triangles of the other. */
static uint32_t count_cubes(const sbf_vec3 at[16]) {
  uint32_t count = 0;
  for (uint32_t e = 0; e < 48; e++) {
    uint32_t cube = e / 24 * 8, a = cube + cube_quads[e % 24],
             b = cube + cube_quads[e % 24 / 4 * 4 + (e + 1) % 4];
    for (uint32_t t = 0; t < 12; t++) {
      const uint32_t *q = cube_quads + t / 2 * 4, other = 8 - cube;
      count +=
          grid_pierces(at[a], at[b], at[other + q[0]], at[other + q[1 + t % 2]], at[other + q[2 + t % 2]]);
    }
  }
  return count;
}

/* One box of a body is placed so deep in the other that no corner is within `inner_thickness` of a face, and
 * neither is any edge of a thin bar. It separates, and the body as a whole stays in place. (It used to stay
 * inside.) */
START_TEST(deep_self_intersections_separate)
{
  static const float deep_m[] = {0.03f, 0.045f, 0.06f, 0.04f};
  sbf_vec3 at[16], before[16];
  scene s = scene_begin();
  two_boxes(&s, _i == 3);
  sbf_soft_body *body = scene_body(&s, 0);
  body->collision.self = true;
  body->collision.outer_thickness = 0.001f, body->collision.inner_thickness = 0.001f;
  body->attributes.mass_damping = 1;
  s.asset->environment.gravity = (sbf_vec3){0, 0, 0};
  scene_start(&s);
  sbri_character *c = sbri_character_of(s.world, s.character);
  for (uint32_t i = 8; i < 16; i++)
    sbri_positions(c)[c->model->bodies[0].slots.from_point[i]].y -= 0.1f + deep_m[_i];
  scene_read(&s, 0, before, 16);
  ck_assert_uint_gt(count_cubes(before), 0);
  scene_ticks(&s, 60);
  scene_read(&s, 0, at, 16);
  sbf_vec3 moved = {0, 0, 0};
  for (int i = 0; i < 16; i++) moved = sbri_add_scaled(moved, sbri_sub(at[i], before[i]), 1.0f / 16);
  ck_assert_uint_eq(count_cubes(at), 0);
  ck_assert_float_le(sbri_length(moved), 1e-5f);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("self_cross");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_crumpled_sheet_does_not_intersect_itself);
  tcase_add_test(tests, intersections_at_rest_stay);
  tcase_add_loop_test(tests, deep_self_intersections_separate, 0, 4);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
