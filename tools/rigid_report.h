/* How rigid parts fared over a run: joints, limits, and since when they lie still. */
#ifndef RIGID_REPORT_H
#define RIGID_REPORT_H

#include <jansson.h>

#include "session.h"

typedef struct rigid_report {
  bool asked;             /* the call has rigid parts simulated */
  double angle_violation; /* rad, by which the worst hard limit of an angle was broken */
  double separation;      /* m, by which the worst joint was off in place */
  double moving_s;        /* time at which something last moved faster than REST_M_S */
} rigid_report;

/* Before the first frame. */
void rigid_report_begin(rigid_report *report, const session *s);
/* After each frame. */
void rigid_report_measure(rigid_report *report, const session *s);
void rigid_report_add(const rigid_report *report, const session *s, json_t *object);

#endif
