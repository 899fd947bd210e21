/* Recorded motion: positions of points at the end of every tick, and totals of the body. */
#ifndef CHART_TRACK_H
#define CHART_TRACK_H

#include "sbfmt/base.h"
#include "sbfmt/model.h"

typedef struct chart_track {
  uint32_t ticks, points;
  sbf_vec3 *positions; /* (ticks x points) m */
  double *energy_j;    /* (ticks) kinetic, elastic, and potential by weight */
  double *kinetic_j;   /* (ticks) kinetic only */
  double *volume;      /* (ticks) enclosed volume relative to rest; the minimum over several bodies */
  bool sound;          /* the simulation did not break */
  double max_strain;   /* of an element, in any tick */
  bool turned_over;    /* an element was inverted at the end of some tick */
  char why[96];        /* reason if it broke */
} chart_track;

/* Allocates; false if memory runs out. Free with chart_track_free. */
bool chart_track_make(chart_track *track, uint32_t ticks, uint32_t points);
/* Copies a track; false if memory runs out. */
bool chart_track_copy(chart_track *track, const chart_track *from);
void chart_track_free(chart_track *track);

#endif
