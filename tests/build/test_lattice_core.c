#include "build/lattice/lattice_core.h"

#include <math.h>

#include "harness.h"

enum { LENGTH = 60, ACROSS = 13, POINTS = LENGTH * ACROSS };

/* A tail lying flat: half as thick as 6 - x / 10 at x, to a tip at 60. */
static double half_at(double x) {
  return 6 - x / 10;
}

/* Along the whole tail, points deeper than half of its local thickness are about its inner half, and no
 * skin. */
START_TEST(a_tail_has_a_core_to_its_tip)
{
  static sbf_vec3 points[POINTS];
  static double depths2[POINTS];
  static float thickness[POINTS];
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, NULL, 0);
  for (int i = 0; i < POINTS; i++) {
    double x = i / ACROSS, y = (i % ACROSS - ACROSS / 2) * half_at(x) / 6;
    points[i] = (sbf_vec3){(float)x, (float)y, 0};
    depths2[i] = pow(fmax(half_at(x) - fabs(y), 0), 2);
  }
  ck_assert(sbfi_lattice_thickness(points, depths2, POINTS, 0.01, thickness, &scratch));
  for (int i = 0; i < POINTS; i++) {
    double x = i / ACROSS, half = half_at(x);
    ck_assert_double_ge(thickness[i], 0.85 * half);
    ck_assert_double_le(thickness[i], 1.3 * half + 0.05);
    bool core = sqrt(depths2[i]) >= 0.5 * (double)thickness[i];
    if (i % ACROSS == ACROSS / 2) ck_assert(core);
    if (i % ACROSS == 0) ck_assert(!core);
  }
  sbfi_arena_free(&scratch);
}
END_TEST

START_TEST(flat_bodies_have_no_thickness)
{
  const sbf_vec3 points[2] = {{0, 0, 0}, {1, 0, 0}};
  const double depths2[2] = {0, 1e-18};
  float thickness[2];
  sbfi_arena scratch;
  sbfi_arena_init(&scratch, NULL, 0);
  ck_assert(sbfi_lattice_thickness(points, depths2, 2, 1e-3, thickness, &scratch));
  ck_assert_float_eq(thickness[0], 0);
  ck_assert_float_eq(thickness[1], 0);
  sbfi_arena_free(&scratch);
}
END_TEST

int main(void) {
  Suite *s = suite_create("lattice_core");
  TCase *c = tcase_create("lattice_core");
  tcase_add_test(c, a_tail_has_a_core_to_its_tip);
  tcase_add_test(c, flat_bodies_have_no_thickness);
  suite_add_tcase(s, c);
  return harness_run(s);
}
