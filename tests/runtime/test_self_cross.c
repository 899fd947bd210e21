/* What has gone through itself comes out again. */
#include <math.h>

#include "collision_scenes.h"
#include "grid_scenes.h"
#include "harness.h"
#include "math/vec3.h"

enum { COLUMNS = 21, ROWS = 25, ALL = COLUMNS * ROWS };

static bool are_apart(const uint32_t ends[2], const uint32_t t[3]) {
  for (int k = 0; k < 3; k++)
    if (t[k] == ends[0] || t[k] == ends[1]) return false;
  return true;
}

/* How many triangles a side goes through. */
static uint32_t count_of_side(const sbf_vec3 at[ALL], const uint32_t ends[2]) {
  uint32_t count = 0;
  for (uint32_t c = 0; c + COLUMNS < ALL; c++) {
    const uint32_t two[2][3] = {{c, c + COLUMNS, c + COLUMNS + 1}, {c, c + COLUMNS + 1, c + 1}};
    for (int k = 0; k < 2 && c % COLUMNS < COLUMNS - 1; k++)
      count += are_apart(ends, two[k]) &&
               grid_pierces(at[ends[0]], at[ends[1]], at[two[k][0]], at[two[k][1]], at[two[k][2]]);
  }
  return count;
}

/* Over the sides of all triangles. */
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

/* A sheet dropped on its edge crumples, and goes through itself at its corners as it does: after two and a
 * half seconds nothing of it does any more. (40 of its sides went on to.) */
START_TEST(a_crumpled_sheet_is_not_through_itself)
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
  ck_assert(sbr_character_health(s.world, s.character, 0).finite);
  scene_free(&s);
}
END_TEST

/* Two strips that go through each other at rest let each other be. */
START_TEST(what_is_through_itself_at_rest_stays)
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

int main(void) {
  Suite *suite = suite_create("self_cross");
  TCase *tests = tcase_create("all");
  tcase_set_timeout(tests, 120);
  tcase_add_test(tests, a_crumpled_sheet_is_not_through_itself);
  tcase_add_test(tests, what_is_through_itself_at_rest_stays);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
