/* How far a way to step a character is off, by its skin as it walks, hops and shakes. */
#ifndef TUNE_YARDSTICK_H
#define TUNE_YARDSTICK_H

#include "chart/bundle_case.h"
#include "chart/reference.h"
#include "tune/distances.h"

/* In a curve, half as high again, five times as fast, and to a changing beat: harsher than players are. */
extern const chart_drive tune_harsher_drive;

/* The motions of one drive, and where fine lattices have the skin in each. */
typedef struct tune_yardstick {
  chart_bundle bundle;
  chart_case cases[CHART_BUNDLE_CASES];
  chart_truth truths[CHART_BUNDLE_CASES];
  chart_reference stated[CHART_BUNDLE_CASES];
  char unmeasured[CHART_BUNDLE_CASES][192]; /* why nothing is measured by a motion; empty: it is */
  bool broken[CHART_BUNDLE_CASES];          /* of those: the reference breaks; else what breaks is told */
  sbf_vec3 *rest;
  double size_m;      /* of the character: the largest extent of its bounds */
  tune_distances own; /* that the reference is off itself by its steps, at most */
} tune_yardstick;

typedef struct tune_error {
  tune_distances off;            /* each in the motion where it is greatest */
  double min_volume, max_strain; /* of any body in any tick; the volume against rest */
  const char *worst;             /* the motion in which one is off by most */
  int worst_number;              /* of it */
  bool sound;
  bool beaten;   /* no motion was tried after that in which it was; errors are those until then */
  char why[128]; /* it is not sound */
} tune_error;

/* What is to be measured by it. */
typedef struct tune_measure {
  const chart_drive *drive; /* NULL: the usual one */
  tune_by by;               /* what an error is */
  bool may_be_empty;        /* no failure where nothing is measured by any motion */
  bool once;                /* the reference runs once: `own` is not measured, and 0 */
  void (*progress)(
      void *user, const char *motion, uint32_t substeps, double fraction); /* may be NULL: of one look
                                                                           at the reference */
  void *user;
} tune_measure;

/* The largest extent of the bounds, m: what shares of the size are of. */
double tune_size_of(const sbf_asset *asset);

/* Nothing is measured by a motion in which the reference itself breaks, or is off itself by so much that it
 * tells nothing: a two-hundredth of the character's size; SBF_FAILED, SBF_CODE_BAD_CALL, where that is so in
 * all. Does not move
 * while it is in use; free it with tune_yardstick_free, also on failure. `reference` must stay. */
sbf_status tune_yardstick_make(
    tune_yardstick *yard, const sbf_asset *reference, const tune_measure *measure, sbf_diagnostic *error);
void tune_yardstick_free(tune_yardstick *yard);

/* When to stop looking at a character. */
typedef struct tune_bar {
  double error_m; /* farther off it is beaten */
  tune_by by;
  int first; /* the motion to begin with */
  bool far;  /* what is farther off than a twentieth of its size is no failure */
} tune_bar;

/* A character with the reference's skin. What the runtime refuses is not sound; failures are memory. `bar`
 * NULL: it is looked at through all motions. */
sbf_status tune_yardstick_hold(const tune_yardstick *yard, const sbf_asset *asset,
    const chart_setting *setting, const tune_bar *bar, tune_error *is, sbf_diagnostic *error);

#endif
