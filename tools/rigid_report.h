/* Reports errors of rigid bodies in a run: joints, limits, and time at rest. */
#ifndef RIGID_REPORT_H
#define RIGID_REPORT_H

#include <jansson.h>

#include "session.h"

typedef struct rigid_report {
  bool asked;             /* the call requests simulated rigid bodies */
  double angle_violation; /* rad, maximum violation of a hard angle limit */
  double separation;      /* m, maximum separation of a joint */
  double moving_s;        /* last time at which something moved faster than REST_M_S */
} rigid_report;

/* Before the first frame. */
void rigid_report_begin(rigid_report *report, const session *s);
/* After each frame. */
void rigid_report_measure(rigid_report *report, const session *s);
void rigid_report_add(const rigid_report *report, const session *s, json_t *object);

#endif
