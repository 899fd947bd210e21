/* How a signal that swings does so: its period and its height. */
#ifndef CHART_OSCILLATION_H
#define CHART_OSCILLATION_H

#include <stdbool.h>
#include <stdint.h>

typedef struct chart_swing {
  double period_s;      /* mean of the whole periods that were seen */
  double first_height;  /* half of what lies between the highest and the lowest in the first whole period */
  double last_height;   /* the same of the last */
  double damping_ratio; /* of a swing that fades from the one to the other; negative: it grows */
  uint32_t periods;     /* whole ones */
} chart_swing;

/* Of `count` samples `step_s` apart, about `level`. Crossings and extremes are found between samples by
 * parabolas and cubics. False where it does not cross the level upwards twice. */
bool chart_swing_of(const double *signal, uint32_t count, double step_s, double level, chart_swing *swing);

#endif
