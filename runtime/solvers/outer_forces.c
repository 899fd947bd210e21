#include "solvers/outer_forces.h"

void sbri_outer_forces(const sbri_island_tick *t) {
  for (uint32_t slot = 0; slot < t->island->free_count; slot++) t->outer[slot] = (sbri_point){0, 0, 0, 0};
}
