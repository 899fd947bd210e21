/* Which skins have sections that somebody made, and which only wear something.
 *
 * A body on a bone may be a section of the character, or a hat, a belly, an eye, a cape beside it. Sections
 * lie along the skin, and all of them together along most of it; what is worn touches a part of it. */
#ifndef SBFI_AUTHORED_SECTIONS_H
#define SBFI_AUTHORED_SECTIONS_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* Fills sectioned (render meshes): 1 where at least half of a skin's vertices lie at the surface of a body on
 * the bone that holds most of them, or on its nearest ancestor with a body, and such vertices are at least a
 * fifth of all that hang on the skeleton, as on a skin divided by materials; 0 for the others and for meshes
 * without skin. `body_count`: the first so many bodies are looked at. False where memory runs out. */
bool sbfi_authored_sections_find(
    const sbf_asset *asset, uint32_t body_count, uint8_t *sectioned, sbfi_arena *scratch);

#endif
