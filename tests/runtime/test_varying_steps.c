/* Verlet's method without velocities gains energy without bound if its steps vary. The runtime's do not vary,
 * because its substeps divide a fixed tick at any frame time. */
#include <math.h>

#include "harness.h"
#include "scenes.h"

static const double HEIGHT_M = 0.02, TICK_S = 1.0 / 60;

/* -1 to 1, by Marsaglia's xorshift (2003). Numbers of a congruential generator are too regular for a random
 * gain. */
static double chance(uint32_t *state) {
  *state ^= *state << 13;
  *state ^= *state >> 17;
  *state ^= *state << 5;
  return *state / 0x1p31 - 1;
}

/* How high above where it began a mass gets within so many steps of x' = x + (x - xp) h'/h - w^2 x h'h'',
 * where h' is TICK_S more or less by up to `jitter`. `knows` what the step before took: h'/h, and h'' = (h +
 * h') / 2; else both steps are taken for equally long. */
static double position_verlet(double turn, double jitter, uint32_t steps, bool knows) {
  double w = turn / TICK_S, h = TICK_S, before = HEIGHT_M, x = HEIGHT_M, max = 0;
  uint32_t state = 5;
  for (uint32_t i = 0; i < steps; i++) {
    double next = TICK_S * (1 + jitter * chance(&state));
    double kept = knows ? next / h : 1, mean = knows ? 0.5 * (next + h) : next;
    double at = x + (x - before) * kept - w * w * x * next * mean;
    before = x, x = at, h = next;
    max = fmax(max, fabs(x) / HEIGHT_M);
  }
  return max;
}

/* The same in the runtime, symplectic, a substep a tick, in frames of such lengths. */
static double in_frames(double turn, double jitter, uint32_t frames) {
  scene s = scene_begin();
  double w = turn / TICK_S, max = 0;
  const float masses[] = {0, 1}, stiffness = (float)(w * w);
  const sbf_vec3 positions[] = {{0, 0, 0}, {0, -1, 0}};
  const uint32_t pinned = 0;
  sbf_level *level = scene_points(&s, 0, positions, masses, 2);
  scene_springs(&s, level, &(sbf_uint2){{0, 1}}, &stiffness, 1);
  scene_pin(&s, level, -1, &pinned, 1);
  s.world_definition.has_gravity = s.model_options.has_gravity = true;
  s.world_definition.gravity = s.model_options.gravity = (sbf_vec3){0, (float)(-w * w * HEIGHT_M), 0};
  s.model_options.scheme = SBF_SCHEME_SYMPLECTIC;
  s.model_options.substeps = 1;
  scene_start(&s);
  uint32_t state = 5;
  for (uint32_t i = 0; i < frames; i++) {
    sbr_world_step(s.world, TICK_S * (1 + jitter * chance(&state)));
    double y = (double)scene_point(&s, 0, 1).y + 1 + HEIGHT_M;
    max = fmax(max, fabs(y) / HEIGHT_M);
  }
  scene_free(&s);
  return max;
}

/* With equal steps it neither gains nor loses energy. With unequal steps treated as equal it gains, more with
 * greater stiffness. With known step lengths it hardly gains. */
START_TEST(verlet_without_velocities_gains_where_steps_vary)
{
  ck_assert_double_lt(position_verlet(0.1, 0, 20000, false), 1.01);
  ck_assert_double_gt(position_verlet(0.1, 0.5, 20000, false), 100);
  ck_assert_double_gt(position_verlet(0.3, 0.5, 20000, false), 1e20);
  ck_assert_double_lt(position_verlet(0.1, 0.5, 20000, true), 1.2);
}
END_TEST

START_TEST(frames_of_any_length_gain_nothing)
{
  static const double turns[] = {0.1, 0.3, 1};
  for (int k = 0; k < 3; k++) {
    double even = in_frames(turns[k], 0, 20000), uneven = in_frames(turns[k], 0.5, 20000);
    ck_assert_double_lt(even, 1 + 0.2 * turns[k]); /* frames interpolate between two ticks */
    ck_assert_msg(uneven < even + 1e-3, "w h %g: %g, in even frames %g", turns[k], uneven, even);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("varying_steps");
  TCase *c = tcase_create("varying_steps");
  tcase_add_test(c, verlet_without_velocities_gains_where_steps_vary);
  tcase_add_test(c, frames_of_any_length_gain_nothing);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
