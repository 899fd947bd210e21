/* Whether a scheme holds one cell of a stability map of whole bodies: a chain of masses, or a bar of matter
 * held at one end, let go under a little weight, at one stiffness. What is looked at is its lowest mode. */
#ifndef CHART_HUNG_BODY_H
#define CHART_HUNG_BODY_H

#include "chart/stability.h"

typedef enum chart_elastic {
  CHART_OF_SPRINGS,    /* a chain of five masses, the first hung from the world */
  CHART_OF_TETRAHEDRA, /* a bar of 1 x 0.2 x 0.2 m in some thirty of them */
  CHART_OF_REGIONS     /* the same bar in regions that keep their shape */
} chart_elastic;
extern const char *const chart_elastic_names[]; /* "springs" and so on */

/* What all cells of a row share. */
typedef struct chart_hung_body {
  sbf_asset *asset;
  double highest_rad_s; /* its stiffest mode; of regions what the runtime takes for it, from above */
  double weight_m_s2;   /* under which it is let go: the lowest mode then swings by some millimetres */
  double swings_rad_s;  /* about its lowest mode */
  uint32_t points;      /* of its level */
  double *shape;        /* (3 points) kg: masses times the lowest mode; what x is measured by */
  double rate[2];       /* of the lowest mode, 1/s: real and imaginary part, as fine steps have it */
  double rests_at;      /* x where it hangs; twice that is as far as it swings */
  double farthest_m;    /* of any point, meanwhile */
} chart_hung_body;

enum { CHART_SHARED_DAMPING_PERCENT = 10 }; /* of critical, at the stiffest mode; in proportion below it */

/* `mass_ratio`: by so much the mass at its free end is greater than it would be; 1 and more. `poisson_ratio`
 * is of the bar's matter, 0 to below 0.5. */
sbf_status chart_hung_body_make(chart_elastic elastic, double mass_ratio, double poisson_ratio,
    chart_hung_body *body, sbf_diagnostic *error);
void chart_hung_body_free(chart_hung_body *body);

/* One substep a tick of `turn` / highest_rad_s. As chart_cell_evaluate, of the lowest mode; it is biased as
 * well where it hangs off its rest by more than CHART_BIAS of its sag. */
sbf_status chart_hung_body_evaluate(const chart_hung_body *body, sbf_scheme scheme, double turn,
    chart_verdict *verdict, sbf_diagnostic *error);

#endif
