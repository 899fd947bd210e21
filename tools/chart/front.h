/* Of points with a cost and an error, those that nothing beats in both: the Pareto front. */
#ifndef CHART_FRONT_H
#define CHART_FRONT_H

#include <stdint.h>

typedef struct chart_point {
  double cost, error; /* either may be none (NAN): it is then not on the front */
} chart_point;

/* Numbers of the points on the front, the cheapest first, into `front` (count); returns how many. Of equal
 * ones the first. */
uint32_t chart_front_of(const chart_point *points, uint32_t count, uint32_t *front);

#endif
