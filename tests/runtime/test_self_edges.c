/* Rims and ridges of a sheet against itself, and strips that fold onto themselves. */
#include <math.h>

#include "collision_scenes.h"
#include "grid_scenes.h"
#include "harness.h"
#include "math/vec3.h"

/* ---- Crossing edges without a point nearby ---- */

enum { ROWS = 6, PART = 2 * ROWS };

/* Two strips of one body, 1 m by 4 cm in five squares, at a right angle, the second 10 cm over the first,
 * which is pinned at its ends. */
static void strips(sbf_vec3 at[2 * PART]) {
  for (uint32_t i = 0; i < 2 * PART; i++) {
    float u = 0.2f * (float)(i % PART / 2) - 0.5f, v = i % 2 ? 0.02f : -0.02f;
    at[i] = i < PART ? (sbf_vec3){u, 0, v} : (sbf_vec3){0.01f - v, 0.1f, u + 0.02f};
  }
}

/* How far the second is over the first where the lines along their middles cross, seen from above. */
static float over(const scene *s) {
  sbf_vec3 mid[4];
  for (uint32_t k = 0; k < 4; k++) {
    uint32_t first = (k < 2 ? 4 : PART + 4) + 2 * (k % 2);
    mid[k] = sbri_lerp(scene_point(s, 0, first), scene_point(s, 0, first + 1), 0.5f);
  }
  float u = (mid[2].x - mid[0].x) / (mid[1].x - mid[0].x), v = (mid[0].z - mid[2].z) / (mid[3].z - mid[2].z);
  return sbri_lerp(mid[2], mid[3], v).y - sbri_lerp(mid[0], mid[1], u).y;
}

/* A part that falls across another part of the same body does not pass through it; without `self` it does. */
START_TEST(rims_collide_with_their_own_body)
{
  static sbf_vec3 at[2 * PART];
  const uint32_t pinned[4] = {0, 1, PART - 2, PART - 1};
  strips(at);
  for (int contacts = 0; contacts < 2; contacts++) {
    grid g = {at, 2, 2 * ROWS, ROWS, 0.01f, 1000, 100};
    scene s = grid_begin(&g);
    scene_pin(&s, (sbf_level *)(uintptr_t)scene_body(&s, 0)->levels.at, -1, pinned, 4);
    scene_body(&s, 0)->collision.self = contacts;
    scene_start(&s);
    collision_check_over(&s, over, contacts);
    scene_free(&s);
  }
}
END_TEST

/* ---- A strip that folds to three legs ---- */

enum { ACROSS = 5, ALONG = 49, ALL = ACROSS * ALONG };

static void three_legs(sbf_vec3 at[ALL]) {
  const float r = 0.03f, pi = 3.14159265f, leg = 0.3f;
  for (uint32_t i = 0; i < ALL; i++) {
    float u = (float)(i / ACROSS) / 48 * (3 * leg + 2 * pi * r), x, y, bend = pi * r;
    if (u < leg) {
      x = u, y = 0;
    } else if (u < leg + bend) {
      float angle = (u - leg) / r;
      x = leg + r * sinf(angle), y = r - r * cosf(angle);
    } else if (u < 2 * leg + bend) {
      x = 2 * leg + bend - u, y = 2 * r;
    } else if (u < 2 * leg + 2 * bend) {
      float angle = (u - 2 * leg - bend) / r;
      x = -r * sinf(angle), y = 3 * r - r * cosf(angle);
    } else {
      x = u - 2 * leg - 2 * bend, y = 4 * r;
    }
    at[i] = (sbf_vec3){x, y + 0.01f, 0.025f * (float)(i % ACROSS)};
  }
}

/* Sides of squares that go through triangles more than two rows away. */
static uint32_t count_pierced(const sbf_vec3 at[ALL]) {
  uint32_t count = 0;
  for (uint32_t a = 0; a < ALL; a++)
    for (uint32_t k = 0; k < 2; k++) {
      uint32_t b = a + (k ? ACROSS : 1);
      if (b >= ALL || (!k && a % ACROSS == ACROSS - 1)) continue;
      for (uint32_t c = 0; c + ACROSS < ALL; c++) {
        uint32_t rows = a / ACROSS > c / ACROSS ? a / ACROSS - c / ACROSS : c / ACROSS - a / ACROSS;
        if (c % ACROSS == ACROSS - 1 || rows <= 2) continue;
        count += grid_pierces(at[a], at[b], at[c], at[c + ACROSS], at[c + ACROSS + 1]) ||
                 grid_pierces(at[a], at[b], at[c], at[c + ACROSS + 1], at[c + 1]);
      }
    }
  return count;
}

static scene strip_of_three_legs(void) {
  static sbf_vec3 at[ALL];
  three_legs(at);
  grid g = {at, ACROSS, ALONG, 0, 0.0005f, 100, 0.2f};
  scene s = grid_begin(&g);
  s.world_definition.ground = sbr_ground_flat(0);
  s.character_definition.position.y = 0;
  return s;
}

/* It falls to the ground and folds, leg on leg, each point between two of them. None passes through. */
START_TEST(a_strip_folds_to_three_legs)
{
  scene s = strip_of_three_legs();
  scene_start(&s);
  for (int i = 0; i < 300; i++) {
    static sbf_vec3 now[ALL];
    scene_ticks(&s, 1);
    scene_read(&s, 0, now, ALL);
    if (i < 30 || i % 5 == 0) ck_assert_uint_eq(count_pierced(now), 0);
  }
  scene_free(&s);
}
END_TEST

/* It also comes to rest: a contact that lifts a point out of one leg does not push it into the next. (It used
 * to tremble at 0.1 m/s permanently.) */
START_TEST(three_legs_lie_still)
{
  static sbf_vec3 before[ALL], now[ALL];
  const float frictions[3] = {1, 0.5f, 0.1f};
  scene s = strip_of_three_legs();
  scene_body(&s, 0)->attributes.friction = frictions[_i];
  scene_start(&s);
  scene_ticks(&s, 420);
  float fastest = 0;
  for (int i = 0; i < 60; i++) {
    scene_read(&s, 0, before, ALL);
    scene_ticks(&s, 1);
    scene_read(&s, 0, now, ALL);
    for (int k = 0; k < ALL; k++) {
      float speed = 60 * sbri_length(sbri_sub(now[k], before[k]));
      fastest = speed > fastest ? speed : fastest;
    }
  }
  ck_assert_float_le(fastest, 5e-3f);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("self_edges");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, rims_collide_with_their_own_body);
  tcase_add_test(tests, a_strip_folds_to_three_legs);
  tcase_add_loop_test(tests, three_legs_lie_still, 0, 3);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
