/* Pins of a level, from those of the body's source points. */
#ifndef SBFI_LEVEL_PINS_H
#define SBFI_LEVEL_PINS_H

#include "base/memory.h"
#include "sbfmt/asset.h"

/* Adds pin sets, marked with `derivation`, to a level with positions. Order: existing sets; the body's
 * sets, mapped to the level; if `interior_count` is not 0, "interior": these points of the level, at their
 * positions in the frame of the body's bone; a set for each attachment: the listed points, or every point
 * inside the rigid body's hull that no earlier set pins. `asset` has the bones and the rigid bodies. False
 * if memory runs out. */
bool sbfi_level_pins_make(sbf_level *level, const sbf_soft_body *body, int32_t derivation, sbf_asset *asset,
    const uint32_t *interior, uint32_t interior_count, sbfi_arena *scratch);

/* Creates a set named `set_name` that pins the points to the bone at their rest positions. False if memory
 * runs out. */
bool sbfi_bone_pins_make(sbf_pin_set *to, const char *set_name, const sbf_level *level, int32_t bone,
    const uint32_t *points, uint32_t count, sbf_asset *asset);

#endif
