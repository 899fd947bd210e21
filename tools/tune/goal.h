/* Which of several ways to step a character is to be written, by what they cost and how far they are off. */
#ifndef TUNE_GOAL_H
#define TUNE_GOAL_H

#include <stdbool.h>
#include <stdint.h>

typedef struct tune_goal {
  double error_m;   /* at most; 0: any */
  double budget_us; /* at most; 0: any */
} tune_goal;

/* One on the Pareto front. */
typedef struct tune_offer {
  double error_m, us;
} tune_offer;

typedef enum tune_verdict {
  TUNE_MET,
  TUNE_TOO_FINE,  /* none is so near */
  TUNE_TOO_CHEAP, /* none is so cheap */
  TUNE_NOT_BOTH   /* what is near enough is too dear */
} tune_verdict;

/* `front` is in order of growing cost and falling error. `*chosen`: with an error asked for, the first that
 * keeps it; else the last within the budget, or the last of all; where none does, that which comes nearest.
 */
tune_verdict tune_choose(const tune_offer *front, uint32_t count, const tune_goal *goal, uint32_t *chosen);

#endif
