/* What was seen of a motion: where points were at the end of every tick, and the whole body's figures. */
#ifndef CHART_TRACK_H
#define CHART_TRACK_H

#include "sbfmt/base.h"
#include "sbfmt/model.h"

typedef struct chart_track {
  uint32_t ticks, points;
  sbf_vec3 *positions; /* (ticks x points) m */
  double *energy_j;    /* (ticks) of motion, of springs and elements, and of weight */
  double *kinetic_j;   /* (ticks) that of motion alone */
  double *volume;      /* (ticks) enclosed, share of that at rest; the least of several bodies' */
  bool sound;          /* nothing broke */
  double max_strain;   /* of an element, in any tick */
  bool turned_over;    /* an element was inside out at the end of some tick */
  char why[96];        /* what did */
} chart_track;

/* Room for so many; false where memory runs out. Free with chart_track_free. */
bool chart_track_make(chart_track *track, uint32_t ticks, uint32_t points);
/* The same, of its own; false likewise. */
bool chart_track_copy(chart_track *track, const chart_track *from);
void chart_track_free(chart_track *track);

#endif
