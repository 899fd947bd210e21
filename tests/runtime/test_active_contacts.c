/* Heavy bodies on top of light ones come to rest. */
#include <math.h>

#include "contact_scenes.h"
#include "harness.h"
#include "random.h"

static const sbf_vec3 gravity = {0, -9.81f, 0};

static double size(sbf_vec3 v) {
  return sqrt((double)v.x * (double)v.x + (double)v.y * (double)v.y + (double)v.z * (double)v.z);
}

static scene begin(void) {
  scene s = contact_scene_begin(gravity);
  s.world_definition.ground = sbr_ground_flat(0);
  s.world_definition.sleep_after_s = 0; /* sleeping bodies would hide remaining motion */
  s.character_definition.position.y = 0;
  return s;
}

/* Maximum speed of a point of any box in the next second, m/s. */
static double fastest_in_a_second(scene *s, uint32_t count, float radius) {
  double fastest = 0;
  for (int tick = 0; tick < 60; tick++) {
    scene_ticks(s, 1);
    for (uint32_t i = 0; i < count; i++) {
      sbr_rigid_state state = rigid_state(s, i);
      double speed = size(state.velocity) + (double)radius * size(state.angular_velocity);
      fastest = fmax(fastest, isfinite(speed) ? speed : 1e9);
    }
  }
  return fastest;
}

enum { BOXES = 10, STACKS = 8 };
typedef struct stack {
  uint32_t count;
  float masses[BOXES], widths[BOXES]; /* kg, m */
  float fall;                         /* m, of each box onto the one below */
} stack;
static const stack stacks[STACKS] = {{2, {1, 100}, {0.2f, 0.2f}, 1e-3f}, {2, {1, 100}, {0.2f, 0.8f}, 1e-3f},
    {2, {1, 100}, {0.2f, 0.2f}, 0.1f}, {3, {1, 1, 100}, {0.2f, 0.2f, 0.2f}, 1e-3f},
    {3, {1, 10, 100}, {0.2f, 0.3f, 0.4f}, 1e-3f}, {4, {1, 100, 1, 100}, {0.2f, 0.2f, 0.2f, 0.2f}, 1e-3f},
    {6, {1, 1, 1, 1, 1, 100}, {0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f}, 1e-3f},
    {10, {1, 1, 1, 1, 1, 1, 1, 1, 1, 100}, {0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f, 0.2f},
        1e-3f}};

START_TEST(light_boxes_carry_heavy_ones)
{
  const stack *t = &stacks[_i];
  scene s = begin();
  float top = 0, heights[BOXES];
  for (uint32_t i = 0; i < t->count; i++) {
    float width = t->widths[i], aside = 0.01f * (float)(i % 2);
    heights[i] = top + width / 2, top += width;
    rigid_box(&s, (sbf_vec3){aside, heights[i] + (float)(i + 1) * t->fall, 0},
        (sbf_vec3){width, width, width}, t->masses[i]);
  }
  contact_scene_start(&s);
  scene_ticks(&s, 120);
  double fastest = fastest_in_a_second(&s, t->count, 0.1f);
  ck_assert_msg(fastest < 4e-3, "%g m/s in the third second", fastest);
  for (uint32_t i = 0; i < t->count; i++)
    ck_assert_float_eq_tol(rigid_state(&s, i).center.y, heights[i], 1e-3f);
  scene_free(&s);
}
END_TEST

/* Masses from 1 to 100 kg in any order. */
START_TEST(heaps_of_unlike_boxes_rest)
{
  enum { COUNT = 27 };
  scene s = begin();
  uint32_t state = 7 + (uint32_t)_i;
  for (uint32_t i = 0; i < COUNT; i++) {
    float x = 0.3f * (float)(i % 3) + random_between(&state, 0, 0.05f),
          z = 0.3f * (float)(i / 3 % 3) + random_between(&state, 0, 0.05f),
          mass = powf(100, random_between(&state, 0, 1));
    rigid_box(&s, (sbf_vec3){x, 0.2f + 0.3f * (float)(i / 9), z}, (sbf_vec3){0.2f, 0.2f, 0.2f}, mass);
  }
  contact_scene_start(&s);
  scene_ticks(&s, 120);
  double fastest = fastest_in_a_second(&s, COUNT, 0.1f);
  ck_assert_msg(fastest < 4e-3, "%g m/s in the third second", fastest);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *s = suite_create("active contacts");
  TCase *c = tcase_create("active contacts");
  tcase_set_timeout(c, 60);
  tcase_add_loop_test(c, light_boxes_carry_heavy_ones, 0, STACKS);
  tcase_add_loop_test(c, heaps_of_unlike_boxes_rest, 0, 4);
  suite_add_tcase(s, c);
  return harness_run(s);
}
