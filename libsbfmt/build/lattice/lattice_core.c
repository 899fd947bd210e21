#include "build/lattice/lattice_core.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double near_fraction = 0.25, reach_fraction = 1.5;

typedef struct ranked {
  double key;
  uint32_t point;
} ranked;

static int by_key(const void *a, const void *b) {
  ranked x, y;
  memcpy(&x, a, sizeof x);
  memcpy(&y, b, sizeof y);
  if (x.key != y.key) return x.key < y.key ? -1 : 1;
  return x.point < y.point ? -1 : x.point > y.point;
}

static double component(sbf_vec3 v, int axis) {
  const float values[3] = {v.x, v.y, v.z};
  return (double)values[axis];
}

/* The axis along which a ball's range contains the fewest points. */
static int longest_axis(const sbf_vec3 *points, uint32_t count) {
  int longest = 0;
  double max = -1;
  for (int axis = 0; axis < 3; axis++) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
      low = fmin(low, component(points[i], axis));
      high = fmax(high, component(points[i], axis));
    }
    if (high - low <= max) continue;
    max = high - low;
    longest = axis;
  }
  return longest;
}

static double squared_between(sbf_vec3 a, sbf_vec3 b) {
  double x = (double)a.x - b.x, y = (double)a.y - b.y, z = (double)a.z - b.z;
  return x * x + y * y + z * z;
}

bool sbfi_lattice_thickness(const sbf_vec3 *points, const double *depths2, uint32_t count, double min_m,
    float *thickness, sbfi_arena *scratch) {
  ranked *along = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *along);
  ranked *deepest = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *deepest);
  uint8_t *near = sbfi_arena_allocate(scratch, (size_t)count + 1, 1);
  if (!along || !deepest || !near) return false;
  int axis = longest_axis(points, count);
  for (uint32_t i = 0; i < count; i++) {
    along[i] = (ranked){component(points[i], axis), i};
    deepest[i] = (ranked){-depths2[i], i};
    thickness[i] = 0;
  }
  qsort(along, count, sizeof *along, by_key);
  qsort(deepest, count, sizeof *deepest, by_key);
  for (uint32_t n = 0; n < count; n++) {
    uint32_t middle = deepest[n].point;
    double radius = sqrt(depths2[middle]), reach = reach_fraction * radius;
    double at = component(points[middle], axis);
    if (near[middle] || radius <= min_m) continue;
    uint32_t low = 0, high = count;
    while (low < high) {
      uint32_t between = low + (high - low) / 2;
      if (along[between].key < at - reach)
        low = between + 1;
      else
        high = between;
    }
    for (; low < count && along[low].key <= at + reach; low++) {
      uint32_t i = along[low].point;
      double squared = squared_between(points[i], points[middle]);
      if (squared > reach * reach) continue;
      thickness[i] = fmaxf(thickness[i], (float)radius);
      if (squared <= near_fraction * near_fraction * radius * radius) near[i] = 1;
    }
  }
  return true;
}
