/* The sweep: every mesh by the runtime's own choice, and by other schemes where those look at fewer elements.
 * The cheapest go first, so that what is farther off than one of them, in whatever motion, need not be looked
 * at any longer. */
#ifndef TUNE_TRIALS_H
#define TUNE_TRIALS_H

#include "chart/spread.h"
#include "tune/tuned_meshes.h"
#include "tune/yardstick.h"

typedef struct tune_trial {
  uint32_t mesh; /* number among the meshes */
  chart_setting setting;
  double element_visits; /* a tick; as the file states cost */
  double visits;         /* as the runtime counts them to choose by: sbr_detail_level.visits */
  tune_error error;
  tune_error other;        /* by the other drive, of those that are `driven_harder`, else zeros */
  tune_distances promised; /* of those: a quarter more than the larger of both drives, with what the
                              references are off themselves */
  bool refused;
  bool driven_harder;
  bool dearer; /* it was not tried: something that visits less keeps the goal */
  bool on_front;
  chart_spread us; /* of a tick, on one core; of those on the front, else zeros */
} tune_trial;

typedef struct tune_trials {
  tune_trial *at;
  uint32_t count, capacity; /* in order of visits; what is refused behind */
  uint32_t *front;          /* numbers, the cheapest first */
  uint32_t front_count;
} tune_trials;

typedef struct tune_effort {
  bool own_scheme_alone;
  tune_by by;      /* the front is of these errors */
  double enough_m; /* nothing is tried any more once something promises this; 0: all is tried */
  uint32_t rounds; /* that times are the median of */
  void (*progress)(void *user, const char *what, double fraction); /* may be NULL */
  void *user;
} tune_effort;

/* What is to be tried, and its visits. Free with tune_trials_free, also on failure. */
sbf_status tune_trials_plan(
    const tune_meshes *meshes, const tune_effort *effort, tune_trials *trials, sbf_diagnostic *error);
/* Tries it by `yard`. What is refused or breaks is a trial like any other. What nothing cheaper beats is run
 * by `other` as well, a harsher drive, and is on the front where nothing cheaper promises as little.
 * SBF_BAD_INPUT where nothing is. */
sbf_status tune_trials_run(const tune_meshes *meshes, const tune_yardstick *yard, const tune_yardstick *other,
    const tune_effort *effort, tune_trials *trials, sbf_diagnostic *error);
void tune_trials_free(tune_trials *trials);

#endif
