#include "chart/track.h"

#include <stdlib.h>

bool chart_track_make(chart_track *track, uint32_t ticks, uint32_t points) {
  *track = (chart_track){.ticks = ticks, .points = points, .sound = true};
  track->places = calloc((size_t)ticks * points + 1, sizeof *track->places);
  track->energy_j = calloc((size_t)ticks + 1, sizeof *track->energy_j);
  track->kinetic_j = calloc((size_t)ticks + 1, sizeof *track->kinetic_j);
  track->volume = calloc((size_t)ticks + 1, sizeof *track->volume);
  if (track->places && track->energy_j && track->kinetic_j && track->volume) return true;
  chart_track_free(track);
  return false;
}

void chart_track_free(chart_track *track) {
  free(track->places);
  free(track->energy_j);
  free(track->kinetic_j);
  free(track->volume);
  *track = (chart_track){.ticks = 0};
}
