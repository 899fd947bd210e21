#include "harness.h"
#include "sbfmt/mechanics.h"

#include <math.h>

static double length_of(const sbf_vec3 *p, sbf_uint2 e) {
  double x = (double)p[e.at[1]].x - p[e.at[0]].x, y = (double)p[e.at[1]].y - p[e.at[0]].y,
         z = (double)p[e.at[1]].z - p[e.at[0]].z;
  return sqrt(x * x + y * y + z * z);
}

/* A cube lattice with all face and space diagonals: eight cells, 27 points. */
enum { POINTS = 27 };
static sbf_vec3 positions[POINTS];
static float volumes[POINTS];
static sbf_uint2 ends[POINTS * POINTS];
static float stiffness[POINTS * POINTS];
static double sums[2 * POINTS];
static uint32_t spring_count;

static void make_lattice(float cell) {
  spring_count = 0;
  for (uint32_t i = 0; i < POINTS; i++) {
    positions[i] = (sbf_vec3){(float)(i % 3) * cell, (float)(i / 3 % 3) * cell, (float)(i / 9) * cell};
    volumes[i] = 8 * cell * cell * cell / POINTS;
  }
  for (uint32_t a = 0; a < POINTS; a++)
    for (uint32_t b = a + 1; b < POINTS; b++)
      if (length_of(positions, (sbf_uint2){{a, b}}) < 1.8 * cell) ends[spring_count++] = (sbf_uint2){{a, b}};
}

START_TEST(energy_of_a_uniform_strain)
{
  make_lattice(0.1f);
  sbf_stiffness_of_network(
      SBF_STIFFNESS_VOLUME * 5e4, positions, POINTS, volumes, ends, spring_count, sums, stiffness);
  double moment = 0, dilation = 0, volume = 8e-3, e = 5e4;
  for (uint32_t s = 0; s < spring_count; s++) {
    double squared = length_of(positions, ends[s]) * length_of(positions, ends[s]);
    moment += stiffness[s] * squared;
    dilation += stiffness[s] * squared / 2; /* all strained by 1 */
  }
  ck_assert_double_eq_tol(moment / (6 * e * volume), 1, 1e-5);
  /* Matter of that modulus and Poisson's ratio 1/4 holds 9/2 of its bulk modulus, E / (3 (1 - 2/4)). */
  ck_assert_double_eq_tol(dilation / (volume * 4.5 * e / 1.5), 1, 1e-5);
}
END_TEST

START_TEST(half_the_size_half_the_stiffness)
{
  float large[POINTS * POINTS];
  make_lattice(0.2f);
  sbf_stiffness_of_network(1e5, positions, POINTS, volumes, ends, spring_count, sums, large);
  make_lattice(0.1f);
  sbf_stiffness_of_network(1e5, positions, POINTS, volumes, ends, spring_count, sums, stiffness);
  /* Forces from one stress go with the square of the size, displacements of one strain with the size. */
  for (uint32_t s = 0; s < spring_count; s++) ck_assert_float_eq_tol(large[s] / stiffness[s], 2, 1e-4f);
}
END_TEST

START_TEST(no_length_no_stiffness)
{
  const sbf_vec3 same[] = {{1, 2, 3}, {1, 2, 3}, {2, 2, 3}};
  const float fraction[] = {1, 1, 1};
  const sbf_uint2 two[] = {{{0, 1}}, {{1, 2}}};
  sbf_stiffness_of_network(1, same, 3, fraction, two, 2, sums, stiffness);
  ck_assert(stiffness[0] == 0);
  ck_assert_float_eq_tol(stiffness[1], 2, 1e-6f); /* both ends' whole volume, length 1 */
}
END_TEST

