#include "chart/front.h"

#include <math.h>
#include <stdbool.h>

/* Whether p is at least as good as q in both values and better in one, or equal and listed before. */
static bool beats(const chart_point *points, uint32_t p, uint32_t q) {
  const chart_point *a = &points[p], *b = &points[q];
  if (!(a->cost <= b->cost && a->error <= b->error)) return false;
  return a->cost < b->cost || a->error < b->error || p < q;
}

uint32_t chart_front_of(const chart_point *points, uint32_t count, uint32_t *front) {
  uint32_t found = 0;
  for (uint32_t i = 0; i < count; i++) {
    bool on_it = isfinite(points[i].cost) && isfinite(points[i].error);
    for (uint32_t k = 0; on_it && k < count; k++) on_it = k == i || !beats(points, k, i);
    if (!on_it) continue;
    uint32_t at = found++;
    for (; at > 0 && points[front[at - 1]].cost > points[i].cost; at--) front[at] = front[at - 1];
    front[at] = i;
  }
  return found;
}
