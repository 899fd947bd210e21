/* Error of a setting of a character: distance of its skin in a walk, a hop and a shake. */
#ifndef TUNE_COMPARISON_H
#define TUNE_COMPARISON_H

#include "chart/bundle_case.h"
#include "chart/reference.h"
#include "tune/distances.h"

/* In a curve, half as high again, five times as fast, with a changing rhythm: harsher than players. */
extern const chart_drive tune_harsher_drive;

/* The motions of one drive, and the reference skin in each. */
typedef struct tune_comparison {
  chart_bundle bundle;
  chart_case cases[CHART_BUNDLE_CASES];
  chart_truth truths[CHART_BUNDLE_CASES];
  chart_reference stated[CHART_BUNDLE_CASES];
  char unmeasured[CHART_BUNDLE_CASES][192]; /* reason if a motion is not measured; empty: it is */
  bool broken[CHART_BUNDLE_CASES]; /* for those: the reference breaks; otherwise only breaks are reported */
  sbf_vec3 *rest;
  double size_m;      /* of the character: largest extent of its bounds */
  tune_distances own; /* maximum error of the reference by its steps */
} tune_comparison;

typedef struct tune_error {
  tune_distances off;            /* each maximum over all motions */
  double min_volume, max_strain; /* of any body in any tick; volume relative to rest */
  const char *worst;             /* the motion with the largest error */
  int worst_number;              /* index of that motion */
  bool sound;
  bool beaten;   /* stopped after a motion in which it was beaten; errors are up to then */
  char why[128]; /* reason if it is not sound */
} tune_error;

/* What to measure with it. */
typedef struct tune_measure {
  const chart_drive *drive; /* NULL: the usual one */
  tune_by by;               /* error measure */
  bool may_be_empty;        /* no failure if no motion is measured */
  bool once;                /* runs the reference once: `own` is unknown, and 0 */
  void (*progress)(void *user, const char *motion, uint32_t substeps,
      double fraction); /* may be NULL; for one run of the reference */
  void *user;
} tune_measure;

/* Largest extent of the bounds, m: the unit of relative errors. */
double tune_size_of(const sbf_asset *asset);

/* Excludes motions in which the reference itself breaks, or has an error above a two-hundredth of the
 * character's size; SBF_FAILED, SBF_CODE_BAD_CALL, if all are excluded. Must not be moved while in use;
 * free it with tune_comparison_free, also on failure. `reference` must outlive it. */
sbf_status tune_comparison_create(tune_comparison *comparison, const sbf_asset *reference,
    const tune_measure *measure, sbf_diagnostic *error);
void tune_comparison_free(tune_comparison *comparison);

/* Excludes motions in which the 99th percentile of the distance of a lattice with half the reference's
 * elements is more than 0.8 % of the size: there the reference cannot tell errors of a percent.
 * Fails only if memory runs out. */
sbf_status tune_comparison_check_resolution(
    tune_comparison *comparison, const sbf_asset *coarser, sbf_diagnostic *error);

/* When to stop a measurement. */
typedef struct tune_bar {
  double error_m; /* error above which it is beaten */
  tune_by by;
  int first; /* index of the first motion */
  bool far;  /* errors above a twentieth of the size are no failure */
} tune_bar;

/* Measures a character with the reference's skin. If the runtime does not support it, it is not sound;
 * fails only if memory runs out. `bar` NULL: runs all motions. */
sbf_status tune_comparison_measure(const tune_comparison *comparison, const sbf_asset *asset,
    const chart_setting *setting, const tune_bar *bar, tune_error *is, sbf_diagnostic *error);

#endif