START_TEST(short_springs_count_as_longer)
{
  /* Lengths 1, 1 and 0.1 at one point: 0.1 is below half of the mean over both ends, (2.1 + 0.1) / 4. */
  const sbf_vec3 at[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.1f}};
  const float fraction[] = {2.1f, 0, 0, 0};
  const sbf_uint2 three[] = {{{0, 1}}, {{0, 2}}, {{0, 3}}};
  sbf_stiffness_of_network(1, at, 4, fraction, three, 3, sums, stiffness);
  ck_assert_float_eq_tol(stiffness[0], 1, 1e-5f);
  ck_assert_float_eq_tol(stiffness[2], 1 / 0.275f, 1e-4f);
}
END_TEST

START_TEST(anchors_reproduce_a_pyramid_of_springs)
{
  /* A point at (0, 0, 1) over the centre: one spring along the axis, four leaning by 60 degrees. */
  const float h = 0.8660254f;
  const sbf_vec3 at[] = {
      {0, 0, 1}, {0, 0, 0}, {h, 0, 0.5f}, {-h, 0, 0.5f}, {0, h, 0.5f}, {0, -h, 0.5f}, {3, 3, 3}};
  const sbf_uint2 springs[] = {{{1, 0}}, {{2, 0}}, {{0, 3}}, {{4, 0}}, {{5, 0}}, {{1, 2}}, {{0, 6}}};
  const uint8_t pinned[] = {0, 1, 1, 1, 1, 1, 0};
  const float fraction[] = {0.25f, 0, 0, 0, 0, 0, 1};
  const sbf_vec3 up[7] = {{0, 0, 1}};
  double scratch[63], along = 0, trace = 0, k = 1000 * 0.25 / (0.5 * 0.5); /* E V / d^2 */
  sbf_stiffness_of_anchors(1000, 0.5, up, at, 7, fraction, pinned, springs, 7, scratch, stiffness);
  for (int s = 0; s < 5; s++) {
    trace += stiffness[s];
    along += stiffness[s] * (s == 0 ? 1 : 0.25);
    ck_assert_float_gt(stiffness[s], 0);
  }
  ck_assert_double_eq_tol(trace, 2 * k, 1e-3 * k);
  ck_assert_double_eq_tol(along, 1.2 * k, 1e-3 * k);
  ck_assert(stiffness[5] == 0 && stiffness[6] == 0); /* both held, both free */
}
END_TEST

START_TEST(anchors_that_cannot_fit_keep_the_trace)
{
  /* Along the axis by three springs, across by two: 0.6 and 0.4 of the trace of 2 is what each should have,
   * with k = a + b c^2 that is a third of 1.2 and a half of 0.8. */
  const sbf_vec3 at[] = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0, 0, 0}};
  const sbf_uint2 springs[] = {{{3, 0}}, {{3, 0}}, {{3, 0}}, {{1, 0}}, {{2, 0}}};
  const uint8_t pinned[] = {0, 1, 1, 1};
  const float fraction[] = {1, 0, 0, 0};
  const sbf_vec3 up[4] = {{0, 0, 1}};
  double scratch[36];
  sbf_stiffness_of_anchors(1, 1, up, at, 4, fraction, pinned, springs, 5, scratch, stiffness);
  ck_assert_float_eq_tol(stiffness[0], 0.4f, 1e-5f);
  ck_assert_float_eq_tol(stiffness[3], 0.4f, 1e-5f);
  ck_assert_float_eq_tol(stiffness[4], 0.4f, 1e-5f);
  /* One along and two across, all across the axis asked for: the trace stays, evenly shared. */
  const sbf_vec3 none[4] = {{0, 0, 0}};
  sbf_stiffness_of_anchors(1, 1, none, at, 4, fraction, pinned, springs + 2, 3, scratch, stiffness);
  for (int s = 0; s < 3; s++) ck_assert_float_eq_tol(stiffness[s], 2 / 3.0f, 1e-5f);
}
END_TEST

