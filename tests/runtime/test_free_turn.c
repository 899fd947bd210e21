#include "harness.h"
#include "math/quat_log.h"
#include "rigid/rigid_state.h"

static const sbri_rigid_body brick = {
    .inertia = {1, 2, 3}, .inverse_inertia = {1, 0.5f, 1.0f / 3}, .mass = 1, .inverse_mass = 1};

static float energy(sbf_quat q, sbf_vec3 spin) {
  return 0.5f * sbri_dot(spin, sbri_spin_velocity(&brick, q, spin));
}

/* About the middle axis, with a touch of another: it turns over, again and again, and neither gains nor
 * loses.
 */
START_TEST(the_middle_axis_turns_over)
{
  sbf_quat q = {0, 0, 0, 1};
  sbf_vec3 spin = sbri_spin_from(&brick, q, sbri_vec3(0.01f, 10, 0));
  float begin = energy(q, spin), last = 1, worst = 0;
  int flips = 0;
  for (int i = 0; i < 240 * 60; i++) {
    sbf_quat next;
    sbri_free_turn(&brick, q, spin, 1.0f / 240, &next);
    q = next;
    float up = sbri_rotate(q, sbri_vec3(0, 1, 0)).y, off = fabsf(energy(q, spin) / begin - 1);
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
  sbf_vec3 spin = {0, 0, 6};
  int ticks = 240, rounds = 0;
  float last = 0;
  for (int i = 0; i < 10 * ticks; i++) {
    sbf_quat next;
    sbri_free_turn(&top, q, spin, 1.0f / (float)ticks, &next);
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

int main(void) {
  Suite *suite = suite_create("free_turn");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, the_middle_axis_turns_over);
  tcase_add_test(tests, a_symmetric_body_precesses);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
