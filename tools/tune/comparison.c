#include "tune/comparison.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/fault.h"
#include "sbfmt/mechanics.h"

const chart_drive tune_harsher_drive = {.speed = 0.5,
    .curve_rad_s = 0.6f,
    .hop = 0.03,
    .hop_ticks = {44, 26},
    .turn_rad_s = 12,
    .turn_ticks = {20, 9}};

/* Larger errors, as a fraction of the character's size, count as failures. */
static const double LOST = 0.05;
/* Maximum error of a usable reference as a fraction of the size. */
static const double MAX_REFERENCE_ERROR = 0.005;
/* Maximum error of a lattice of half its elements: 1 % with the margin of a promise. */
static const double MAX_RESOLUTION_ERROR = 0.008;

double tune_size_of(const sbf_asset *asset) {
  sbf_asset_measures is;
  sbf_asset_measure(asset, &is);
  double x = (double)is.high.x - (double)is.low.x, y = (double)is.high.y - (double)is.low.y,
         z = (double)is.high.z - (double)is.low.z;
  return fmax(x, fmax(y, z));
}

typedef struct measurement {
  const tune_measure *measure;
  const char *motion;
  uint32_t ticks;
} measurement;

static void show(void *user, uint32_t substeps, uint32_t tick) {
  const measurement *f = user;
  f->measure->progress(f->measure->user, f->motion, substeps, (double)tick / f->ticks);
}

/* The reference's own error only counts if something is measured with it. */
static void add_own_error(tune_comparison *comparison, int number, tune_by by) {
  const chart_reference *stated = &comparison->stated[number];
  double rms = stated->errors[CHART_PATH], max = stated->errors[CHART_FARTHEST];
  /* At most one in k^2 exceeds k times the root mean square (Chebyshev). */
  const tune_distances own = {rms, fmin(10 * rms, max), max};
  double is = tune_distance_by(&own, by);
  if (!(is < MAX_REFERENCE_ERROR * comparison->size_m)) {
    snprintf(comparison->unmeasured[number], sizeof comparison->unmeasured[number],
        "the reference itself has an error of %.2g m%s, measured with half as many substeps", is,
        by == TUNE_BY_MAX ? " at the worst place" : "");
    return;
  }
  comparison->own = tune_distances_larger(&comparison->own, &own);
}

/* SBF_OK with `unmeasured` filled, if the reference is unusable. */
static sbf_status find_truth(tune_comparison *comparison, int number, const sbf_asset *reference,
    const tune_measure *measure, sbf_diagnostic *error) {
  measurement f = {measure, comparison->cases[number].name, comparison->cases[number].ticks};
  chart_scene scene = chart_scene_of(&comparison->cases[number], reference);
  if (measure->progress) scene.looked = show, scene.looked_user = &f;
  if (!comparison->rest) comparison->rest = chart_motion_begins(&scene);
  if (!comparison->rest) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a reference");
  chart_truth *truth = &comparison->truths[number];
  chart_reference *stated = &comparison->stated[number];
  sbf_status status = measure->once ? chart_truth_take_mesh(truth, &scene, stated, error)
                                    : chart_truth_find_mesh(truth, &comparison->cases[number], &scene,
                                          comparison->rest, stated, error);
  if (status == SBF_OK) add_own_error(comparison, number, measure->by);
  if (status == SBF_OK || error->code != SBF_CODE_BAD_CALL) return status;
  snprintf(comparison->unmeasured[number], sizeof comparison->unmeasured[number], "%.180s", error->message);
  comparison->broken[number] = true;
  return SBF_OK;
}

sbf_status tune_comparison_create(tune_comparison *comparison, const sbf_asset *reference,
    const tune_measure *measure, sbf_diagnostic *error) {
  *comparison = (tune_comparison){.size_m = tune_size_of(reference)};
  sbf_status status =
      chart_bundle_cases(reference, measure->drive, &comparison->bundle, comparison->cases, error);
  uint32_t measured = 0;
  for (int i = 0; status == SBF_OK && i < CHART_BUNDLE_CASES; i++) {
    status = find_truth(comparison, i, reference, measure, error);
    measured += !comparison->unmeasured[i][0];
  }
  if (status != SBF_OK || measured || measure->may_be_empty) return status;
  return fault_set(error, SBF_CODE_BAD_CALL,
      "there is no valid reference, not even its %s: %s; choose another lattice with --reference",
      comparison->cases[0].name, comparison->unmeasured[0]);
}

