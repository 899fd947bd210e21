/* Long work says how far it is, and is told whether to go on. */
#ifndef SBFI_PROGRESS_H
#define SBFI_PROGRESS_H

#include "sbfmt/base.h"

/* `call` gets the share of the whole that is done, 0..1; false ends the work. It may be NULL. The work that
 * is handed this is the stretch from `from` to `to` of the whole. */
typedef struct sbfi_progress {
  bool (*call)(void *user, double done);
  void *user;
  double from, to;
} sbfi_progress;

static inline sbfi_progress sbfi_progress_whole(bool (*call)(void *user, double done), void *user) {
  return (sbfi_progress){call, user, 0, 1};
}

/* For a part of this work: its stretch from `from` to `to`, 0..1. */
static inline sbfi_progress sbfi_progress_part(sbfi_progress of, double from, double to) {
  double span = of.to - of.from;
  return (sbfi_progress){of.call, of.user, of.from + span * from, of.from + span * to};
}

/* `done`, 0..1, of this work; false: end it. */
static inline bool sbfi_progress_report(sbfi_progress progress, double done) {
  return !progress.call || progress.call(progress.user, progress.from + (progress.to - progress.from) * done);
}

/* In a loop: asks every 4096th time alone. */
static inline bool sbfi_progress_step(sbfi_progress progress, size_t step, size_t step_count) {
  return step % 4096 != 0 || sbfi_progress_report(progress, (double)step / (double)step_count);
}

#endif
