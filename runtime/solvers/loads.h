/* Forces and holds of a host, as impulses on the velocities that a substep is about to move places by: where
 * contacts act, and before them, so that a wall stops what is drawn into it.
 *
 * A hold is a damped spring to its target by an implicit step of its own: J = -h (k (x - p) + (h k + c) v) /
 * (1 + h (h k + c) / m), m the mass that answers at the vertex, |J| no more than the greatest force times h.
 * So it is stable however light the vertex is against the body that k and c are meant for (E. Catto, Soft
 * Constraints, 2011). */
#ifndef SBRI_LOADS_H
#define SBRI_LOADS_H

#include "model/island_tick.h"

static inline bool sbri_is_loaded(const sbri_island_tick *t, const sbri_body *body) {
  for (uint32_t i = 0; i < t->load_count; i++)
    if (&t->model->bodies[t->loads[i].body] == body) return true;
  return false;
}

void sbri_loads_apply(const sbri_island_tick *t, const sbri_body *body, float *velocities, float h);

#endif
