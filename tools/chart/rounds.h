/* Times of things that are compared: they run in turns. A round runs each once, and the next round the other
 * way about, so that a machine that is busy, or slows down as it warms, does so for all of them. */
#ifndef CHART_ROUNDS_H
#define CHART_ROUNDS_H

#include <stdbool.h>

#include "chart/spread.h"

/* Processor time of the calling thread: what else a busy machine does meanwhile does not count. */
double chart_now_s(void);

/* Keeps the calling thread on one core from now on: the `core`-th of those that it may run on, from 0.
 * False where the system does not do that, or there is no such core. */
bool chart_stay_on_core(uint32_t core);

typedef struct chart_timed {
  void (*run)(void *context);   /* what is timed */
  void (*after)(void *context); /* puts away what it made; may be NULL */
  void *context;
  chart_spread s; /* seconds of one run */
  double *times;  /* (rounds) seconds of each run, in order; NULL: they are not wanted */
} chart_timed;

/* Runs all `rounds` times (at least 1), after one round that does not count. `progress` (may be NULL) is told
 * the share that is done. False where memory runs out. */
bool chart_time_in_turns(chart_timed *all, uint32_t count, uint32_t rounds,
    void (*progress)(void *user, double fraction), void *user);

#endif
