/* What a tuning promises of a level holds by drives that it was not tuned by: no harsher than its own harsher
 * one. */
#include "chart/rounds.h"
#include "harness.h"
#include "pudding_meshes.h"
#include "tune/trials.h"

/* Turning by 10 rad/s to and fro and hopping by 3 % of the height, to beats that the tuning does not use. */
static const chart_drive unseen[] = {
    {.speed = 0.2,
        .curve_rad_s = 0.3f,
        .hop = 0.03,
        .hop_ticks = {40, 40},
        .turn_rad_s = -10,
        .turn_ticks = {30, 30}},
    {.speed = 0.5,
        .curve_rad_s = 0.1f,
        .hop = 0.03,
        .hop_ticks = {20, 20},
        .turn_rad_s = 10,
        .turn_ticks = {10, 10}},
    {.speed = 0.4,
        .curve_rad_s = 0,
        .hop = 0.03,
        .hop_ticks = {50, 50},
        .turn_rad_s = 10,
        .turn_ticks = {12, 12}},
};

static tune_meshes meshes;
static tune_comparison comparison, other;
static tune_trials trials;

static void make_yard(tune_comparison *made, const chart_drive *drive) {
  sbf_diagnostic error;
  sbf_status status =
      tune_comparison_create(made, meshes.reference.asset, &(tune_measure){.drive = drive}, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
}

static void setup(void) {
  const tune_grid grid = {
      .sizes = {60, 250}, .size_count = 2, .reference = 1000, .coarse = true, .calibrated_alone = true};
  const tune_effort effort = {.own_scheme_alone = true, .rounds = 1};
  sbf_diagnostic error;
  make_pudding_meshes(&meshes, &grid);
  ck_assert_int_eq(tune_trials_plan(&meshes, &effort, &trials, &error), SBF_OK);
  make_yard(&comparison, NULL);
  make_yard(&other, &tune_harsher_drive);
  sbf_status status = tune_trials_run(&meshes, &comparison, &other, &effort, &trials, &error);
  ck_assert_msg(status == SBF_OK, "%s", error.message);
}
static void teardown(void) {
  tune_trials_free(&trials);
  tune_comparison_free(&comparison);
  tune_comparison_free(&other);
  tune_meshes_free(&meshes);
}

START_TEST(promised_errors_hold_for_other_drives)
{
  tune_comparison third;
  make_yard(&third, &unseen[_i]);
  ck_assert_uint_gt(trials.front_count, 0);
  for (uint32_t i = 0; i < trials.front_count; i++) {
    const tune_trial *trial = &trials.at[trials.front[i]];
    tune_error is;
    sbf_diagnostic error;
    ck_assert_int_eq(
        tune_comparison_measure(&third, meshes.at[trial->mesh].asset, &trial->setting, NULL, &is, &error),
        SBF_OK);
    ck_assert(is.sound);
    ck_assert_double_le(is.off.max_m, trial->promised.max_m);
    ck_assert_double_le(is.off.p99_m, trial->promised.p99_m);
    ck_assert_double_le(is.off.rms_m, trial->promised.rms_m);
  }
  tune_comparison_free(&third);
}
END_TEST

START_TEST(promised_errors_exceed_measured_ones_by_a_quarter)
{
  for (uint32_t i = 0; i < trials.front_count; i++) {
    const tune_trial *trial = &trials.at[trials.front[i]];
    const tune_distances *is = &trial->promised;
    ck_assert_double_ge(is->max_m, 1.25 * (trial->error.off.max_m + comparison.own.max_m) - 1e-12);
    ck_assert_double_ge(is->max_m, 1.25 * (trial->other.off.max_m + other.own.max_m) - 1e-12);
    ck_assert_double_ge(is->p99_m, 1.25 * (trial->other.off.p99_m + other.own.p99_m) - 1e-12);
    ck_assert_double_ge(is->rms_m, 1.25 * (trial->other.off.rms_m + other.own.rms_m) - 1e-12);
    if (i > 0) ck_assert_double_lt(is->max_m, trials.at[trials.front[i - 1]].promised.max_m);
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("promised");
  TCase *c = tcase_create("promised");
  tcase_add_unchecked_fixture(c, setup, teardown);
  tcase_add_test(c, promised_errors_exceed_measured_ones_by_a_quarter);
  tcase_add_loop_test(c, promised_errors_hold_for_other_drives, 0, sizeof unseen / sizeof *unseen);
  suite_add_tcase(suite, c);
  return harness_run(suite);
}
