/* Which scheme steps an island whose choice is left to the runtime, tick by tick. */
#ifndef SBRI_ROUTER_H
#define SBRI_ROUTER_H

#include "solvers/scheme.h"

/* A body is stepped explicitly while SBRI_MAX_SUBSTEPS are enough at rest: nothing else follows its energy
 * for less. A strained body is in trouble when it needs more than half as many again as at rest, and more
 * than these numbers. */
enum { SBRI_TROUBLED_SUBSTEPS = 192, SBRI_TROUBLED_SOLID_SUBSTEPS = 256 };

/* For so many ticks after the last sign of trouble the recovering scheme goes on. */
enum { SBRI_RECOVERING_TICKS = 10 };

/* Whether the island, at rest, is one to step explicitly. */
bool sbri_router_begins_explicit(const sbri_island *island);

/* The scheme of an island that recovers so. */
const sbri_scheme *sbri_router_scheme(const sbri_island *island, const sbri_recovery *recovery);

/* The scheme of the coming tick. Trouble is: elements so strained that explicit steps would be too many, a
 * tetrahedron inside out, or points that move by more than a cell in a substep against their body. Ticks of
 * recovery count down from there, or from where the caller has set them; they are counted for schemes that
 * were asked for too, which stay. */
const sbri_scheme *sbri_router_choose(const sbri_island_tick *tick, sbri_recovery *recovery);

#endif
