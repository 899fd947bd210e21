/* Where a ray meets a ground, which is known by its heights alone. */
#ifndef SBRI_GROUND_RAY_H
#define SBRI_GROUND_RAY_H

#include "sbrun/sbrun.h"

/* The first place at which the way `along` (m) from `from` goes below the ground: the share of it, 0 to 1,
 * and the normal there. A way that begins below finds nothing. Between two heights, about 5 cm apart (a
 * 4096th of a longer way), the ground is taken for straight; a narrower ridge may be missed. */
bool sbri_ground_ray(
    const sbr_ground *ground, sbr_double3 from, sbf_vec3 along, double *fraction, sbf_vec3 *normal);

#endif
