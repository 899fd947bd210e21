#include "chart/spread.h"

#include <stdlib.h>

static int compare(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double at_fraction(const double *sorted, uint32_t count, double fraction) {
  double coordinate = fraction * (count - 1);
  uint32_t below = (uint32_t)coordinate;
  if (below + 1 >= count) return sorted[count - 1];
  return sorted[below] + (coordinate - below) * (sorted[below + 1] - sorted[below]);
}

chart_spread chart_spread_of(double *samples, uint32_t count) {
  qsort(samples, count, sizeof *samples, compare);
  chart_spread s = {.min = samples[0],
      .low = at_fraction(samples, count, 0.25),
      .median = at_fraction(samples, count, 0.5),
      .high = at_fraction(samples, count, 0.75),
      .max = samples[count - 1]};
  double fence = 1.5 * (s.high - s.low);
  for (uint32_t i = 0; i < count; i++)
    s.outliers += samples[i] < s.low - fence || samples[i] > s.high + fence;
  return s;
}
