/* Time of impact of two fast hulls. */
#ifndef SBRI_HULL_SWEEP_H
#define SBRI_HULL_SWEEP_H

#include "shapes/hull_pair.h"

/* Pose at that fraction of a motion: linear, with a constant rotation of less than half a turn. */
sbri_placed_hull sbri_hull_interpolate(
    const sbri_placed_hull *from, const sbri_placed_hull *to, float fraction);

/* Time of impact: the first fraction of the motions, 0 to 1, at which the distance is at most `near`, to
 * within `near`; above 1 if it never is. */
float sbri_hulls_sweep(const sbri_placed_hull from[2], const sbri_placed_hull to[2], float near);

#endif
