/* Progress and cancellation of long work. */
#ifndef SBFI_PROGRESS_H
#define SBFI_PROGRESS_H

#include "sbfmt/base.h"

/* `call` receives the fraction of the whole that is done, 0..1, and returns false to cancel. It may be NULL.
 * The current work is the part of the whole between `from` and `to`. */
typedef struct sbfi_progress {
  bool (*call)(void *user, double done);
  void *user;
  double from, to;
} sbfi_progress;

static inline sbfi_progress sbfi_progress_whole(bool (*call)(void *user, double done), void *user) {
  return (sbfi_progress){call, user, 0, 1};
}

/* Progress of the part of this work between `from` and `to`, 0..1. */
static inline sbfi_progress sbfi_progress_part(sbfi_progress of, double from, double to) {
  double span = of.to - of.from;
  return (sbfi_progress){of.call, of.user, of.from + span * from, of.from + span * to};
}

/* Reports the fraction `done` of this work, 0..1; false: cancel. */
static inline bool sbfi_progress_report(sbfi_progress progress, double done) {
  return !progress.call || progress.call(progress.user, progress.from + (progress.to - progress.from) * done);
}

/* For loops: reports only every 4096th step. */
static inline bool sbfi_progress_step(sbfi_progress progress, size_t step, size_t step_count) {
  return step % 4096 != 0 || sbfi_progress_report(progress, (double)step / (double)step_count);
}

#endif
