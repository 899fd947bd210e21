/* How far one motion is off another, by several measures. */
#ifndef CHART_ERRORS_H
#define CHART_ERRORS_H

#include "chart/track.h"

typedef enum chart_axis {
  CHART_PATH,       /* m: root of the mean square, over points and ticks, of how far points are off */
  CHART_FARTHEST,   /* m: the greatest of that */
  CHART_PERIOD,     /* share by which the signal's period is off */
  CHART_AMPLITUDE,  /* share by which its height in the last period is off */
  CHART_SHAPE,      /* at rest: root of the mean square of how far points are off, over how far they moved */
  CHART_VOLUME,     /* greatest difference of the enclosed volume, share of that at rest */
  CHART_ENERGY,     /* greatest difference of the whole energy, over the most that was in motion */
  CHART_PIXELS,     /* CHART_PATH on a screen of 1080 lines that shows 60 degrees, from a chosen distance */
  CHART_MAX_PIXELS, /* CHART_FARTHEST there */
  CHART_AXIS_COUNT
} chart_axis;

extern const char *const chart_axis_names[CHART_AXIS_COUNT];  /* in tables and file names: "path_m" */
extern const char *const chart_axis_labels[CHART_AXIS_COUNT]; /* beside the axis of a drawing */

/* The first of those that are farthest along x at rest. */
#define CHART_END_POINT UINT32_MAX

/* What swings, if anything does. */
typedef struct chart_signal {
  bool there;
  bool of_volume; /* the volume; else a point's place: */
  uint32_t point; /* or CHART_END_POINT */
  int along;      /* 0, 1, 2: x, y, z */
} chart_signal;

/* So many pixels is a metre, on such a screen. */
double chart_pixels_a_metre(double distance_m);

/* How far points move from where they were at rest: root of the mean square over points and ticks. */
double chart_extent_of(const chart_track *track, const sbf_vec3 *rest);

/* Fills `errors` for the axes among `axes` (bits of 1 << axis), NAN for others and for what cannot be told of
 * this motion; pixels are left to the caller. `rest` (points) are the places before it began. False where
 * memory runs out. */
bool chart_errors_of(const chart_track *track, const chart_track *reference, const sbf_vec3 *rest,
    double tick_s, const chart_signal *signal, unsigned axes, double errors[CHART_AXIS_COUNT]);

#endif
