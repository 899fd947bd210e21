/* Height to raise a character so that nothing of it starts below the ground. */
#ifndef STANDING_H
#define STANDING_H

#include "sbfmt/model.h"
#include "sbrun/sbrun.h"

/* m, >= 0, for a character at the world's origin. Only considers bodies without pins: bones keep the
 * file's positions, and so do points pinned to the world. */
double standing_lift(const sbf_asset *asset, const sbr_ground *ground);

#endif
