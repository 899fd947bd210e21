/* Creates the character with the chosen levels. */
#ifndef TUNED_LEVELS_H
#define TUNED_LEVELS_H

#include "tune/trials.h"

/* A level to be written. */
typedef struct tune_level {
  const tune_mesh *mesh;
  const tune_trial *trial;
} tune_level;

/* Creates `*made` from `base`: every derived body gets these levels, finest first, with their
 * measurements, and keeps its own jiggle level after them; `settings` and `machine` are recorded in the
 * derivation and the times. Authored bodies do not change. */
sbf_status tune_levels_write(const sbf_asset *base, const tune_level *levels, uint32_t count,
    const char *settings, const char *machine, sbf_asset **made, sbf_diagnostic *error);

#endif
