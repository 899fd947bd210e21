/* Pareto front of points with a cost and an error: those that no other point beats in both. */
#ifndef CHART_FRONT_H
#define CHART_FRONT_H

#include <stdint.h>

typedef struct chart_point {
  double cost, error; /* NAN in either: not on the front */
} chart_point;

/* Writes the indices of points on the front, cheapest first, into `front` (count); returns their number.
 * The first of equal ones. */
uint32_t chart_front_of(const chart_point *points, uint32_t count, uint32_t *front);

#endif
