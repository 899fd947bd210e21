/* All of what test_dropped_ball.c takes a choice of. */
#include "dropped_ball.h"
#include "harness.h"

static const char *const presets[] = {"fat", "flesh", "jelly", "muscle", "rubber"};
static const float radii[] = {0.01f, 0.015f, 0.02f, 0.025f, 0.05f, 0.1f},
                   ratios[] = {0, 0.3f, 0.45f, 0.49f, 0.499f}, heights[] = {0.1f, 1};
enum { PRESETS = 5, RADII = 6, RATIOS = 5 };

START_TEST(every_preset_at_every_size)
{
  for (int n = 0; n < RATIOS; n++)
    for (int h = 0; h < 2; h++)
      dropped_ball_check(&(dropped_ball){presets[_i / RADII], ratios[n], radii[_i % RADII], heights[h]});
}
END_TEST

int main(void) {
  Suite *suite = suite_create("dropped_matrix");
  TCase *c = tcase_create("dropped_matrix");
  tcase_set_timeout(c, 1800);
  tcase_add_loop_test(c, every_preset_at_every_size, 0, PRESETS * RADII);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
