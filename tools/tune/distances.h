/* How far one skin is off another, over all vertices and ticks of a motion. */
#ifndef TUNE_DISTANCES_H
#define TUNE_DISTANCES_H

#include "chart/track.h"

/* Meters. */
typedef struct tune_distances {
  double rms_m; /* root of the mean square */
  double p99_m; /* 99 of 100 vertices and ticks are no farther off */
  double max_m; /* of the worst vertex in its worst tick */
} tune_distances;

/* Which of them errors are compared by. */
typedef enum tune_by { TUNE_BY_MAX, TUNE_BY_P99, TUNE_BY_RMS, TUNE_BY_COUNT } tune_by;

extern const char *const tune_by_names[TUNE_BY_COUNT]; /* "most", "p99", "rms" */

double tune_distance_by(const tune_distances *distances, tune_by by);

/* Two tracks of the same points and ticks; false where memory runs out. */
bool tune_distances_between(const chart_track *is, const chart_track *wanted, tune_distances *distances);

/* The larger of each. */
tune_distances tune_distances_larger(const tune_distances *a, const tune_distances *b);

#endif
