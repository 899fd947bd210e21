/* Forces that are neither springs nor weight: gas inside a surface, a medium that pushes on it, bending of
 * sheets, force fields. */
#ifndef SBRI_OUTER_FORCES_H
#define SBRI_OUTER_FORCES_H

#include "solvers/scheme.h"

/* Their sum on each free point, into t->outer, at the present positions and velocities. */
void sbri_outer_forces(const sbri_island_tick *t);

#endif
