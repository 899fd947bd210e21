/* What many measurements of one thing say together. */
#ifndef CHART_SPREAD_H
#define CHART_SPREAD_H

#include <stdint.h>

typedef struct chart_spread {
  double min, low, median, high, max; /* low and high are the quartiles */
  uint32_t outliers; /* farther outside of the quartiles than one and a half times what is between them
                        (Tukey's fences) */
} chart_spread;

/* Of at least one sample; sorts them. Quartiles lie between samples in proportion (R's type 7). */
chart_spread chart_spread_of(double *samples, uint32_t count);

#endif
