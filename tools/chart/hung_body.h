/* Stability of a scheme in one cell of a map of whole bodies: a chain of masses, or a solid bar fixed at
 * one end, released under a small weight, at one stiffness. Observes its lowest mode. */
#ifndef CHART_HUNG_BODY_H
#define CHART_HUNG_BODY_H

#include "chart/stability.h"

typedef enum chart_elastic {
  CHART_OF_SPRINGS,    /* a chain of five masses, the first hung from the world */
  CHART_OF_TETRAHEDRA, /* a bar of 1 x 0.2 x 0.2 m with some thirty tetrahedra */
  CHART_OF_REGIONS     /* the same bar with shape matching regions */
} chart_elastic;
extern const char *const chart_elastic_names[]; /* "springs" and so on */

/* Shared by all cells of a row. */
typedef struct chart_hung_body {
  sbf_asset *asset;
  double highest_rad_s; /* its stiffest mode; for regions the runtime's upper bound */
  double weight_m_s2;   /* of its release: the lowest mode then oscillates by some millimetres */
  double swings_rad_s;  /* approximate frequency of its lowest mode */
  uint32_t points;      /* of its level */
  double *shape;        /* (3 points) kg: masses times the lowest mode; projects displacements to x */
  double rate[2];       /* of the lowest mode, 1/s: real and imaginary part, from fine steps */
  double rests_at;      /* x at equilibrium; the amplitude ends at twice that */
  double farthest_m;    /* maximum displacement of a point in that motion */
} chart_hung_body;

enum {
  CHART_SHARED_DAMPING_PERCENT = 10
}; /* of critical, at the stiffest mode; proportionally less below it */

/* `mass_ratio`: factor on the mass at its free end, at least 1. `poisson_ratio` is of the bar's material,
 * 0 to below 0.5. */
sbf_status chart_hung_body_make(chart_elastic elastic, double mass_ratio, double poisson_ratio,
    chart_hung_body *body, sbf_diagnostic *error);
void chart_hung_body_free(chart_hung_body *body);

/* One substep per tick of `turn` / highest_rad_s. Like chart_cell_evaluate, for the lowest mode; it is
 * also biased if its equilibrium is off by more than CHART_BIAS of its sag. */
sbf_status chart_hung_body_evaluate(const chart_hung_body *body, sbf_scheme scheme, double turn,
    chart_verdict *verdict, sbf_diagnostic *error);

#endif
