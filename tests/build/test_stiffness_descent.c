#include "build/levels/stiffness_descent.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "sbfmt/build.h"
#include "sbfmt/mechanics.h"
#include "shapes.h"

static sbf_asset *asset, *built;
static sbfi_arena arena;
static sbfi_level_statics statics;
static sbfi_linear_statics linear;
static double *gives[SBFI_MAX_LOADS];
static const sbfi_target_displacements wanted = {.displacements = (const double *const *)gives};
static const sbfi_factor_bounds bounds = {0.125, 16, 4, 1e-3, 25};

/* A cube on a bone as centroid springs, and where they are to have its surface. */
static void setup(void) {
  asset = sbf_asset_create(NULL);
  sbfi_arena_init(&arena, NULL, 0);
  sbf_polygon_mesh cube = shape_cube(asset, 3, 0.3f, (sbf_vec3){0, 0, 0});
  shape_add_body(asset, "cube", &cube, true);
  sbf_diagnostic error;
  const sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_CENTROID, .without_calibration = true};
  ck_assert_msg(sbf_build(asset, &options, &built, NULL, &error) == SBF_OK, "%s", error.message);
  const sbf_soft_body *body = &built->soft_bodies.at[0];
  ck_assert(sbfi_level_statics_make(&statics, body, &body->levels.at[0], NULL, &arena));
  ck_assert(sbfi_linear_statics_make(&linear, &statics.network, &arena));
  for (uint32_t l = 0; l < statics.load_count; l++) {
    double frequency;
    gives[l] = sbfi_arena_allocate(&arena, body->surface.positions.count, 3 * sizeof(double));
    ck_assert(sbfi_level_solve_linear(&statics, &linear, l, 1e-4, gives[l], &frequency, &arena));
  }
}
static void teardown(void) {
  sbfi_arena_free(&arena);
  sbf_asset_free(built);
  sbf_asset_free(asset);
}

static float *stated(void) {
  return sbfi_arena_copy(&arena, statics.stiffness, statics.network.spring_count, sizeof(float));
}

/* Every stiffness was changed by a factor of up to three. The displacements determine it, except where many
 * stiffnesses have the same effect. */
START_TEST(springs_are_recovered_from_their_response)
{
  double left, before;
  for (uint32_t i = 0; i < statics.network.spring_count; i++)
    statics.stiffness[i] *= (float)(1 + (double)(i * 7 % 5) / 2);
  sbfi_linear_statics_refresh(&linear);
  const float *from = stated();
  ck_assert(sbfi_stiffness_mismatch(&statics, &linear, &wanted, &before, &arena));
  ck_assert(
      sbfi_stiffness_descent(&statics, &linear, from, &wanted, &bounds, &left, (sbfi_progress){0}, &arena));
  ck_assert_double_gt(before, 0.4);
  ck_assert_double_lt(left, 0.02);
  double again;
  ck_assert(sbfi_stiffness_mismatch(&statics, &linear, &wanted, &again, &arena));
  ck_assert_double_eq_tol(again, left, 1e-3);
}
END_TEST

/* The target is a tenth of a tenth: no spring becomes stiffer than sixteen times, and no point has more than
 * four times the stiffness of the stiffest one before. */
START_TEST(bounds_are_respected)
{
  double left, max = 0;
  const float *from = stated();
  const sbf_spring_network *n = &statics.network;
  double *sums = sbfi_arena_allocate(&arena, n->point_count, 2 * sizeof *sums),
         *before = sums + n->point_count;
  for (uint32_t l = 0; l < statics.load_count; l++)
    for (uint32_t i = 0; i < 3 * statics.body->surface.positions.count; i++) gives[l][i] *= 0.01;
  ck_assert(
      sbfi_stiffness_descent(&statics, &linear, from, &wanted, &bounds, &left, (sbfi_progress){0}, &arena));
  ck_assert_double_gt(left, 1);
  memset(sums, 0, 2 * n->point_count * sizeof *sums);
  for (uint32_t i = 0; i < n->spring_count; i++) {
    ck_assert_float_le(statics.stiffness[i], 16.001f * from[i]);
    ck_assert_float_ge(statics.stiffness[i], 0.1249f * from[i]);
    for (int end = 0; end < 2; end++) {
      sums[n->ends[i].at[end]] += statics.stiffness[i];
      before[n->ends[i].at[end]] += from[i];
    }
  }
  for (uint32_t i = 0; i < n->point_count; i++)
    if (n->masses[i] > 0) max = fmax(max, before[i] / n->masses[i]);
  for (uint32_t i = 0; i < n->point_count; i++)
    if (n->masses[i] > 0) ck_assert_double_le(sums[i] / n->masses[i], 4.001 * max);
}
END_TEST

static bool stop(void *user, double done) {
  *(double *)user = done;
  return done < 0.5;
}

START_TEST(the_descent_can_be_cancelled)
{
  double left, reached = 0;
  ck_assert(!sbfi_stiffness_descent(
      &statics, &linear, stated(), &wanted, &bounds, &left, sbfi_progress_whole(stop, &reached), &arena));
  ck_assert_double_ge(reached, 0.5);
}
END_TEST

/* The whole: sections of our lizard against their own tetrahedra, as every build does it. */
START_TEST(sections_of_a_lizard_deform_as_their_material)
{
  sbf_build_report report;
  sbf_diagnostic error;
  sbf_asset *lizard = sbf_asset_create(NULL), *made;
  shape_sections_of_obj(lizard, harness_source("examples/lizard/lizard.obj"));
  const sbf_build_options options = {.interior = SBF_BUILD_INTERIOR_CENTROID};
  ck_assert(sbf_build(lizard, &options, &made, &report, &error) == SBF_OK);
  ck_assert_uint_eq(report.spring_calibration.count, lizard->soft_bodies.count);
  uint32_t near = 0;
  for (uint32_t i = 0; i < made->soft_bodies.count; i++) {
    const sbf_level *level = &made->soft_bodies.at[i].levels.at[0];
    ck_assert_ptr_nonnull(level->calibration);
    ck_assert_float_gt(level->simulation.error, 0);
    bool is_near = level->calibration->residual < 0.3f;
    near += is_near;
    /* All mass is at the surface, which moves most: they swing too slowly by that amount only. */
    ck_assert_float_gt(level->calibration->period_error, 0);
    ck_assert_float_lt(level->calibration->period_error, is_near ? 0.13f : 0.3f);
    ck_assert_float_lt(level->calibration->residual, 1.1f); /* hands, thin as they are */
  }
  ck_assert_uint_ge(4 * near, 3 * made->soft_bodies.count);
  sbf_asset_free(made);
  sbf_asset_free(lizard);
}
END_TEST

int main(void) {
  Suite *s = suite_create("stiffness_descent");
  TCase *c = tcase_create("stiffness_descent");
  tcase_add_checked_fixture(c, setup, teardown);
  tcase_add_test(c, springs_are_recovered_from_their_response);
  tcase_add_test(c, bounds_are_respected);
  tcase_add_test(c, the_descent_can_be_cancelled);
  tcase_add_test(c, sections_of_a_lizard_deform_as_their_material);
  suite_add_tcase(s, c);
  return harness_run(s);
}
