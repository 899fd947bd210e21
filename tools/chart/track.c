#include "chart/track.h"

#include <stdlib.h>
#include <string.h>

bool chart_track_make(chart_track *track, uint32_t ticks, uint32_t points) {
  *track = (chart_track){.ticks = ticks, .points = points, .sound = true};
  track->positions = calloc((size_t)ticks * points + 1, sizeof *track->positions);
  track->energy_j = calloc((size_t)ticks + 1, sizeof *track->energy_j);
  track->kinetic_j = calloc((size_t)ticks + 1, sizeof *track->kinetic_j);
  track->volume = calloc((size_t)ticks + 1, sizeof *track->volume);
  if (track->positions && track->energy_j && track->kinetic_j && track->volume) return true;
  chart_track_free(track);
  return false;
}

bool chart_track_copy(chart_track *track, const chart_track *from) {
  if (!chart_track_make(track, from->ticks, from->points)) return false;
  size_t ticks = from->ticks;
  memcpy(track->positions, from->positions, ticks * from->points * sizeof *track->positions);
  memcpy(track->energy_j, from->energy_j, ticks * sizeof *track->energy_j);
  memcpy(track->kinetic_j, from->kinetic_j, ticks * sizeof *track->kinetic_j);
  memcpy(track->volume, from->volume, ticks * sizeof *track->volume);
  track->sound = from->sound;
  track->turned_over = from->turned_over;
  track->max_strain = from->max_strain;
  memcpy(track->why, from->why, sizeof track->why);
  return true;
}

void chart_track_free(chart_track *track) {
  free(track->positions);
  free(track->energy_j);
  free(track->kinetic_j);
  free(track->volume);
  *track = (chart_track){.ticks = 0};
}
