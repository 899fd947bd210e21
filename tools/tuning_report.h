/* What a tuning found, said as text or as JSON. */
#ifndef TUNING_REPORT_H
#define TUNING_REPORT_H

#include "chart/machine.h"
#include "cli.h"
#include "tune/goal.h"
#include "tune/tuned_levels.h"

typedef struct tuning {
  const char *path, *out;
  tune_goal goal;
  bool by_rms, written;
  tune_meshes meshes;
  tune_yardstick yard, other; /* of the usual drive and of a harsher one */
  tune_trials trials;
  tune_verdict verdict;
  uint32_t chosen; /* on the front */
  tune_level levels[TUNE_MAX_MESHES];
  uint32_t level_count;
  chart_machine machine;
} tuning;

/* Why nothing is written, and the closest that can be. */
void tuning_say_unmet(const cli_call *call, const tuning *t);
void tuning_print(const tuning *t);
json_t *tuning_json(const tuning *t);

#endif
