/* The character with the levels that were chosen. */
#ifndef TUNED_LEVELS_H
#define TUNED_LEVELS_H

#include "tune/trials.h"

/* A level to be written. */
typedef struct tune_level {
  const tune_mesh *mesh;
  const tune_trial *trial;
} tune_level;

/* Makes `*made` of `base`: every derived body gets these levels, finest first, each with what was measured,
 * and keeps its own of jiggle behind them; `settings` and `machine` are what the derivation and the times
 * say. Authored bodies stay as they are. */
sbf_status tune_levels_write(const sbf_asset *base, const tune_level *levels, uint32_t count,
    const char *settings, const char *machine, sbf_asset **made, sbf_diagnostic *error);

#endif
