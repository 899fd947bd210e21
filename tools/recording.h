/* A recording that a run writes or replays (sbrun/record.h). */
#ifndef RECORDING_H
#define RECORDING_H

#include "cli.h"
#include "sbrun/record.h"

typedef struct recording {
  FILE *file; /* while writing; else NULL */
  const char *path;
  unsigned char *bytes; /* while replaying; else NULL */
  sbr_replay replay;
} recording;

/* Uses --record and --replay, if present; call right after the world's characters are created. Returns
 * SBF_OK or the exit status, with a message printed. */
int recording_open(recording *r, const cli_call *call, sbr_world *world);
/* After the last frame: finishes writing; false, with a message printed, on failure. */
bool recording_finish(recording *r, const cli_call *call, sbr_world *world);
void recording_close(recording *r);

/* Adds the result of a replay to a report. */
void recording_report(const recording *r, json_t *object);

#endif
