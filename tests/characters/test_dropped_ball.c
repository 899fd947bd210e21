/* Balls of any preset and size fall with all settings at their defaults. Those of rubber up to 25 mm need
 * more substeps than the budget, and nearly incompressible fat is strained beyond what its explicit substeps
 * bear. */
#include "dropped_ball.h"
#include "harness.h"

static const dropped_ball balls[] = {{"rubber", 0, 0.02f, 1}, {"rubber", 0.499f, 0.01f, 0.1f},
    {"fat", 0.499f, 0.015f, 0.1f}, {"jelly", 0, 0.1f, 1}, {"muscle", 0.49f, 0.05f, 0.1f}};
enum { BALLS = 5 };

START_TEST(balls_keep_shape_and_energy)
{ dropped_ball_check(&balls[_i]); }
END_TEST

/* From 3 m jelly strikes at 4.5 times its speed of sound in a rod, at the end of a tick. */
START_TEST(impacts_faster_than_sound_do_not_invert_bodies)
{
  const dropped_ball ball = {"jelly", 0, 0.02f * (float)(_i + 1), 3};
  ck_assert(!dropped_ball_inverts(&ball));
}
END_TEST

int main(void) {
  Suite *suite = suite_create("dropped_ball");
  TCase *c = tcase_create("dropped_ball");
  tcase_add_loop_test(c, balls_keep_shape_and_energy, 0, HARNESS_FEW(BALLS, 2));
  tcase_add_loop_test(c, impacts_faster_than_sound_do_not_invert_bodies, 0, HARNESS_FEW(5, 2));
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
