/* Reports the result of a tuning as text or JSON. */
#ifndef TUNING_REPORT_H
#define TUNING_REPORT_H

#include "chart/machine.h"
#include "cli.h"
#include "tune/goal.h"
#include "tune/tuned_levels.h"

typedef struct tuning {
  const char *path, *out;
  tune_goal goal;
  double size_m;        /* of the character */
  double error_percent; /* of the size, if the goal was given so; else 0 */
  tune_by by;
  bool written;
  tune_meshes meshes;
  tune_comparison comparison, other; /* for the usual and a harsher drive */
  tune_trials trials;
  tune_verdict verdict;
  uint32_t chosen; /* index on the front */
  tune_level levels[TUNE_MAX_MESHES];
  uint32_t level_count;
  chart_machine machine;
} tuning;

enum { TUNING_TEXT = 512 };
/* Reason why the goal is not met, and the closest alternative. */
void tuning_describe_unmet(const tuning *t, char text[TUNING_TEXT]);
void tuning_print(const tuning *t);
json_t *tuning_json(const tuning *t);

#endif
