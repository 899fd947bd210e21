/* Estimates the duration of a tuning. */
#ifndef TUNE_FORECAST_H
#define TUNE_FORECAST_H

#include "tune/trials.h"

typedef struct tune_forecast {
  double min_s, max_s; /* on one core: most trials are soon beaten; none is, and the reference must be refined
                          in each motion */
} tune_forecast;

/* Times some ticks of the reference. */
sbf_status tune_forecast_make(
    const tune_meshes *meshes, const tune_trials *planned, tune_forecast *forecast, sbf_diagnostic *error);
/* As "2 to 5 minutes". */
void tune_forecast_say(const tune_forecast *forecast, char *text, size_t size);

#endif
