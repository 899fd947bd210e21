/* Period and amplitude of an oscillating signal. */
#ifndef CHART_OSCILLATION_H
#define CHART_OSCILLATION_H

#include <stdbool.h>
#include <stdint.h>

typedef struct chart_swing {
  double period_s;      /* mean of all complete periods */
  double first_height;  /* half the difference between maximum and minimum in the first complete period */
  double last_height;   /* the same of the last */
  double damping_ratio; /* of the decay between these; negative: it grows */
  uint32_t periods;     /* number of complete periods */
} chart_swing;

/* Analyses `count` samples `step_s` apart, about `level`. Interpolates crossings and extremes by parabolas
 * and cubics. False if there are fewer than two upward crossings. */
bool chart_swing_of(const double *signal, uint32_t count, double step_s, double level, chart_swing *swing);

#endif
