/* Whether a thing that somebody animates can be as large as it is said to be. */
#ifndef SBFI_PLAUSIBLE_SIZE_H
#define SBFI_PLAUSIBLE_SIZE_H

#include "sbfmt/mechanics.h"

/* The greatest side of the box around everything, m; 0 where there is nothing. */
double sbfi_asset_extent(const sbf_asset *asset);

/* By what a length has to be multiplied to be between 5 mm and 30 m: 1 where it is, else the first of 0.01
 * (it was in centimetres), 0.001, 1e-4 ..., or of 100, 1000 ..., with which it is. 1 for 0 and what is not
 * finite. */
double sbfi_plausible_scale(double size_m);

#endif
