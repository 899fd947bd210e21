/* The pins of a level, from what the body says about its source points. */
#ifndef SBFI_LEVEL_PINS_H
#define SBFI_LEVEL_PINS_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Gives the level, whose positions are in place, its pin sets, marked with `derivation`: those it has already
 * stay first; then the body's sets, at the level's points; then, where `interior_count` is not 0, "interior":
 * those points of the level, at their places in the frame of the body's bone; then a set for
 * each attachment: the points listed, or every point inside the rigid body's hull that no set before holds.
 * `asset` has the bones and the rigid bodies. False where memory runs out. */
bool sbfi_level_pins_make(sbf_level *level, const sbf_soft_body *body, int32_t derivation, sbf_asset *asset,
    const uint32_t *interior, uint32_t interior_count, sbfi_arena *scratch);

/* A set that binds the points to the bone, each where it is at rest, named `set_name`. False where memory
 * runs out. */
bool sbfi_bone_pins_make(sbf_pin_set *to, const char *set_name, const sbf_level *level, int32_t bone,
    const uint32_t *points, uint32_t count, sbf_asset *asset);

#endif