void tune_comparison_free(tune_comparison *comparison) {
  for (int i = 0; i < CHART_BUNDLE_CASES; i++) chart_truth_free(&comparison->truths[i]);
  free(comparison->rest);
  *comparison = (tune_comparison){.rest = NULL};
}

static void fail(tune_error *is, const char *motion, const char *why) {
  is->sound = false;
  snprintf(is->why, sizeof is->why, "%s: %.110s", motion, why);
}

/* Measures one more motion. */
static sbf_status check(const tune_comparison *comparison, int number, const sbf_asset *asset,
    const chart_setting *setting, bool far, tune_error *is, sbf_diagnostic *error) {
  const chart_case *motion_case = &comparison->cases[number];
  chart_scene scene = chart_scene_of(motion_case, asset);
  chart_motion motion;
  chart_track track = {.ticks = 0};
  tune_distances off = {0, 0, 0};
  sbf_diagnostic refusal;
  scene.stop_broken = true;
  sbf_status status = chart_motion_open(&motion, &scene, setting, &refusal);
  if (status != SBF_OK) {
    chart_motion_close(&motion);
    fail(is, motion_case->name, refusal.message);
    return SBF_OK;
  }
  bool good = chart_motion_sample(&motion, &track);
  chart_motion_close(&motion);
  if (good && !track.sound) fail(is, motion_case->name, track.why);
  /* Momentarily inverted elements are visible, and `run` reports them as invalid. */
  if (good && track.sound && track.turned_over) fail(is, motion_case->name, "elements turn inside out");
  for (uint32_t i = 0; good && track.sound && i < track.ticks; i++)
    is->min_volume = fmin(is->min_volume, track.volume[i]);
  is->max_strain = fmax(is->max_strain, track.max_strain);
  bool compares = good && is->sound && !comparison->unmeasured[number][0];
  if (compares) good = tune_distances_between(&track, &comparison->truths[number].track, &off);
  chart_track_free(&track);
  if (!good) return fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a motion");
  if (compares && !(off.max_m < (far ? INFINITY : LOST * comparison->size_m))) {
    fail(is, motion_case->name, "farther off than a twentieth of its size");
  } else if (compares) {
    if (!is->worst || off.max_m > is->off.max_m) is->worst = motion_case->name, is->worst_number = number;
    is->off = tune_distances_larger(&is->off, &off);
  }
  return SBF_OK;
}

sbf_status tune_comparison_measure(const tune_comparison *comparison, const sbf_asset *asset,
    const chart_setting *setting, const tune_bar *bar, tune_error *is, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  *is = (tune_error){.sound = true, .min_volume = 1};
  for (int i = 0; status == SBF_OK && is->sound && !is->beaten && i < CHART_BUNDLE_CASES; i++) {
    int number = ((bar ? bar->first : 0) + i) % CHART_BUNDLE_CASES;
    if (!comparison->broken[number])
      status = check(comparison, number, asset, setting, bar && bar->far, is, error);
    is->beaten = bar && is->sound && i + 1 < CHART_BUNDLE_CASES &&
                 !(tune_distance_by(&is->off, bar->by) < bar->error_m);
  }
  return status;
}

sbf_status tune_comparison_check_resolution(
    tune_comparison *comparison, const sbf_asset *coarser, sbf_diagnostic *error) {
  sbf_status status = SBF_OK;
  for (int i = 0; status == SBF_OK && i < CHART_BUNDLE_CASES; i++) {
    tune_error is = {.sound = true, .min_volume = 1};
    if (comparison->unmeasured[i][0]) continue;
    status = check(comparison, i, coarser, &(chart_setting){.level = 0}, true, &is, error);
    if (status != SBF_OK || (is.sound && is.off.p99_m <= MAX_RESOLUTION_ERROR * comparison->size_m)) continue;
    char *why = comparison->unmeasured[i];
    size_t size = sizeof comparison->unmeasured[i];
    if (is.sound)
      snprintf(why, size, "the reference and a lattice of half its elements differ by %.2g m", is.off.p99_m);
    else
      snprintf(why, size, "a lattice of half the reference's elements breaks");
  }
  return status;
}
