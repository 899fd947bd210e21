/* Points of networks of springs that split. */
#ifndef SBRI_SPLIT_SPRINGS_H
#define SBRI_SPLIT_SPRINGS_H

#include "world/state.h"

/* Splits the points of an island that frays; returns how many it had no room for. */
uint32_t sbri_island_split_springs(sbri_character *c, uint32_t island);

#endif
