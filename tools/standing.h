/* How high a character must be set for none of it to begin below the ground. */
#ifndef STANDING_H
#define STANDING_H

#include "sbfmt/model.h"
#include "sbrun/sbrun.h"

/* m, >= 0, for a character at the world's origin. Only bodies that nothing holds are lifted: bones stand
 * where the file puts them, and what is pinned to the world hangs there. */
double standing_lift(const sbf_asset *asset, const sbr_ground *ground);

#endif
