/* Checks the plausibility of a character's size. */
#ifndef SBFI_PLAUSIBLE_SIZE_H
#define SBFI_PLAUSIBLE_SIZE_H

#include "sbfmt/mechanics.h"

/* Longest side of the bounding box of everything, m; 0 if empty. */
double sbfi_asset_extent(const sbf_asset *asset);

/* Factor that brings a length between 5 mm and 30 m: 1 if it is, otherwise the first suitable of 0.01 (it
 * was in centimetres), 0.001, 1e-4 ..., or of 100, 1000 ... Returns 1 for 0 and values that are not
 * finite. */
double sbfi_plausible_scale(double size_m);

#endif
