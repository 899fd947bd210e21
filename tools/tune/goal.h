/* Selects one of several settings of a character by cost and error. */
#ifndef TUNE_GOAL_H
#define TUNE_GOAL_H

#include <stdbool.h>
#include <stdint.h>

typedef struct tune_goal {
  double error_m;   /* maximum; 0: unlimited */
  double budget_us; /* maximum; 0: unlimited */
} tune_goal;

/* A point on the Pareto front. */
typedef struct tune_offer {
  double error_m, us;
} tune_offer;

typedef enum tune_verdict {
  TUNE_MET,
  TUNE_TOO_FINE,  /* none has this error */
  TUNE_TOO_CHEAP, /* none has this cost */
  TUNE_NOT_BOTH   /* those with the error exceed the cost */
} tune_verdict;

/* `front` is sorted by increasing cost and decreasing error. `*chosen`: with a maximum error, the first
 * that meets it; else the last within the budget, or the last of all; if none qualifies, the closest. */
tune_verdict tune_choose(const tune_offer *front, uint32_t count, const tune_goal *goal, uint32_t *chosen);

#endif
