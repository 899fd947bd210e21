/* What has torn: points that split, and skins that open where they do. */
#ifndef SBRI_TEAR_H
#define SBRI_TEAR_H

#include "world/state.h"

/* ---- tear/split.c ---- */

/* Nothing torn, no point split. */
void sbri_reset_splits(sbri_character *c);
/* Splits the points of what has torn in this tick; returns how many it had no room for. */
uint32_t sbri_island_split(sbri_character *c, uint32_t island);

/* ---- tear/torn_skin.c ---- */

void sbri_restore_skins(sbri_character *c);
/* After elements of the island have torn and its points have split. Skins belong to no one island: not for
 * tasks. */
void sbri_skins_follow(sbri_character *c, uint32_t island);

#endif
