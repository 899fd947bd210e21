/* All of what test_dropped_ball.c takes a choice of. */
#include "dropped_ball.h"
#include "harness.h"

static const char *const presets[] = {"fat", "flesh", "jelly", "muscle", "rubber"};
static const float radii[] = {0.01f, 0.015f, 0.02f, 0.025f, 0.05f, 0.1f},
                   ratios[] = {0, 0.3f, 0.45f, 0.49f, 0.499f}, heights[] = {0.1f, 1};
enum { PRESETS = 5, RADII = 6, RATIOS = 5, HEIGHTS = 2 };

START_TEST(every_preset_at_every_size)
{
  int height = _i % HEIGHTS, ratio = _i / HEIGHTS % RATIOS, size = _i / (HEIGHTS * RATIOS);
  dropped_ball_check(
      &(dropped_ball){presets[size / RADII], ratios[ratio], radii[size % RADII], heights[height]});
}
END_TEST

int main(void) {
  Suite *suite = suite_create("dropped_matrix");
  TCase *c = tcase_create("dropped_matrix");
  tcase_add_loop_test(c, every_preset_at_every_size, 0, PRESETS * RADII * RATIOS * HEIGHTS);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
