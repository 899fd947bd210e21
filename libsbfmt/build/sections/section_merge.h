/* Sections too small to be bodies of their own join others. */
#ifndef SBFI_SECTION_MERGE_H
#define SBFI_SECTION_MERGE_H

#include "base/diagnostic.h"
#include "build/geometry/topology.h"
#include "build/sections/skin_union.h"

/* A sliver is a part of fewer than four polygons, or one whose area is below a two-hundredth of its border's
 * length squared: a slice of a limb an eighth of its radius long. It joins the part of the nearest bone
 * above that it touches, else the one it shares most border with, else the nearest above, and a note says so;
 * the farthest from the root goes first. What touches nothing and has nothing above stays.
 *
 * `labels` (polygons) as sbfi_section_labels_make gives them are changed. `owners` (bones) receives for each
 * bone the bone of the section that carries its shares: its own, the one that took it in, for a bone that
 * dominates nowhere the nearest above with a section, else the first in the list; SBFI_NO_INDEX where there
 * is no section at all. False where memory runs out. */
bool sbfi_sections_merge(uint32_t *labels, uint32_t *owners, const sbfi_skin_union *skin,
    const sbfi_topology *t, const sbf_asset *asset, sbfi_reporter *reporter, sbfi_arena *scratch);

#endif
