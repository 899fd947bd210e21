/* Interleaved timing for comparisons. A round runs each item once, and the next round in reverse order, so
 * that load and thermal throttling affect all items equally. */
#ifndef CHART_ROUNDS_H
#define CHART_ROUNDS_H

#include <stdbool.h>

#include "chart/spread.h"

/* Processor time of the calling thread: excludes other load of the machine. */
double chart_now_s(void);

/* Pins the calling thread to a core: number `core` of those it may run on, from 0. False if the system
 * does not support that, or there is no such core. */
bool chart_stay_on_core(uint32_t core);

typedef struct chart_timed {
  void (*run)(void *context);   /* the timed function */
  void (*after)(void *context); /* frees its results; may be NULL */
  void *context;
  chart_spread s; /* seconds of one run */
  double *times;  /* (rounds) seconds of each run, in order; NULL: not needed */
} chart_timed;

/* Runs all `rounds` times (at least 1), after one warm-up round. `progress` (may be NULL) receives the
 * completed fraction. False if memory runs out. */
bool chart_time_in_turns(chart_timed *all, uint32_t count, uint32_t rounds,
    void (*progress)(void *user, double fraction), void *user);

#endif
