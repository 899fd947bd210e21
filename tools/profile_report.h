/* What a run's ticks cost, by stage, and what its world holds: `--profile` and `--trace`. */
#ifndef PROFILE_REPORT_H
#define PROFILE_REPORT_H

#include "render/output_file.h"
#include "sbrun/debug.h"
#include "session.h"

typedef struct profile_report {
  bool timed;                      /* the world has a clock */
  bool shown;                      /* --profile */
  uint64_t tick_count;             /* ticks that were timed */
  uint64_t last_tick;              /* the number of the last of them */
  double stage_s[SBR_STAGE_COUNT]; /* sums over these ticks */
  double tick_s, skin_s;           /* likewise: whole ticks, and reading skins */
  double begin_s;                  /* when the run began */
  FILE *file;                      /* of --trace; NULL: none */
  output_file output;
} profile_report;

/* Seconds of a clock that never falls. */
double profile_now_s(void);
/* Reads the call's options and gives the world a clock where one needs it. False, with a message, where the
 * trace cannot be written. */
bool profile_report_begin(profile_report *p, session *s, cli_call *call);
/* Once a frame, after the step and after the skin was read, which began at `skin_begin_s`. False: the trace
 * cannot be written. */
bool profile_report_measure(profile_report *p, const session *s, double skin_begin_s, sbf_diagnostic *error);
/* Adds `profile`, mean microseconds a tick by stage, and `counters`. */
void profile_report_add(const profile_report *p, const session *s, json_t *to);
/* Puts the complete trace into its place, or removes what was written. */
sbf_status profile_report_end(profile_report *p, bool keep, sbf_diagnostic *error);

#endif
