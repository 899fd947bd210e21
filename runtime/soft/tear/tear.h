/* Effects of tears: split points, and skins that open there. */
#ifndef SBRI_TEAR_H
#define SBRI_TEAR_H

#include "state/state.h"

/* ---- soft/tear/split.c ---- */

/* Resets to no split points. */
void sbri_reset_splits(sbri_character *c);
/* Splits points next to elements that tore in this tick; returns the number of splits that failed for lack of
 * slots. */
uint32_t sbri_island_split(sbri_character *c, uint32_t island);

/* ---- soft/tear/torn_skin.c ---- */

void sbri_restore_skins(sbri_character *c);
/* Call after elements of the island have torn and its points have split. Skins belong to several islands: not
 * for tasks. */
void sbri_skins_follow(sbri_character *c, uint32_t island);

#endif
