/* Distinguishes skins with authored sections from skins with accessories.
 *
 * A body on a bone may be a section of the character, or an accessory such as a hat, a belly, an eye, a
 * cape. Sections coincide with the skin and together cover most of it; accessories touch only a part. */
#ifndef SBFI_AUTHORED_SECTIONS_H
#define SBFI_AUTHORED_SECTIONS_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* Fills sectioned (render meshes): 1 if at least half of a skin's vertices are at the surface of a body on
 * the bone of their greatest weight, or on its nearest ancestor with a body, and such vertices are at
 * least a fifth of all vertices of the skeleton, as on a skin split by materials; 0 for others and for
 * meshes without skin. Considers the first `body_count` bodies. False if memory runs out. */
bool sbfi_authored_sections_find(
    const sbf_asset *asset, uint32_t body_count, uint8_t *sectioned, sbfi_arena *scratch);

#endif
