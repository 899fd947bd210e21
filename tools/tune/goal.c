#include "tune/goal.h"

static uint32_t cheapest(const tune_offer *front, uint32_t count) {
  uint32_t best = 0;
  for (uint32_t i = 1; i < count; i++)
    if (front[i].us < front[best].us) best = i;
  return best;
}

tune_verdict tune_choose(const tune_offer *front, uint32_t count, const tune_goal *goal, uint32_t *chosen) {
  *chosen = count ? count - 1 : 0;
  if (count == 0) return TUNE_TOO_FINE;
  if (goal->error_m > 0) {
    uint32_t i = 0;
    while (i < count && !(front[i].error_m <= goal->error_m)) i++;
    if (i == count) return TUNE_TOO_FINE;
    /* Times are measured but the order is by visits: a later one may be faster. */
    while (goal->budget_us > 0 && i + 1 < count && front[i].us > goal->budget_us) i++;
    if (!(goal->budget_us > 0) || front[i].us <= goal->budget_us) {
      *chosen = i;
      return TUNE_MET;
    }
    *chosen = i;
    for (i = 0; i < count; i++)
      if (front[i].error_m <= goal->error_m && front[i].us < front[*chosen].us) *chosen = i;
    return TUNE_NOT_BOTH;
  }
  if (!(goal->budget_us > 0)) return TUNE_MET;
  for (uint32_t i = count; i-- > 0;)
    if (front[i].us <= goal->budget_us) {
      *chosen = i;
      return TUNE_MET;
    }
  *chosen = cheapest(front, count);
  return TUNE_TOO_CHEAP;
}
