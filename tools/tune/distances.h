/* Distance of two skins over all vertices and ticks of a motion. */
#ifndef TUNE_DISTANCES_H
#define TUNE_DISTANCES_H

#include "chart/track.h"

/* Meters. */
typedef struct tune_distances {
  double rms_m; /* root of the mean square */
  double p99_m; /* 99th percentile over vertices and ticks */
  double max_m; /* maximum over vertices and ticks */
} tune_distances;

/* Which of them is the error measure. */
typedef enum tune_by { TUNE_BY_MAX, TUNE_BY_P99, TUNE_BY_RMS, TUNE_BY_COUNT } tune_by;

extern const char *const tune_by_names[TUNE_BY_COUNT]; /* "most", "p99", "rms" */

double tune_distance_by(const tune_distances *distances, tune_by by);

/* Two tracks of the same points and ticks; false if memory runs out. */
bool tune_distances_between(const chart_track *is, const chart_track *wanted, tune_distances *distances);

/* Maximum of each. */
tune_distances tune_distances_larger(const tune_distances *a, const tune_distances *b);

#endif
