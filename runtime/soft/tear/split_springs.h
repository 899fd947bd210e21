/* Splitting of points in spring networks. */
#ifndef SBRI_SPLIT_SPRINGS_H
#define SBRI_SPLIT_SPRINGS_H

#include "state/state.h"

/* Splits the points of an island whose springs may tear; returns the number of splits that failed for lack of
 * slots. */
uint32_t sbri_island_split_springs(sbri_character *c, uint32_t island);

#endif
