/* How often a run's soft bodies were put back into their rest shape. */
#ifndef RECOVERY_REPORT_H
#define RECOVERY_REPORT_H

#include "session.h"

typedef struct recovery_count {
  uint32_t last;         /* sbr_body_health.recoveries of the last frame */
  uint32_t total;        /* since the run began */
  uint32_t row, longest; /* frames in a row, up to now and at most */
} recovery_count;

typedef struct recovery_report {
  recovery_count *bodies; /* one per soft body; NULL: none */
  uint32_t body_count;
} recovery_report;

/* False where memory runs out. */
bool recovery_report_begin(recovery_report *r, const sbf_asset *asset);
void recovery_report_end(recovery_report *r);
/* Once a frame and body. */
void recovery_report_measure(recovery_report *r, uint32_t body, const sbr_body_health *health);
/* Adds `recoveries`, the sum over all bodies, and `recovered`, the bodies of which that is not 0. */
void recovery_report_add(const recovery_report *r, const sbf_asset *asset, json_t *to);
/* Warns on standard error of each body that was put back in several frames in a row. */
void recovery_report_warn(const recovery_report *r, const sbf_asset *asset);

#endif
