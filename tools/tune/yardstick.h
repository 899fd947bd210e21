/* How far a way to step a character is off, by its skin as it walks, hops and shakes. */
#ifndef TUNE_YARDSTICK_H
#define TUNE_YARDSTICK_H

#include "chart/bundle_case.h"
#include "chart/reference.h"

/* The motions of one drive, and where fine lattices have the skin in each. */
typedef struct tune_yardstick {
  chart_bundle bundle;
  chart_case cases[CHART_BUNDLE_CASES];
  chart_truth truths[CHART_BUNDLE_CASES];
  chart_reference stated[CHART_BUNDLE_CASES];
  char unmeasured[CHART_BUNDLE_CASES][192]; /* why there is no reference for a motion; empty: there is */
  sbf_vec3 *rest;
  double size_m;        /* of the character */
  double rms_m, most_m; /* that the reference is off itself by its steps, at most */
} tune_yardstick;

typedef struct tune_error {
  double rms_m, most_m; /* over the vertices and ticks of the motion where each is greatest */
  const char *worst;    /* the motion in which one is off by most */
  bool sound;
  char why[128]; /* it is not */
} tune_error;

/* A motion in which the reference itself breaks is left out; SBF_FAILED where all are.
 * `progress` (may be NULL) is told the share that is done. Does not move while it is in use; free it with
 * tune_yardstick_free, also on failure. `reference` must stay. */
sbf_status tune_yardstick_make(tune_yardstick *yard, const sbf_asset *reference, const chart_drive *drive,
    void (*progress)(void *user, double share), void *user, sbf_diagnostic *error);
void tune_yardstick_free(tune_yardstick *yard);

/* A character with the reference's skin. What the runtime refuses is not sound; failures are memory. */
sbf_status tune_yardstick_hold(const tune_yardstick *yard, const sbf_asset *asset,
    const chart_setting *setting, tune_error *is, sbf_diagnostic *error);

#endif
