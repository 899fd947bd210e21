/* Forces and holds of the host, as impulses on the velocities of a substep. They act before the contacts, so
 * that a wall stops a body that is pulled into it.
 *
 * A hold is a damped spring to its target, integrated implicitly: J = -h (k (x - p) + (h k + c) v) / (1 + h
 * (h k + c) / m), with m the effective mass at the vertex and |J| at most the maximum force times h. It is
 * stable even if the vertex is much lighter than the body, from which k and c are chosen (E. Catto, Soft
 * Constraints, 2011). */
#ifndef SBRI_LOADS_H
#define SBRI_LOADS_H

#include "model/island_tick.h"

static inline bool sbri_is_loaded(const sbri_island_tick *t, const sbri_body *body) {
  for (uint32_t i = 0; i < t->environment.load_count; i++)
    if (&t->model->bodies[t->environment.loads[i].body] == body) return true;
  return false;
}

void sbri_loads_apply(const sbri_island_tick *t, const sbri_body *body, float *velocities, float h);

#endif
