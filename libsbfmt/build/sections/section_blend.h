/* Blends that bend well. */
#ifndef SBFI_SECTION_BLEND_H
#define SBFI_SECTION_BLEND_H

#include "build/geometry/topology.h"
#include "build/sections/skin_union.h"

/* Smooths the weights of the union's points that bones marked in `soft` (bones; NULL: all) hold, where a skin
 * would tear: bent by 60 degrees at any one joint,
 * about any axis of the bone's frame and either way, no triangle (of polygons as fans from their first
 * corner) shall be stretched to more than twice its area, nor be turned over where those of `authored`, the
 * same points as their skins hold them, do not turn it. Where one is, the weights of its corners are drawn
 * towards their mean, which leaves each point's sum as it is, and so on over its neighbours until all hold: a
 * step in the weights becomes a slope about as long as the limb is thick. Elsewhere the weights stay as they
 * were.
 * `*left` receives how many triangles are above that at the end (none but on degenerate skins).
 * Points marked in `fixed` (points; NULL: none) keep theirs, but for what they share among themselves, as
 * long as the rest can give way. `t` is the union's topology. False where memory runs out. */
bool sbfi_section_blend_smooth(sbfi_skin_union *skin, const sbfi_skin_union *authored, const sbfi_topology *t,
    const sbf_asset *asset, const uint8_t *soft, const uint8_t *fixed, uint32_t *left, sbfi_arena *arena);

#endif
