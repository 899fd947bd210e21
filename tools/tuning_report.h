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
  tune_yardstick yard, other; /* of the drive it is tuned by, and of another */
  tune_trials trials;
  tune_verdict verdict;
  uint32_t chosen; /* on the front */
  tune_level levels[TUNE_MOST_MESHES];
  tune_error verified[TUNE_MOST_MESHES]; /* of each level, by the other drive */
  uint32_t level_count;
  chart_machine machine;
} tuning;

/* The error that a goal speaks of, m, with what the reference may be off itself. */
double tuning_error(const tuning *t, const tune_trial *trial);
double tuning_verified(const tuning *t);

/* Why nothing is written, and the closest that can be. */
void tuning_say_unmet(const cli_call *call, const tuning *t);
void tuning_print(const tuning *t);
json_t *tuning_json(const tuning *t);

#endif
