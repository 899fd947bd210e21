#include "harness.h"
#include <string.h>

#include "math/quat_log.h"
#include "rigid/torque_free.h"

static const sbri_rigid_body brick = {
    .inertia = {1, 2, 3}, .inverse_inertia = {1, 0.5f, 1.0f / 3}, .mass = 1, .inverse_mass = 1};

static float energy(sbf_quat q, sbf_vec3 angular_velocity) {
  return 0.5f * sbri_dot(angular_velocity, sbri_angular_velocity_from_momentum(&brick, q, angular_velocity));
}

/* About the middle axis, with a touch of another: it turns over, again and again, and neither gains nor
 * loses.
 */
START_TEST(rotation_about_the_middle_axis_flips)
{
  sbf_quat q = {0, 0, 0, 1};
  sbf_vec3 angular_velocity = sbri_angular_momentum_from_velocity(&brick, q, sbri_vec3(0.01f, 10, 0));
  float begin = energy(q, angular_velocity), last = 1, worst = 0;
  int flips = 0;
  for (int i = 0; i < 240 * 60; i++) {
    sbf_quat next;
    sbri_torque_free_rotation(&brick, q, angular_velocity, 1.0f / 240, &next);
    q = next;
    float up = sbri_rotate(q, sbri_vec3(0, 1, 0)).y, off = fabsf(energy(q, angular_velocity) / begin - 1);
    flips += up * last < 0;
    last = up;
    worst = off > worst ? off : worst;
  }
  ck_assert_int_gt(flips, 20);
  ck_assert_float_le(worst, 1e-4f);
}
END_TEST

/* A top: its axis goes round the angular momentum at |p| / I. */
START_TEST(a_symmetric_body_precesses)
{
  sbri_rigid_body top = brick;
  top.inertia = sbri_vec3(2, 2, 1), top.inverse_inertia = sbri_vec3(0.5f, 0.5f, 1);
  sbf_quat q = sbri_quat_about(sbri_vec3(1, 0, 0), 0.5f);
  sbf_vec3 angular_velocity = {0, 0, 6};
  int ticks = 240, rounds = 0;
  float last = 0;
  for (int i = 0; i < 10 * ticks; i++) {
    sbf_quat next;
    sbri_torque_free_rotation(&top, q, angular_velocity, 1.0f / (float)ticks, &next);
    q = next;
    float x = sbri_rotate(q, sbri_vec3(0, 0, 1)).x;
    rounds += last < 0 && x >= 0;
    last = x;
  }
  ck_assert_int_eq(rounds, 4); /* 30 rad are 4.77 rounds */
  sbf_vec3 axis = sbri_rotate(q, sbri_vec3(0, 0, 1));
  ck_assert_float_eq_tol(axis.z, 0.87758256f, 1e-4f); /* cos 0.5 */
}
END_TEST

static float next_fraction(uint32_t *seed) {
  *seed = *seed * 1664525u + 1013904223u;
  return (float)(*seed >> 8) / 8388608.0f - 1;
}

/* By lanes, of bodies that turn slowly and fast side by side, bit for bit what each does alone. */
START_TEST(each_lane_rotates_as_alone)
{
  uint32_t seed = 7;
  for (int round = 0; round < 200; round++) {
    sbri_torque_free_lanes turning;
    sbri_rigid_body bodies[SBRI_LANES];
    sbf_quat turns[SBRI_LANES];
    sbf_vec3 spins[SBRI_LANES];
    for (int k = 0; k < SBRI_LANES; k++) {
      static const float fast[4] = {1e-4f, 0.03f, 1, 30};
      float max = fast[(round + k) % 4];
      sbf_vec3 at = {2 + next_fraction(&seed), 2 + next_fraction(&seed), 2 + next_fraction(&seed)};
      bodies[k] = (sbri_rigid_body){.inertia = at, .inverse_inertia = {1 / at.x, 1 / at.y, 1 / at.z}};
      turns[k] = sbri_quat_normalize(
          (sbf_quat){next_fraction(&seed), next_fraction(&seed), next_fraction(&seed), next_fraction(&seed)});
      spins[k] =
          sbri_vec3(max * next_fraction(&seed), max * next_fraction(&seed), max * next_fraction(&seed));
      sbri_torque_free_lanes_set(&turning, k, &bodies[k], turns[k], spins[k]);
    }
    sbri_torque_free_lanes_rotate(&turning, 1.0f / 120);
    for (int k = 0; k < SBRI_LANES; k++) {
      sbf_quat to, by_lanes = {turning.x[k], turning.y[k], turning.z[k], turning.w[k]};
      sbf_vec3 w = sbri_torque_free_rotation(&bodies[k], turns[k], spins[k], 1.0f / 120, &to),
               of_lane = sbri_vec3(turning.angular_momentum[0][k], turning.angular_momentum[1][k],
                   turning.angular_momentum[2][k]);
      ck_assert_mem_eq(&to, &by_lanes, sizeof to);
      ck_assert_mem_eq(&w, &of_lane, sizeof w);
    }
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("free_turn");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, each_lane_rotates_as_alone);
  tcase_add_test(tests, rotation_about_the_middle_axis_flips);
  tcase_add_test(tests, a_symmetric_body_precesses);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
