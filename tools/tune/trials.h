/* Sweep: every mesh with the runtime's default scheme, and with other schemes that need fewer visits. The
 * cheapest run first, so that a trial with a larger error than one of them in any motion can be stopped. */
#ifndef TUNE_TRIALS_H
#define TUNE_TRIALS_H

#include "chart/spread.h"
#include "tune/comparison.h"
#include "tune/tuned_meshes.h"

typedef struct tune_trial {
  uint32_t mesh; /* index of the mesh */
  chart_setting setting;
  double element_visits; /* per tick; as in the file's cost */
  double visits;         /* as counted by the runtime: sbr_detail_level.visits */
  tune_error error;
  tune_error other;        /* with the other drive, for `driven_harder` trials, else zeros */
  tune_distances promised; /* for those: a quarter more than the maximum of both drives, including the
                              references' own error */
  bool refused;
  bool driven_harder;
  bool costlier; /* skipped: a cheaper trial meets the goal */
  bool on_front;
  chart_spread us; /* per tick, on one core; for trials on the front, else zeros */
} tune_trial;

typedef struct tune_trials {
  tune_trial *at;
  uint32_t count, capacity; /* sorted by visits; rejected trials last */
  uint32_t *front;          /* indices, cheapest first */
  uint32_t front_count;
} tune_trials;

typedef struct tune_effort {
  bool own_scheme_alone;
  tune_by by;      /* error measure of the front */
  double enough_m; /* stops once a trial promises this; 0: runs all */
  uint32_t rounds; /* number of timing rounds, for the median */
  void (*progress)(void *user, const char *what, double fraction); /* may be NULL */
  void *user;
} tune_effort;

/* Plans trials and counts their visits. Free with tune_trials_free, also on failure. */
sbf_status tune_trials_plan(
    const tune_meshes *meshes, const tune_effort *effort, tune_trials *trials, sbf_diagnostic *error);
/* Runs the trials with `comparison`. Unsupported or broken ones are recorded too. Those that no cheaper one
 * beats also run with `other`, a harsher drive, and are on the front if no cheaper one promises as small
 * an error. SBF_BAD_INPUT if the front is empty. */
sbf_status tune_trials_run(const tune_meshes *meshes, const tune_comparison *comparison,
    const tune_comparison *other, const tune_effort *effort, tune_trials *trials, sbf_diagnostic *error);
void tune_trials_free(tune_trials *trials);

#endif
