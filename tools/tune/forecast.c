#include "tune/forecast.h"

#include <math.h>
#include <stdio.h>

#include "base/fault.h"
#include "chart/rounds.h"

/* Drives: the one for tuning, and another. The reference runs with one and two times its required
 * substeps, and 4 times if it is refined. */
enum { DRIVES = 2, LOOKED_TICKS = 3, CHECKS = 3, REFINED_SAMPLES = 7 };
/* Expected fraction of trials that are sound to the end of a motion and not beaten there. */
static const double LAST = 0.15;

sbf_status tune_forecast_make(
    const tune_meshes *meshes, const tune_trials *planned, tune_forecast *forecast, sbf_diagnostic *error) {
  const chart_setting setting = {.scheme = SBF_SCHEME_SYMPLECTIC};
  chart_bundle bundle;
  chart_case cases[CHART_BUNDLE_CASES];
  chart_motion motion = {.begin = NULL};
  *forecast = (tune_forecast){0, 0};
  sbf_status status = chart_bundle_cases(meshes->reference.asset, NULL, &bundle, cases, error);
  if (status != SBF_OK) return status;
  chart_scene scene = chart_scene_of(&cases[0], meshes->reference.asset);
  double ticks = scene.ticks * (double)CHART_BUNDLE_CASES, tried = 0;
  scene.ticks = LOOKED_TICKS;
  status = chart_motion_open(&motion, &scene, &setting, error);
  if (status == SBF_OK) {
    chart_track track;
    chart_motion_run(&motion); /* the first use is slower */
    double begin = chart_now_s();
    if (chart_motion_sample(&motion, &track))
      chart_track_free(&track);
    else
      status = fault_set(error, SBF_CODE_OUT_OF_MEMORY, "memory ran out for a reference");
    double tick_s = (chart_now_s() - begin) / LOOKED_TICKS;
    double visit_s = tick_s / fmax(chart_visits_of(motion.model, meshes->reference.asset, &setting), 1);
    for (uint32_t i = 0; i < planned->count; i++)
      if (!planned->at[i].refused) tried += planned->at[i].element_visits;
    forecast->min_s = ticks * (DRIVES * CHECKS * tick_s + LAST * tried * visit_s);
    forecast->max_s = ticks * (DRIVES * REFINED_SAMPLES * tick_s + tried * visit_s);
  }
  chart_motion_close(&motion);
  return status;
}

void tune_forecast_say(const tune_forecast *forecast, char *text, size_t size) {
  bool minutes = forecast->max_s > 100;
  double unit = minutes ? 60 : 1, min = ceil(forecast->min_s / unit), max = ceil(forecast->max_s / unit);
  const char *name = minutes ? "minutes" : max > 1 ? "seconds" : "second";
  if (min < max)
    snprintf(text, size, "%.0f to %.0f %s", min, max, name);
  else
    snprintf(text, size, "%.0f %s", max, name);
}
