/* Measures the difference between two motions. */
#ifndef CHART_ERRORS_H
#define CHART_ERRORS_H

#include "chart/track.h"

typedef enum chart_axis {
  CHART_PATH,      /* m: root mean square of the distance over points and ticks */
  CHART_FARTHEST,  /* m: maximum distance */
  CHART_PERIOD,    /* relative error of the signal's period */
  CHART_AMPLITUDE, /* relative error of its amplitude in the last period */
  CHART_SHAPE,     /* at rest: root mean square of the distance relative to the displacement */
  CHART_VOLUME,    /* maximum difference of the enclosed volume, as a fraction of that at rest */
  CHART_ENERGY,    /* maximum difference of the total energy relative to the maximum kinetic energy */
  CHART_PIXELS, /* CHART_PATH in pixels of a screen with 1080 lines and a field of view of 60 degrees, from a
                   chosen distance */
  CHART_MAX_PIXELS, /* CHART_FARTHEST in these pixels */
  CHART_AXIS_COUNT
} chart_axis;

extern const char *const chart_axis_names[CHART_AXIS_COUNT];  /* in tables and file names: "path_m" */
extern const char *const chart_axis_labels[CHART_AXIS_COUNT]; /* label of the axis of a drawing */

/* The first of the points farthest along x at rest. */
#define CHART_END_POINT UINT32_MAX

/* Oscillating quantity, if any. */
typedef struct chart_signal {
  bool there;
  bool of_volume; /* the volume; otherwise a point's position: */
  uint32_t point; /* index or CHART_END_POINT */
  int along;      /* 0, 1, 2: x, y, z */
} chart_signal;

/* Pixels per metre on such a screen. */
double chart_pixels_a_metre(double distance_m);

/* Displacement of points from rest: root mean square over points and ticks. */
double chart_extent_of(const chart_track *track, const sbf_vec3 *rest);

/* Fills `errors` for the axes in `axes` (bits of 1 << axis), NAN for others and for undefined ones; pixels
 * are left to the caller. `rest` (points) are the initial positions. False if memory runs out. */
bool chart_errors_of(const chart_track *track, const chart_track *reference, const sbf_vec3 *rest,
    double tick_s, const chart_signal *signal, unsigned axes, double errors[CHART_AXIS_COUNT]);

#endif
