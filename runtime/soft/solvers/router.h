/* Selects the integrator of an island per tick, if the asset leaves the choice to the runtime. */
#ifndef SBRI_ROUTER_H
#define SBRI_ROUTER_H

#include "soft/solvers/scheme.h"

/* A body uses the explicit integrator if SBRI_MAX_SUBSTEPS are enough at rest; it has the least energy error
 * for its cost. A strained body is in trouble if it needs more than 1.5 times the substeps at rest and more
 * than these numbers. */
enum { SBRI_TROUBLED_SUBSTEPS = 192, SBRI_TROUBLED_SOLID_SUBSTEPS = 256 };

/* Ticks of the recovery integrator after the last sign of trouble. */
enum { SBRI_RECOVERING_TICKS = 10 };

/* Whether the island at rest uses the explicit integrator. */
bool sbri_router_begins_explicit(const sbri_island *island);

/* Integrator of an island in this state of recovery. */
const sbri_scheme *sbri_router_scheme(const sbri_island *island, const sbri_recovery *recovery);

/* Integrator of the coming tick. Signs of trouble: too many substeps for an explicit integrator, an inverted
 * tetrahedron, or points that move by more than a cell per substep relative to their body. Recovery ticks
 * count down from there, or from a value set by the caller; they are also counted for fixed integrators,
 * which do not change. */
const sbri_scheme *sbri_router_choose(const sbri_island_tick *tick, sbri_recovery *recovery);

#endif
