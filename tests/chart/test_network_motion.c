/* The double-precision reference against closed forms: a spring, all modes of a chain, a pendulum; and a
 * tetrahedron's forces against its energy. */
#include "chart/network_motion.h"

#include <math.h>
#include <stdlib.h>

#include "chart/oscillation.h"
#include "chart/subject.h"
#include "harness.h"

static const double tick_s = 1.0 / 60, pi = 3.14159265358979323846;

static void move(sbf_asset *asset, float gravity, uint32_t steps, uint32_t ticks, chart_track *track) {
  ck_assert_ptr_nonnull(asset);
  ck_assert(chart_network_move(asset, (sbf_vec3){0, -gravity, 0}, tick_s, steps, ticks, track));
  ck_assert(track->sound);
  sbf_asset_free(asset);
}

START_TEST(a_spring_swings_as_a_cosine)
{
  chart_track t;
  move(chart_mass_on_spring(2, 50), 0.5f, 32, 300, &t);
  for (uint32_t i = 0; i < t.ticks; i++) {
    double exact = -1.02 + 0.02 * cos(5 * (i + 1) * tick_s);
    ck_assert_double_eq_tol((double)t.positions[2 * i + 1].y, exact, 2e-7);
    ck_assert_double_eq_tol(t.energy_j[i], t.energy_j[0], 1e-9);
  }
  chart_track_free(&t);
}
END_TEST

/* Of n masses between held ends, let go under gravity: the mode j of angular frequency 2 sqrt(k / m)
 * sin(j pi / 2 (n + 1)) swings about where it rests. */
START_TEST(a_chain_swings_in_all_its_modes)
{
  enum { COUNT = 20 };
  const double mass = 0.05, stiffness = 56;
  chart_track t;
  move(chart_pinned_chain(COUNT, 0.1f, 0.05f, 56), 1, 64, 120, &t);
  for (uint32_t i = 0; i < t.ticks; i++)
    for (int k = 1; k <= COUNT; k++) {
      double off = 0, at = (i + 1) * tick_s;
      for (int j = 1; j <= COUNT; j++) {
        double w = 2 * sqrt(stiffness / mass) * sin(j * pi / (2 * (COUNT + 1))), weight = 0;
        for (int n = 1; n <= COUNT; n++) weight += sin(n * j * pi / (COUNT + 1));
        off += 2.0 / (COUNT + 1) * weight * sin(k * j * pi / (COUNT + 1)) * (1 - cos(w * at)) / (w * w);
      }
      ck_assert_double_eq_tol((double)t.positions[i * t.points + (uint32_t)k].y, -0.1 * k - off, 2e-6);
    }
  chart_track_free(&t);
}
END_TEST

/* T / T0 = 1 / agm(1, cos(a / 2)) from the angle a: 1.1803406 from 90 degrees. The spring gives way by a few
 * thousandths at most. */
START_TEST(a_pendulum_has_its_period)
{
  enum { TICKS = 480 };
  double x[TICKS];
  chart_track t;
  chart_swing swing;
  move(chart_level_pendulum(1, 1, 1e6f), 9.81f, 256, TICKS, &t);
  for (uint32_t i = 0; i < TICKS; i++) x[i] = (double)t.positions[2 * i + 1].x;
  ck_assert(chart_swing_of(x, TICKS, tick_s, 0, &swing));
  double exact = 2 * pi * sqrt(1 / 9.81) * 1.1803406;
  ck_assert_double_eq_tol(swing.period_s, exact, 1e-4 * exact);
  chart_track_free(&t);
}
END_TEST

/* One tetrahedron with three free corners, released under gravity: its energy is conserved. */
START_TEST(a_tetrahedron_conserves_energy)
{
  static const sbf_vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  sbf_asset *asset = chart_mass_on_spring(1, 1);
  sbf_level *level = (sbf_level *)(uintptr_t)asset->soft_bodies.at[0].levels.at;
  sbf_vec3 *points = sbf_asset_allocate(asset, 4, sizeof *points);
  sbf_uint4 *one = sbf_asset_allocate(asset, 1, sizeof *one);
  for (int i = 0; i < 4; i++) points[i] = corners[i];
  *one = (sbf_uint4){{0, 1, 2, 3}};
  level->positions = (sbf_vec3_list){points, 4};
  level->masses = (sbf_f32_list){NULL, 0};
  level->springs = (sbf_spring_set_list){NULL, 0};
  level->model = SBF_ELASTIC_MODEL_TETRAHEDRA;
  level->lattice.tetrahedra = (sbf_uint4_list){one, 1};
  chart_track t;
  move(asset, 9.81f, 64, 60, &t);
  double max = 0;
  for (uint32_t i = 0; i < t.ticks; i++) {
    ck_assert_double_eq_tol(t.energy_j[i], t.energy_j[0], 1e-6 * (1 + t.kinetic_j[i]));
    max = fmax(max, t.kinetic_j[i]);
  }
  ck_assert_double_gt(max, 0.1);
  chart_track_free(&t);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("network_motion");
  TCase *c = tcase_create("network_motion");
  tcase_add_test(c, a_spring_swings_as_a_cosine);
  tcase_add_test(c, a_chain_swings_in_all_its_modes);
  tcase_add_test(c, a_pendulum_has_its_period);
  tcase_add_test(c, a_tetrahedron_conserves_energy);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
