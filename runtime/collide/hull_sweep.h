/* When two hulls that go fast come near each other. */
#ifndef SBRI_HULL_SWEEP_H
#define SBRI_HULL_SWEEP_H

#include "collide/hull_pair.h"

/* Where it is at that share of its way, straight and turning evenly by less than half a turn. */
sbri_placed_hull sbri_hull_interpolate(
    const sbri_placed_hull *from, const sbri_placed_hull *to, float fraction);

/* The share of their ways, 0 to 1, at which they are first no further apart than `near`, to within that;
 * above 1 where they never are. */
float sbri_hulls_sweep(const sbri_placed_hull from[2], const sbri_placed_hull to[2], float near);

#endif
