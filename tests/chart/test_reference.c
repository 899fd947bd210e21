/* A reference that is too coarse for its measurements is refined. */
#include "chart/reference.h"

#include <stdlib.h>
#include <string.h>

#include "harness.h"

/* The first body of a case, and its reference. */
typedef struct found {
  const chart_case *of;
  chart_subject subject;
  chart_scene scene;
  chart_truth truth;
  chart_reference stated;
  sbf_vec3 *rest;
  unsigned substeps; /* of the reference */
} found;

static const double tick_s = 1.0 / 60, converged = 0.001;
enum { MAX_SWEPT = 16, BEGINS = 128, MAX_SUBSTEPS = 1024 };

static void find(found *f, const chart_case *of, bool of_mesh) {
  sbf_diagnostic error;
  *f = (found){.of = of};
  ck_assert_int_eq(f->of->make(0, &f->subject, &error), SBF_OK);
  f->scene = chart_scene_of(f->of, f->subject.asset);
  f->rest = chart_motion_begins(&f->scene);
  sbf_status status =
      of_mesh ? chart_truth_find_mesh(&f->truth, f->of, &f->scene, f->rest, &f->stated, &error)
              : chart_truth_find(&f->truth, f->of, &f->scene, f->rest, MAX_SWEPT, &f->stated, &error);
  ck_assert_int_eq(status, SBF_OK);
  const char *reported = strstr(f->stated.what, " substeps a frame");
  ck_assert_ptr_nonnull(reported);
  while (reported > f->stated.what && reported[-1] != ' ') reported--;
  f->substeps = (unsigned)strtoul(reported, NULL, 10);
}

static void end(found *f) {
  chart_truth_free(&f->truth);
  free(f->rest);
  sbf_asset_free(f->subject.asset);
}

/* How far the reference is off itself, of how far things move. */
static double stated_share(const found *f) {
  return f->stated.errors[CHART_PATH] / chart_extent_of(&f->truth.track, f->rest);
}

/* Two runs of the same motion: the distance of the first from the second. */
static double separation(
    const found *f, const sbf_scheme schemes[2], const uint32_t substeps[2], double *errors) {
  chart_track tracks[2];
  sbf_diagnostic error;
  for (int i = 0; i < 2; i++) {
    chart_motion motion;
    const chart_setting setting = {.scheme = schemes[i], .substeps = substeps[i]};
    ck_assert_int_eq(chart_motion_open(&motion, &f->scene, &setting, &error), SBF_OK);
    ck_assert(chart_motion_sample(&motion, &tracks[i]));
    ck_assert(tracks[i].sound);
    chart_motion_close(&motion);
  }
  ck_assert(chart_errors_of(&tracks[0], &tracks[1], f->rest, tick_s, &f->of->signal, f->of->axes, errors));
  double fraction = errors[CHART_PATH] / chart_extent_of(&tracks[1], f->rest);
  chart_track_free(&tracks[0]), chart_track_free(&tracks[1]);
  return fraction;
}

static double apart_by(const found *f, uint32_t substeps) {
  double errors[CHART_AXIS_COUNT];
  return separation(f, (const sbf_scheme[]){SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_HEUN},
      (const uint32_t[]){substeps, substeps}, errors);
}

/* With as many substeps as it begins with, gas in a ball is not followed as near as that. */
START_TEST(substeps_increase_until_convergence)
{
  found f;
  find(&f, chart_case_named("pressure"), false);
  ck_assert_double_gt(apart_by(&f, BEGINS), converged);
  ck_assert_uint_gt(f.substeps, BEGINS);
  ck_assert_double_le(stated_share(&f), converged);
  ck_assert_double_gt(apart_by(&f, f.substeps / 2), converged); /* and no more than that */
  end(&f);
}
END_TEST

/* Each second pair begins with the run that the first one ended with: it is the one that it would be. */
START_TEST(a_mesh_is_measured_by_its_stated_pair)
{
  found f;
  double errors[CHART_AXIS_COUNT];
  find(&f, chart_case_named("pressure"), true);
  const sbf_scheme schemes[] = {SBF_SCHEME_SYMPLECTIC, SBF_SCHEME_SYMPLECTIC};
  ck_assert_double_gt(
      separation(&f, schemes, (const uint32_t[]){f.substeps / 4, f.substeps / 2}, errors), converged);
  ck_assert_double_le(stated_share(&f), converged);
  separation(&f, schemes, (const uint32_t[]){f.substeps / 2, f.substeps}, errors);
  for (int i = 0; i < CHART_AXIS_COUNT; i++)
    if (f.of->axes & 1u << i) ck_assert_double_eq(errors[i], f.stated.errors[i]);
  end(&f);
}
END_TEST

/* What hits the ground does so in another tick, by however many substeps. From where the case drops its ball
 * more substeps do come nearer, from higher up they do not. */
START_TEST(substeps_that_do_not_help_are_not_added)
{
  found f;
  chart_case higher = *chart_case_named("drop");
  higher.raise_m = 0.8f;
  find(&f, &higher, false);
  ck_assert_uint_lt(f.substeps, MAX_SUBSTEPS);
  ck_assert_double_gt(stated_share(&f), converged);
  ck_assert_double_ge(apart_by(&f, 2 * f.substeps), stated_share(&f));
  end(&f);
}
END_TEST

int main(void) {
  Suite *suite = suite_create("reference");
  TCase *c = tcase_create("reference");
  tcase_add_test(c, substeps_increase_until_convergence);
  tcase_add_test(c, a_mesh_is_measured_by_its_stated_pair);
  tcase_add_test(c, substeps_that_do_not_help_are_not_added);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
