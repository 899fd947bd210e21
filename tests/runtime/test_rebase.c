#include <math.h>

#include "harness.h"
#include "scenes.h"

enum { SECONDS = 15, TICKS = 60 * SECONDS };
static const float pull = 9.81f;
static const float scales[] = {1, 0.01f, 0.3f}, bounds[] = {2e-4f, 2e-3f, 6e-4f};

/* A loose bar of any size falls sideways for a kilometre. Its middle is where it should be, and rounding on
 * the way does not strain it. */
START_TEST(bodies_that_fly_far_keep_their_shape)
{
  scene s = scene_begin();
  lattice_box box =
      lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.25f, 0.25f}, 8, 2, 2, 1000, 1e6f, 0.3f);
  scene_lattice(&s, 0, &box);
  lattice_box_free(&box);
  scene_body(&s, 0)->attributes.damping_ratio = 0.1f;
  s.character_definition.scale = scales[_i];
  s.world_definition.has_gravity = true;
  s.world_definition.gravity = (sbf_vec3){pull, 0, 0};
  scene_start(&s);
  double begin = sbr_character_get_origin(s.world, s.character).x + (double)scene_point(&s, 0, 0).x;
  float max = 0;
  for (int i = 0; i < TICKS; i++) {
    scene_ticks(&s, 1);
    max = fmaxf(max, sbr_character_get_body_health(s.world, s.character, 0).max_strain);
  }
  ck_assert_float_le(max, bounds[_i]); /* a centimetre at 150 m/s moves 250 times its size in a tick */
  sbf_vec3 at = scene_point(&s, 0, 0);
  double travel = sbr_character_get_origin(s.world, s.character).x + (double)at.x - begin;
  double exact = 0.5 * (double)pull * SECONDS * SECONDS;
  ck_assert_double_eq_tol(travel, exact, 2e-3 * exact);
  ck_assert_float_le(fabsf(at.x), 20);
  sbr_character_reset(s.world, s.character); /* it stands where it began */
  scene_ticks(&s, 1);
  travel = sbr_character_get_origin(s.world, s.character).x + (double)scene_point(&s, 0, 0).x - begin;
  ck_assert_double_le(fabs(travel), 0.01);
  scene_free(&s);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("rebase");
  TCase *c = tcase_create("rebase");
  tcase_add_loop_test(c, bodies_that_fly_far_keep_their_shape, 0, sizeof scales / sizeof *scales);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
