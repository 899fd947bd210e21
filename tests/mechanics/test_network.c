#include "harness.h"
#include "lattice_box.h"
#include "sbfmt/mechanics.h"

#include <math.h>
#include <stdlib.h>

/* A chain along x: point 0 held, then `COUNT` of mass m on springs k, unit spacing. */
enum { COUNT = 12 };
static sbf_vec3 positions[COUNT + 2];
static float masses[COUNT + 2], stiffness[COUNT + 1];
static sbf_uint2 ends[COUNT + 1];

static sbf_spring_network chain(float k, float m, bool held_at_both_ends) {
  for (uint32_t i = 0; i < COUNT + 2; i++) {
    positions[i] = (sbf_vec3){(float)i, 0, 0};
    masses[i] = i == 0 || i == COUNT + 1 ? 0 : m;
  }
  for (uint32_t s = 0; s <= COUNT; s++) {
    ends[s] = (sbf_uint2){{s, s + 1}};
    stiffness[s] = k;
  }
  uint32_t more = held_at_both_ends;
  return (sbf_spring_network){.point_count = COUNT + 1 + more,
      .spring_count = COUNT + more,
      .positions = positions,
      .masses = masses,
      .ends = ends,
      .stiffness = stiffness};
}

START_TEST(chain_under_its_own_weight)
{
  sbf_spring_network network = chain(100, 0.5f, false);
  double forces[3 * (COUNT + 1)] = {0}, moved[3 * (COUNT + 1)], scratch[10 * (COUNT + 1)];
  for (int i = 1; i <= COUNT; i++) forces[3 * i] = 0.5 * 9.81;
  double left = sbf_network_static(&network, forces, 1e-12, 100, moved, scratch);
  ck_assert_double_lt(left, 1e-10);
  ck_assert_double_eq_tol(moved[3 * COUNT], 0.5 * 9.81 / 100 * COUNT * (COUNT + 1) / 2, 1e-9);
  ck_assert_double_eq_tol(moved[3], 0.5 * 9.81 / 100 * COUNT, 1e-9);
  ck_assert(moved[0] == 0);
}
END_TEST

START_TEST(bodies_without_pins_are_reported)
{
  sbf_spring_network network = chain(100, 0.5f, false);
  double forces[3 * (COUNT + 1)] = {0}, moved[3 * (COUNT + 1)], scratch[10 * (COUNT + 1)];
  forces[3 * 4 + 1] = 1; /* across the chain */
  ck_assert_double_gt(sbf_network_static(&network, forces, 1e-9, 100, moved, scratch), 0.5);
}
END_TEST

START_TEST(anchors_resist_all_directions)
{
  float anchors[COUNT + 2] = {0};
  sbf_spring_network network = chain(100, 0.5f, false);
  network.anchors = anchors;
  for (int i = 0; i <= COUNT; i++) anchors[i] = 20;
  double forces[3 * (COUNT + 1)] = {0}, moved[3 * (COUNT + 1)], scratch[10 * (COUNT + 1)];
  forces[3 * 4 + 1] = 1;
  ck_assert_double_lt(sbf_network_static(&network, forces, 1e-12, 100, moved, scratch), 1e-10);
  ck_assert_double_eq_tol(moved[3 * 4 + 1], 0.05, 1e-12);
}
END_TEST

START_TEST(highest_mode_of_a_chain)
{
  sbf_spring_network network = chain(80, 0.2f, true);
  double scratch[6 * (COUNT + 2)], w = 2 * sqrt(80 / 0.2);
  double exact = w * sin(COUNT * acos(-1) / (2 * (COUNT + 1)));
  double bound = sbf_network_highest_bound(&network, scratch),
         found = sbf_network_highest(&network, 400, scratch);
  ck_assert_double_eq_tol(found, exact, 1e-3 * exact);
  ck_assert_double_ge(bound, exact);
  ck_assert_double_le(bound, w * 1.0001);
  double rough = sbf_network_highest(&network, 20, scratch);
  ck_assert_double_le(rough, exact * (1 + 1e-9));
  ck_assert_double_ge(rough, 0.9 * exact);
}
END_TEST

