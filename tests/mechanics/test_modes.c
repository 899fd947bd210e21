#include <math.h>

#include "harness.h"
#include "mechanics/modes.h"

enum { LINKS = 24 };
static const double pi = 3.14159265358979323846;

/* A straight chain along x, held at both ends: w_j = 2 sqrt(k/m) sin(j pi / (2 (n + 1))). */
static sbfi_modes of_chain(float stiffness, float mass, bool held) {
  static float positions[LINKS][3], inverse_masses[LINKS];
  static sbfi_spring springs[LINKS - 1];
  for (uint32_t i = 0; i < LINKS; i++) {
    positions[i][0] = (float)i;
    inverse_masses[i] = held && (i == 0 || i == LINKS - 1) ? 0 : 1 / mass;
    if (i + 1 < LINKS) springs[i] = (sbfi_spring){i, i + 1, stiffness, 1, 0};
  }
  sbfi_modes modes;
  ck_assert(sbfi_modes_find(
      &(sbfi_modes_input){LINKS, positions[0], 3, inverse_masses, springs, LINKS - 1}, &modes, NULL));
  return modes;
}

START_TEST(a_chain_held_at_both_ends)
{
  sbfi_modes modes = of_chain(250, 0.4f, true);
  double unit = 2 * sqrt(250 / 0.4), n = LINKS - 2;
  ck_assert_double_eq_tol(modes.slowest_rad_s, unit * sin(pi / (2 * (n + 1))), 1e-4 * unit);
  ck_assert_double_eq_tol(modes.fastest_rad_s, unit * sin(n * pi / (2 * (n + 1))), 1e-4 * unit);
  ck_assert_double_eq_tol(modes.bound_rad_s, unit, 1e-4 * unit);
}
END_TEST

START_TEST(rigid_motions_are_no_modes)
{
  sbfi_modes modes = of_chain(250, 0.4f, false);
  double unit = 2 * sqrt(250 / 0.4);
  ck_assert_double_eq_tol(modes.slowest_rad_s, unit * sin(pi / (2 * LINKS)), 1e-4 * unit);
}
END_TEST

START_TEST(a_goal_spring_resists_every_way)
{
  const float positions[] = {1, 2, 3, 1, 2, 3}, inverse_masses[] = {2, 0};
  const sbfi_spring spring = {0, 1, 50, 0, 0};
  sbfi_modes modes;
  ck_assert(sbfi_modes_find(&(sbfi_modes_input){2, positions, 3, inverse_masses, &spring, 1}, &modes, NULL));
  ck_assert_double_eq_tol(modes.slowest_rad_s, 10, 1e-6);
  ck_assert_double_eq_tol(modes.fastest_rad_s, 10, 1e-6);
}
END_TEST

START_TEST(nothing_to_find)
{
  sbfi_modes modes;
  const float positions[] = {0, 0, 0}, inverse_masses[] = {1};
  ck_assert(sbfi_modes_find(&(sbfi_modes_input){1, positions, 3, inverse_masses, NULL, 0}, &modes, NULL));
  ck_assert_double_eq(modes.slowest_rad_s, 0);
  ck_assert_double_eq(modes.fastest_rad_s, 0);
  ck_assert(sbfi_modes_find(&(sbfi_modes_input){0}, &modes, NULL));
}
END_TEST

START_TEST(every_allocation_may_fail)
{
  const float positions[] = {0, 0, 0, 1, 0, 0}, inverse_masses[] = {1, 0};
  const sbfi_spring spring = {0, 1, 50, 1, 0};
  for (size_t allowed = 0;; allowed++) {
    harness_memory memory;
    harness_memory_init(&memory, allowed);
    sbfi_modes modes;
    bool good = sbfi_modes_find(
        &(sbfi_modes_input){2, positions, 3, inverse_masses, &spring, 1}, &modes, &memory.allocator);
    ck_assert_uint_eq(memory.held_bytes, 0);
    if (good) break;
    ck_assert_uint_lt(allowed, 100);
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("modes");
  TCase *c = tcase_create("modes");
  tcase_add_test(c, a_chain_held_at_both_ends);
  tcase_add_test(c, rigid_motions_are_no_modes);
  tcase_add_test(c, a_goal_spring_resists_every_way);
  tcase_add_test(c, nothing_to_find);
  tcase_add_test(c, every_allocation_may_fail);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
