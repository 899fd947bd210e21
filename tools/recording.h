/* A recording that a run writes or plays (sbrun/record.h). */
#ifndef RECORDING_H
#define RECORDING_H

#include "cli.h"
#include "sbrun/record.h"

typedef struct recording {
  FILE *file; /* being written; else NULL */
  const char *path;
  unsigned char *bytes; /* being played; else NULL */
  sbr_replay replay;
} recording;

/* By --record and --replay, where the call has them; right after the world's characters are made. Else the
 * exit status, with a message printed. */
int recording_open(recording *r, const cli_call *call, sbr_world *world);
/* After the last frame: ends what is written; false, with a message printed, where it could not be. */
bool recording_finish(recording *r, const cli_call *call, sbr_world *world);
void recording_close(recording *r);

/* Adds how playing went to a report. */
void recording_report(const recording *r, json_t *object);

#endif