START_TEST(no_direction_is_left_free)
{
  /* Three springs in a plane that leans out of it by a little: across it they are too soft. */
  const float h = 0.8660254f, z = 0.2f;
  const sbf_vec3 at[] = {{0, 0, 0}, {1, 0, -z}, {-0.5f, h, -z}, {-0.5f, -h, -z}},
                 flat[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const sbf_vec3 any[4] = {{0, 0, 0}};
  const sbf_uint2 springs[] = {{{1, 0}}, {{2, 0}}, {{3, 0}}};
  const uint8_t pinned[] = {0, 1, 1, 1};
  const float fraction[] = {1, 0, 0, 0};
  double scratch[36];
  sbf_stiffness_of_anchors(1, 1, any, at, 4, fraction, pinned, springs, 3, scratch, stiffness);
  /* Of a trace of 2, across the plane z^2 / (1 + z^2) = 0.0769: enough. */
  ck_assert_float_eq_tol(stiffness[0], 2 / 3.0f, 1e-5f);
  sbf_vec3 lower[4];
  for (int i = 0; i < 4; i++) lower[i] = (sbf_vec3){at[i].x, at[i].y, at[i].z / 2};
  /* 2 * 0.0099 falls short of 0.05. */
  sbf_stiffness_of_anchors(1, 1, any, lower, 4, fraction, pinned, springs, 3, scratch, stiffness);
  ck_assert_float_eq_tol(3 * stiffness[0] * 0.01f / 1.01f, 0.05f, 1e-4f);
  sbf_stiffness_of_anchors(1, 1, any, flat, 4, fraction, pinned, springs, 3, scratch, stiffness);
  ck_assert_float_eq_tol(stiffness[0], 2 / 3.0f, 1e-5f); /* nothing would help */
}
END_TEST

START_TEST(levels_provide_missing_values)
{
  make_lattice(1);
  const float one = 7, each[] = {1, 2, 3};
  sbf_spring_set sets[3];
  for (int s = 0; s < 3; s++) sbf_spring_set_init(&sets[s]);
  sets[0].ends = (sbf_uint2_list){ends, 2};
  sets[0].stiffness = (sbf_f32_list){&one, 1};
  sets[1].ends = (sbf_uint2_list){ends, spring_count};
  sets[2].ends = (sbf_uint2_list){ends, 3};
  sets[2].stiffness = (sbf_f32_list){each, 3};
  sbf_soft_body body;
  sbf_soft_body_init(&body);
  body.attributes.young_modulus = 5e4f;
  body.attributes.thickness = 0.001f;
  sbf_level level;
  sbf_level_init(&level);
  level.positions = (sbf_vec3_list){positions, POINTS};
  level.springs = (sbf_spring_set_list){sets, 3};
  /* A sheet over the lattice's front, 1 mm thick. */
  const uint32_t size = 4, corners[] = {0, 2, 8, 6};
  body.surface.positions = level.positions;
  body.surface.polygon_sizes = (sbf_u32_list){&size, 1};
  body.surface.polygon_points = (sbf_u32_list){corners, 4};
  float fractions[POINTS], all[POINTS * POINTS];
  sbf_level_stiffness(&body, &level, fractions, sums, all);
  ck_assert(all[0] == 7 && all[1] == 7);
  double moment = 0;
  for (uint32_t s = 0; s < spring_count; s++)
    moment += all[2 + s] * length_of(positions, ends[s]) * length_of(positions, ends[s]);
  ck_assert_double_eq_tol(moment / (3 * 5e4 * 4 * 0.001), 1, 1e-4);
  ck_assert(all[2 + spring_count] == 1 && all[4 + spring_count] == 3);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("spring_stiffness");
  TCase *c = tcase_create("spring_stiffness");
  tcase_add_test(c, energy_of_a_uniform_strain);
  tcase_add_test(c, half_the_size_half_the_stiffness);
  tcase_add_test(c, no_length_no_stiffness);
  tcase_add_test(c, short_springs_count_as_longer);
  tcase_add_test(c, anchors_reproduce_a_pyramid_of_springs);
  tcase_add_test(c, anchors_that_cannot_fit_keep_the_trace);
  tcase_add_test(c, no_direction_is_left_free);
  tcase_add_test(c, levels_provide_missing_values);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
