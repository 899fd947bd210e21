/* Builds the coarsest level of a body: it moves rigidly. */
#ifndef SBFI_JIGGLE_LEVEL_H
#define SBFI_JIGGLE_LEVEL_H

#include "sbfmt/asset.h"

/* Fills `*level` for a body with surface points: four points around it, with which every vertex rotates
 * and translates, and a follower of `frequency` Hz (0: the format's default) with the body's damping
 * ratio. `asset` owns the lists; false if memory runs out. */
bool sbfi_jiggle_level_make(
    sbf_level *level, const sbf_soft_body *body, double frequency, int32_t derivation, sbf_asset *asset);

#endif
