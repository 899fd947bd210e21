/* Queries of a ground, built-in or the host's. */
#ifndef SBRI_GROUND_H
#define SBRI_GROUND_H

#include "sbrun/sbrun.h"

/* Height in m at (x, z), world space; `normal` (may be NULL) receives the unit normal. */
double sbri_ground_height(const sbr_ground *ground, double x, double z, sbf_vec3 *normal);

/* Whether it is one of the built-in grounds of sbrun.h, which never change. */
bool sbri_ground_is_fixed(const sbr_ground *ground);
/* Whether it is a built-in flat ground; `height` receives its height. */
bool sbri_ground_is_flat(const sbr_ground *ground, double *height);
/* Whether it is a built-in ascending or descending stair. */
bool sbri_ground_is_stairs(const sbr_ground *ground, double *rise, double *run);

#endif
