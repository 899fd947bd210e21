#include "animation/gait/glide.h"

#include "harness.h"

static const float TICK_S = 1.0f / 60;

START_TEST(a_glide_from_rest_to_rest_follows_the_smooth_rise)
{
  enum { TICKS = 30 };
  sbri_glide g = sbri_glide_at(2);
  for (int i = 1; i <= TICKS; i++) {
    sbri_glide_tick(&g, 5, (float)(TICKS + 1 - i) * TICK_S, TICK_S);
    ck_assert_float_eq_tol(g.position, 2 + 3 * sbri_smooth((float)i / TICKS), 1e-4f);
  }
  ck_assert(g.position == 5 && g.velocity == 0 && g.acceleration == 0);
}
END_TEST

START_TEST(the_smooth_rise_rests_at_both_ends_and_beyond_them)
{
  ck_assert(sbri_smooth(0) == 0 && sbri_smooth(1) == 1);
  ck_assert(sbri_smooth(-3) == 0 && sbri_smooth(4) == 1);
  ck_assert_float_eq(sbri_smooth(0.5f), 0.5f);
  ck_assert_float_le(sbri_smooth(0.01f), 1.01e-5f); /* 10 t^3: no speed, no acceleration */
  ck_assert_float_eq_tol(sbri_smooth(0.3f) + sbri_smooth(0.7f), 1, 1e-6f);
}
END_TEST

START_TEST(a_target_that_moves_is_reached_without_a_jump_of_speed)
{
  enum { TICKS = 40 };
  sbri_glide g = sbri_glide_at(0);
  float target = 1;
  for (int i = 1; i <= TICKS; i++) {
    float rate = g.velocity;
    if (i > 15) target = 1.2f;
    sbri_glide_tick(&g, target, (float)(TICKS + 1 - i) * TICK_S, TICK_S);
    ck_assert_float_eq_tol(g.velocity, rate, 0.35f); /* a jump by the change within its tick were 12 m/s */
  }
  ck_assert_float_eq(g.position, 1.2f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("glide");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, a_glide_from_rest_to_rest_follows_the_smooth_rise);
  tcase_add_test(tests, the_smooth_rise_rests_at_both_ends_and_beyond_them);
  tcase_add_test(tests, a_target_that_moves_is_reached_without_a_jump_of_speed);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
