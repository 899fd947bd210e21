/* Smooth blends between sections that bend well. */
#ifndef SBFI_SECTION_BLEND_H
#define SBFI_SECTION_BLEND_H

#include "build/geometry/topology.h"
#include "build/sections/skin_union.h"

/* Smooths the union's weights in regions of bones marked in `soft` (bones; NULL: all) where a skin would
 * tear. Requirement: under a bend by 60 degrees at any one joint, about any axis of the bone's frame in both
 * directions, no triangle (polygons are fans from their first corner) stretches to more than twice its area,
 * or flips unless it does with the weights in `authored`. Otherwise the weights of its corners are moved
 * towards their mean, which preserves each point's sum, and so on over its neighbours: a step in the weights
 * becomes a slope about as long as the limb is thick. Other weights do not change. `*left` receives the
 * number of remaining triangles (0 except on degenerate skins), `*checks` (NULL: none) how often triangles of
 * the skin were bent. Points marked in `fixed` (points; NULL: none)
 * keep their weights, except among themselves, as long as others can change. `t` is the union's topology.
 * False if memory runs out. */
bool sbfi_section_blend_smooth(sbfi_skin_union *skin, const sbfi_skin_union *authored, const sbfi_topology *t,
    const sbf_asset *asset, const uint8_t *soft, const uint8_t *fixed, uint32_t *left, uint64_t *checks,
    sbfi_arena *arena);

#endif
