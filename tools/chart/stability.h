/* Whether a scheme holds one cell of a stability map: a mass on a spring, let go, at one stiffness and under
 * one more condition. */
#ifndef CHART_STABILITY_H
#define CHART_STABILITY_H

#include "sbfmt/asset.h"

/* What is stepped: control ticks of 1/60 s with one substep each, the spring along y. */
typedef struct chart_cell {
  sbf_scheme scheme;
  double turn;        /* w h: angular frequency times substep, rad, over 0 */
  double damping;     /* share of critical, 0 to below 1 */
  double jitter;      /* frames last a tick, give or take up to this share of one; 0 to 1 */
  double hitch_ticks; /* one frame after a quarter of a second lasts so many more */
  double stretch;     /* of its length of 1 m, over 0: how far from where it would rest it is let go */
  double mass_ratio, poisson_ratio; /* of cells of whole bodies (chart/hung_body.h); else 0 */
} chart_cell;

typedef enum chart_outcome {
  CHART_SOUND,
  CHART_BIASED, /* decay or frequency are off by more than CHART_BIAS of w */
  CHART_DEAD,   /* numbers that are none, put back into its shape, or more than CHART_GAIN times its energy */
  CHART_REFUSED
} chart_outcome;

/* Bounds of the verdict, and how long is looked at. */
#define CHART_BIAS 0.05
#define CHART_GAIN 10.0
enum { CHART_CELL_TICKS = 600 };

extern const char *const chart_outcome_names[]; /* by chart_outcome: "sound" and so on */

typedef struct chart_verdict {
  chart_outcome outcome;
  double
      off; /* |s' - s| / w, s the exact complex rate and s' that of the motion seen; NAN: none to be seen */
  double reached; /* the farthest it was from where it rests, over where it was let go */
  char why[96];   /* it is not sound */
} chart_verdict;

/* Failures are memory alone. */
sbf_status chart_cell_evaluate(const chart_cell *cell, chart_verdict *verdict, sbf_diagnostic *error);

/* The w h below which the scheme's steps do not grow, in closed form, or the root of one (heun); INFINITY
 * where they never do, NAN where nothing is known (relaxation). */
double chart_stable_below(sbf_scheme scheme, double damping);

#endif
