/* Points by which a section carries what lies beyond it. */
#ifndef SBFI_SECTION_FRAME_H
#define SBFI_SECTION_FRAME_H

#include "build/sections/sections.h"
#include "mechanics/vector.h"

enum { SBFI_FRAME_POINTS = 4 };

/* Their mean; the surface's. */
sbfi_d3 sbfi_points_middle(const sbf_vec3_list *points);
sbfi_d3 sbfi_section_middle(const sbf_soft_body *body);

/* Adds to a level of the section points that nothing but bones move, and that no element has:
 *   four that the section's bone holds, corners of a regular tetrahedron around the section's middle, as far
 * from it as the section reaches. A vertex in which it has a share and that lies beyond its surface hangs on
 * them and so moves with the bone as one piece. `*first` receives the place of the first;
 *   of each of the section's mixes one for every bone, held by that bone. Its `points` are filled in.
 * In pin sets "frame", one for each bone. False where memory runs out. */
bool sbfi_section_frame_add(sbf_level *level, sbfi_sections *sections, uint32_t section, int32_t derivation,
    sbf_asset *asset, uint32_t *first, sbfi_arena *scratch);

/* Adds to a level of a body on a bone four points alone, as the first ones above: for what lies within
 * `reach` of the middle. A level of jiggle takes them as its own, others hold them by a pin set "frame". */
bool sbfi_bone_frame_add(sbf_level *level, int32_t bone, sbfi_d3 middle, double reach, int32_t derivation,
    sbf_asset *asset, uint32_t *first);

#endif