START_TEST(the_bound_counts_pinned_neighbours_once)
{
  sbf_spring_network network = chain(80, 0.2f, true);
  for (uint32_t i = 0; i < COUNT; i++) masses[i] = 0; /* the last one alone, between two walls */
  double scratch[6 * (COUNT + 2)], exact = sqrt(2 * 80 / 0.2);
  ck_assert_double_eq_tol(sbf_network_highest_bound(&network, scratch), exact, 1e-4);
  ck_assert_double_eq_tol(sbf_network_highest(&network, 5, scratch), exact, 1e-4);
}
END_TEST

START_TEST(lowest_mode_of_one_mass)
{
  sbf_spring_network network = chain(80, 0.2f, false);
  network.point_count = 2, network.spring_count = 1;
  double scratch[16 * 2];
  ck_assert_double_eq_tol(sbf_network_lowest(&network, true, scratch), 20, 1e-4);
}
END_TEST

START_TEST(lowest_mode_of_a_chain)
{
  double scratch[16 * (COUNT + 2)], w = 2 * sqrt(80 / 0.2), pi = acos(-1);
  sbf_spring_network network = chain(80, 0.2f, false);
  double exact = w * sin(pi / (2 * (2 * COUNT + 1)));
  ck_assert_double_eq_tol(sbf_network_lowest(&network, true, scratch), exact, 2e-3 * exact);
  double rough = sbf_network_lowest(&network, false, scratch);
  ck_assert_double_ge(rough, exact);
  ck_assert_double_le(rough, 1.2 * exact);
  network = chain(80, 0.2f, true);
  exact = w * sin(pi / (2 * (COUNT + 1)));
  ck_assert_double_eq_tol(sbf_network_lowest(&network, true, scratch), exact, 2e-3 * exact);
}
END_TEST

START_TEST(lowest_mode_of_a_free_body)
{
  /* Two masses and a spring: they swing against each other, they do not fly off. */
  const sbf_vec3 at[] = {{3, 4, 5}, {3, 4, 5.5f}};
  const float m[] = {0.2f, 0.2f}, k = 40;
  const sbf_uint2 spring = {{0, 1}};
  sbf_spring_network network = {
      .point_count = 2, .spring_count = 1, .positions = at, .masses = m, .ends = &spring, .stiffness = &k};
  double scratch[32];
  ck_assert_double_eq_tol(sbf_network_lowest(&network, true, scratch), sqrt(2 * 40 / 0.2), 1e-3);
}
END_TEST

START_TEST(a_loose_point_does_not_spoil_it)
{
  /* Four points braced by walls in x, y and z; a fifth dangles on one spring, free to swing across. */
  enum { BRACED = 4 };
  sbf_vec3 at[5 + 3 * BRACED];
  float m[5 + 3 * BRACED] = {0}, k[1 + 3 * BRACED];
  sbf_uint2 springs[1 + 3 * BRACED];
  for (uint32_t i = 0; i < BRACED; i++) {
    at[i] = (sbf_vec3){(float)(i % 2), (float)(i / 2), (float)(i == 3)};
    m[i] = 0.1f;
    for (uint32_t axis = 0; axis < 3; axis++) {
      uint32_t wall = 5 + 3 * i + axis;
      at[wall] = at[i];
      *(axis == 0 ? &at[wall].x : axis == 1 ? &at[wall].y : &at[wall].z) += 1;
      springs[3 * i + axis] = (sbf_uint2){{i, wall}};
      k[3 * i + axis] = 90;
    }
  }
  at[4] = (sbf_vec3){-1, 0, 0};
  m[4] = 0.1f;
  springs[3 * BRACED] = (sbf_uint2){{0, 4}};
  k[3 * BRACED] = 90;
  sbf_spring_network network = {.point_count = 5 + 3 * BRACED,
      .spring_count = 1 + 3 * BRACED,
      .positions = at,
      .masses = m,
      .ends = springs,
      .stiffness = k};
  double scratch[16 * (5 + 3 * BRACED)], lowest = sbf_network_lowest(&network, true, scratch);
  ck_assert_double_ge(lowest, 5);
  ck_assert_double_le(lowest, 31);
}
END_TEST

START_TEST(pinned_chains_have_no_modes)
{
  sbf_spring_network network = chain(80, 0, true);
  double scratch[16 * (COUNT + 2)];
  ck_assert(sbf_network_highest_bound(&network, scratch) == 0);
  ck_assert(sbf_network_highest(&network, 10, scratch) == 0);
  ck_assert(sbf_network_lowest(&network, true, scratch) == 0);
}
END_TEST

