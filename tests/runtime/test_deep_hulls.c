/* Points of soft bodies against hulls of rigid ones. */
#include <math.h>

#include "collision_scenes.h"
#include "contact_scenes.h"
#include "harness.h"

static const sbf_vec3 weight = {0, -9.81f, 0};
static const float RADIUS = 0.3f;

enum { HEIGHTS = 3, CLOTHS = 9 };

/* Cloth falls on a ball, on its middle and beside it. Springs may push a point under the ball faster in a
 * tick than before. The tolerance is the distance that the stiffest springs pull points in a step: with cells
 * of 17 cm, 4.0 mm at 6 m/s and 6.1 mm at 14 m/s. */
START_TEST(cloth_does_not_enter_a_ball)
{
  static const uint32_t cells[3] = {6, 12, 24};
  static const float thicknesses[3] = {0, 0.002f, 0.02f}, heights[HEIGHTS] = {0.1f, 2, 10};
  for (int i = 0; i < 2 * HEIGHTS; i++) {
    scene s = contact_scene_begin(weight);
    float thick = thicknesses[_i % 3], height = heights[i % HEIGHTS], aside = i < HEIGHTS ? 0 : 1;
    double max = -9;
    scene_bodies(&s, 1);
    collision_sheet(
        &s, 0, (sbf_vec3){0.13f * aside, RADIUS + thick + height, 0.07f * aside}, 1, cells[_i / 3], false);
    scene_body(&s, 0)->attributes.damping_ratio = 0.05f;
    scene_body(&s, 0)->collision.outer_thickness = thick;
    rigid_box(&s, (sbf_vec3){0, 0, 0}, (sbf_vec3){2 * RADIUS, 2 * RADIUS, 2 * RADIUS}, 4);
    rigid_body(&s, 0)->motion = SBF_BODY_MOTION_KINEMATIC;
    contact_scene_ball(&s, 0, RADIUS);
    contact_scene_start(&s);
    scene_ticks(&s, (int)(60 * sqrtf(2 * height / 9.81f)) - 6);
    for (int tick = 0; tick < 40; tick++) {
      scene_ticks(&s, 1);
      max = fmax(max, contact_scene_deepest(&s));
    }
    bool coarse = cells[_i / 3] == 6 && height >= 2, bare = cells[_i / 3] < 24 && thick < 0.02f;
    double may = coarse ? 7e-3 : bare ? 3.5e-3 : 3e-3;
    ck_assert_msg(max <= may - (double)thick, "%u cells, %g m thick, from %g m, %g m aside: %g m in",
        cells[_i / 3], (double)thick, (double)height, 0.13 * (double)aside, max);
    scene_free(&s);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("meet_hull");
  TCase *tests = tcase_create("all");
  tcase_add_loop_test(tests, cloth_does_not_enter_a_ball, 0, CLOTHS);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
