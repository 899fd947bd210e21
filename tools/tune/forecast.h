/* How long a tuning will take, from what it is going to look at. */
#ifndef TUNE_FORECAST_H
#define TUNE_FORECAST_H

#include "tune/trials.h"

typedef struct tune_forecast {
  double min_s, max_s; /* on a core of its own: most of what is tried is soon beaten; nothing is, and the
                             reference has to be refined in each motion */
} tune_forecast;

/* Times some ticks of the reference. */
sbf_status tune_forecast_make(
    const tune_meshes *meshes, const tune_trials *planned, tune_forecast *forecast, sbf_diagnostic *error);
/* As "2 to 5 minutes". */
void tune_forecast_say(const tune_forecast *forecast, char *text, size_t size);

#endif
