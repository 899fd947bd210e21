/* Stability of a scheme in one cell of a map: a mass on a spring, released, at one stiffness and under one
 * other condition. */
#ifndef CHART_STABILITY_H
#define CHART_STABILITY_H

#include "sbfmt/asset.h"

/* Parameters: control ticks of 1/60 s with one substep each, the spring along y. */
typedef struct chart_cell {
  sbf_scheme scheme;
  double turn;       /* w h: angular frequency times substep, rad, above 0 */
  double damping;    /* fraction of critical, 0 to below 1 */
  double jitter;     /* random variation of the frame length as a fraction of a tick; 0 to 1 */
  double slow_ticks; /* additional length of one frame after a quarter of a second */
  double stretch;    /* initial distance from equilibrium relative to its length of 1 m, above 0 */
  double mass_ratio, poisson_ratio; /* for cells of whole bodies (chart/hung_body.h); else 0 */
} chart_cell;

typedef enum chart_outcome {
  CHART_SOUND,
  CHART_BIASED, /* error of decay or frequency above CHART_BIAS of w */
  CHART_DEAD,   /* invalid numbers, a reset to its rest shape, or more than CHART_GAIN times its energy */
  CHART_REFUSED
} chart_outcome;

/* Limits of the verdict, and observation time. */
#define CHART_BIAS 0.05
#define CHART_GAIN 10.0
enum { CHART_CELL_TICKS = 600 };

extern const char *const chart_outcome_names[]; /* by chart_outcome: "sound" and so on */

typedef struct chart_verdict {
  chart_outcome outcome;
  double off;     /* |s' - s| / w, s the exact complex rate and s' the observed one; NAN: not observable */
  double reached; /* maximum distance from equilibrium relative to the initial one */
  char why[96];   /* reason if it is not sound */
} chart_verdict;

/* Fails only if memory runs out. */
sbf_status chart_cell_evaluate(const chart_cell *cell, chart_verdict *verdict, sbf_diagnostic *error);

/* Upper bound of w h for stability in closed form, or from the root of one (heun); INFINITY if
 * unconditionally stable, NAN if unknown (relaxation). */
double chart_stable_below(sbf_scheme scheme, double damping);

#endif