/* A beam of tetrahedra, held at one end: the first bending mode is b^2 sqrt(E I / (rho A L^4)), b = 1.875104,
 * which linear tetrahedra miss by being too stiff and the free end's turning by being soft in shear. */
START_TEST(modes_of_a_beam_of_tetrahedra)
{
  double pi = acos(-1), squares[2];
  for (uint32_t n = 0; n < 2; n++) {
    uint32_t across = 2 << n;
    lattice_box box = lattice_box_make(
        (sbf_vec3){1, 2, 3}, (sbf_vec3){2, 0.2f, 0.2f}, 5 * across, across, across, 1000, 1e6f, 0.3f);
    sbf_spring_network network = lattice_box_network(&box);
    double *scratch = calloc(16 * (size_t)box.point_count, sizeof *scratch);
    ck_assert_ptr_nonnull(scratch);
    double bound = sbf_network_highest_bound(&network, scratch);
    double highest = sbf_network_highest(&network, 200, scratch);
    ck_assert_double_ge(bound, highest);
    ck_assert_double_le(bound, 2 * highest);
    /* 2 / w is about 0.73 cell / c for this lattice, c the speed of sound. */
    double c = sqrt(1e6 / 1000 * 0.7 / (1.3 * 0.4)), cell = 0.2 / across;
    ck_assert_double_eq_tol(2 / highest * c / cell, 0.75, 0.05);
    /* Free, it swings as a free beam does: rigid motion is left out. */
    double lowest = sbf_network_lowest(&network, true, scratch);
    ck_assert_double_gt(lowest, 4.73 * 4.73 * sqrt(1e6 * 0.04 / 12 / 1000 / 16));
    lattice_box_hold(&box);
    lowest = sbf_network_lowest(&network, true, scratch);
    squares[n] = lowest * lowest;
    free(scratch);
    lattice_box_free(&box);
  }
  double exact = 1.875104069 * 1.875104069 * sqrt(1e6 * 0.04 / 12 / 1000 / 16) / (2 * pi);
  double found = sqrt(squares[1] - (squares[0] - squares[1]) / 3) / (2 * pi);
  ck_assert_double_gt(sqrt(squares[1]), 2 * pi * exact);
  ck_assert_double_eq_tol(found, exact, 0.03 * exact);
}
END_TEST

START_TEST(statics_of_tetrahedra)
{
  /* Hung up, nu = 0: strained by rho g L / (2 E) on average, to first order exactly. */
  lattice_box box = lattice_box_make((sbf_vec3){0, 0, 0}, (sbf_vec3){1, 0.2f, 0.2f}, 8, 1, 1, 10, 1e6f, 0);
  lattice_box_hold(&box);
  sbf_spring_network network = lattice_box_network(&box);
  double *work = calloc(16 * (size_t)box.point_count, sizeof *work);
  ck_assert_ptr_nonnull(work);
  double *forces = work, *moved = work + 3 * box.point_count, *scratch = moved + 3 * box.point_count;
  for (uint32_t i = 0; i < box.point_count; i++) forces[3 * i] = 9.81 * box.masses[i];
  ck_assert_double_lt(sbf_network_static(&network, forces, 1e-10, 2000, moved, scratch), 1e-8);
  double exact = 10 * 9.81 / 2e6;
  ck_assert_double_eq_tol(moved[3 * 8], exact, 0.01 * exact);
  free(work);
  lattice_box_free(&box);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("network");
  TCase *c = tcase_create("network");
  tcase_add_test(c, chain_under_its_own_weight);
  tcase_add_test(c, bodies_without_pins_are_reported);
  tcase_add_test(c, anchors_resist_all_directions);
  tcase_add_test(c, highest_mode_of_a_chain);
  tcase_add_test(c, the_bound_counts_pinned_neighbours_once);
  tcase_add_test(c, lowest_mode_of_one_mass);
  tcase_add_test(c, lowest_mode_of_a_chain);
  tcase_add_test(c, lowest_mode_of_a_free_body);
  tcase_add_test(c, a_loose_point_does_not_spoil_it);
  tcase_add_test(c, pinned_chains_have_no_modes);
  tcase_add_test(c, modes_of_a_beam_of_tetrahedra);
  tcase_add_test(c, statics_of_tetrahedra);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
