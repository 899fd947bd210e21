#include "motion/quatd.h"

#include <math.h>

#include "harness.h"

static const double PI = 3.14159265358979323846;

START_TEST(halfway_between_two_rotations)
{
  double half = sqrt(0.5), to[4];
  static const double none[] = {0, 0, 0, 1};
  const double quarter[] = {half, 0, 0, half}, same[] = {-half, 0, 0, -half};
  sbfi_quatd_slerp(none, quarter, 0.5, to);
  ck_assert_double_eq_tol(to[0], sin(PI / 8), 1e-12);
  ck_assert_double_eq_tol(to[3], cos(PI / 8), 1e-12);
  sbfi_quatd_slerp(none, same, 0.5, to); /* the same rotation with the other sign: still the short way */
  ck_assert_double_eq_tol(fabs(to[3]), cos(PI / 8), 1e-12);
  sbfi_quatd_slerp(none, none, 0.3, to);
  ck_assert_double_eq_tol(to[3], 1, 1e-12);
}
END_TEST

/* Against what libm says, for turns of all sizes. */
START_TEST(the_arc_is_followed_at_constant_speed)
{
  static const double none[] = {0, 0, 0, 1};
  for (double turned = 0.01; turned < PI; turned += 0.13) {
    const double there[] = {0, sin(turned / 2), 0, cos(turned / 2)};
    for (double t = 0; t <= 1; t += 0.125) {
      double to[4];
      sbfi_quatd_slerp(none, there, t, to);
      ck_assert_double_eq_tol(to[1], sin(t * turned / 2), 1e-10);
      ck_assert_double_eq_tol(to[3], cos(t * turned / 2), 1e-10);
    }
  }
}
END_TEST

START_TEST(the_smallest_rotation_between_two_vectors)
{
  static const double from[3] = {0, 1, 0}, to[3] = {0.6, 0, 0.8}, back[3] = {0, -1, 0};
  double rotation[4], there[3];
  sbfi_quatd_between(from, to, rotation);
  sbfi_quatd_rotate(rotation, from, there);
  for (int k = 0; k < 3; k++) ck_assert_double_eq_tol(there[k], to[k], 1e-12);
  ck_assert_double_eq_tol(2 * acos(rotation[3]), PI / 2, 1e-12);
  sbfi_quatd_between(from, back, rotation);
  sbfi_quatd_rotate(rotation, from, there);
  ck_assert_double_eq_tol(there[1], -1, 1e-12);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("turn");
  TCase *tests = tcase_create("all");
  tcase_add_test(tests, halfway_between_two_rotations);
  tcase_add_test(tests, the_arc_is_followed_at_constant_speed);
  tcase_add_test(tests, the_smallest_rotation_between_two_vectors);
  suite_add_tcase(suite, tests);
  return harness_run(suite);
}
