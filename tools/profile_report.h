/* Costs of a run's ticks by stage, and contents of its world: `--profile` and `--trace`. */
#ifndef PROFILE_REPORT_H
#define PROFILE_REPORT_H

#include "base/output_file.h"
#include "sbrun/debug.h"
#include "session.h"

typedef struct profile_report {
  bool timed;                      /* the world has a clock */
  bool shown;                      /* --profile */
  uint64_t tick_count;             /* ticks that were timed */
  uint64_t last_tick;              /* number of the last of them */
  double stage_s[SBR_STAGE_COUNT]; /* sums over these ticks */
  double tick_s, skin_s;           /* the same for whole ticks, and for reading skins */
  double begin_s;                  /* start time of the run */
  FILE *file;                      /* of --trace; NULL: none */
  output_file output;
} profile_report;

/* Seconds of a monotonic clock. */
double profile_now_s(void);
/* Reads the call's options and sets the world's clock if needed. False, with a message, if the trace
 * cannot be written. */
bool profile_report_begin(profile_report *p, session *s, cli_call *call);
/* Once per frame, after the step and after the skin was read, starting at `skin_begin_s`. False if the
 * trace cannot be written. */
bool profile_report_measure(profile_report *p, const session *s, double skin_begin_s, sbf_diagnostic *error);
/* Adds `profile`, mean microseconds per tick by stage, and `counters`. */
void profile_report_add(const profile_report *p, const session *s, json_t *to);
/* Renames the complete trace to its final path, or deletes it. */
sbf_status profile_report_end(profile_report *p, bool keep, sbf_diagnostic *error);

#endif
