/* Statistics of repeated measurements. */
#ifndef CHART_SPREAD_H
#define CHART_SPREAD_H

#include <stdint.h>

typedef struct chart_spread {
  double min, low, median, high, max; /* low and high are the quartiles */
  uint32_t outliers; /* farther outside the quartiles than one and a half times the interquartile range
                        (Tukey's fences) */
} chart_spread;

/* At least one sample; sorts them. Quartiles are interpolated (R's type 7). */
chart_spread chart_spread_of(double *samples, uint32_t count);

#endif
