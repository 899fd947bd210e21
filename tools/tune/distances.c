#include "tune/distances.h"

#include <math.h>
#include <stdlib.h>

const char *const tune_by_names[TUNE_BY_COUNT] = {"most", "p99", "rms"};

static const double PERCENTILE = 0.99;

double tune_distance_by(const tune_distances *distances, tune_by by) {
  return by == TUNE_BY_RMS ? distances->rms_m : by == TUNE_BY_P99 ? distances->p99_m : distances->max_m;
}

/* Value at `index` of the sorted order (Hoare, Algorithm 65: Find, 1961). */
static float value_at(float *values, size_t count, size_t index) {
  size_t low = 0, high = count - 1;
  while (low < high) {
    float pivot = values[index];
    size_t i = low, j = high;
    for (;;) {
      while (values[i] < pivot) i++;
      while (pivot < values[j]) j--;
      if (i > j) break;
      float other = values[i];
      values[i] = values[j], values[j] = other;
      i++;
      if (j == 0) break;
      j--;
      if (i > j) break;
    }
    if (index <= j)
      high = j;
    else if (index >= i)
      low = i;
    else
      break;
  }
  return values[index];
}

bool tune_distances_between(const chart_track *is, const chart_track *wanted, tune_distances *distances) {
  size_t count = (size_t)is->ticks * is->points;
  double sum = 0, max = 0;
  *distances = (tune_distances){0, 0, 0};
  if (!count) return true;
  float *squares = malloc(count * sizeof *squares);
  if (!squares) return false;
  for (size_t i = 0; i < count; i++) {
    sbf_vec3 p = is->positions[i], q = wanted->positions[i];
    double x = (double)p.x - (double)q.x, y = (double)p.y - (double)q.y, z = (double)p.z - (double)q.z;
    double square = x * x + y * y + z * z;
    /* NaN counts as infinitely far, and has a position in the order. */
    if (!(square >= 0)) square = INFINITY;
    sum += square;
    max = fmax(max, square);
    squares[i] = (float)square;
  }
  size_t index = (size_t)ceil(PERCENTILE * (double)count) - 1;
  distances->rms_m = sqrt(sum / (double)count);
  distances->max_m = sqrt(max);
  distances->p99_m = fmin(sqrt((double)value_at(squares, count, index)), distances->max_m);
  free(squares);
  return true;
}

tune_distances tune_distances_larger(const tune_distances *a, const tune_distances *b) {
  return (tune_distances){fmax(a->rms_m, b->rms_m), fmax(a->p99_m, b->p99_m), fmax(a->max_m, b->max_m)};
}
