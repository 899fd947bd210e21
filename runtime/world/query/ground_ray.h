/* Intersection of a ray with a ground of heights. */
#ifndef SBRI_GROUND_RAY_H
#define SBRI_GROUND_RAY_H

#include "sbrun/sbrun.h"

/* Finds the first point at which the ray `from` + t `along` (m) goes below the ground: `fraction` is t, 0 to
 * 1, with the normal there. Returns false if there is none or the ray begins below. The ground is sampled
 * every 5 cm (a 4096th of a longer ray) and linear between samples; a narrower ridge may be missed. */
bool sbri_ground_ray(
    const sbr_ground *ground, sbr_double3 from, sbf_vec3 along, double *fraction, sbf_vec3 *normal);

#endif
