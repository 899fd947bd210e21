/* Frame points, which embed vertices outside a section so that it can move them. */
#ifndef SBFI_SECTION_FRAME_H
#define SBFI_SECTION_FRAME_H

#include "build/sections/sections.h"
#include "mechanics/vector.h"

enum { SBFI_FRAME_POINTS = 4 };

/* Mean of the points; centre of a surface. */
sbfi_d3 sbfi_points_middle(const sbf_vec3_list *points);
sbfi_d3 sbfi_section_middle(const sbf_soft_body *body);

/* Adds kinematic points without elements to a level of the section. Four of them are pinned to the
 * section's bone: corners of a regular tetrahedron around the section's centre, sized by the section's
 * reach. A vertex outside the surface that is partly in the section is embedded in them and moves rigidly
 * with the bone. `*first` receives the index of the first. Each of the section's mixes gets one point per
 * bone, pinned to that bone; fills their `points`. Adds pin sets "frame", one per bone. False if memory
 * runs out. */
bool sbfi_section_frame_add(sbf_level *level, sbfi_sections *sections, uint32_t section, int32_t derivation,
    sbf_asset *asset, uint32_t *first, sbfi_arena *scratch);

/* Adds only the four points, for a body on a bone: for positions within `reach` of the centre. A jiggle
 * level uses them as its own, others get a pin set "frame". */
bool sbfi_bone_frame_add(sbf_level *level, int32_t bone, sbfi_d3 middle, double reach, int32_t derivation,
    sbf_asset *asset, uint32_t *first);

#endif
