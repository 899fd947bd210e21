/* Merges sections that are too small for bodies of their own. */
#ifndef SBFI_SECTION_MERGE_H
#define SBFI_SECTION_MERGE_H

#include "base/diagnostic.h"
#include "build/geometry/topology.h"
#include "build/sections/skin_union.h"

/* A sliver is a part with fewer than four polygons, or with an area below a two-hundredth of its border's
 * squared length: a slice of a limb an eighth of its radius long. It joins the adjacent part of the nearest
 * ancestor bone, else the part with the longest common border, else the nearest ancestor, and is reported;
 * the farthest from the root goes first. An isolated part without ancestor stays.
 *
 * Changes the `labels` (polygons) of sbfi_section_labels_make. `owners` (bones) receives for each bone the
 * bone of the section that moves its vertices: its own, or the one that absorbed it; for a bone that
 * dominates nowhere the nearest ancestor with a section, else the first section; SBFI_NO_INDEX if there
 * are no sections. False if memory runs out. */
bool sbfi_sections_merge(uint32_t *labels, uint32_t *owners, const sbfi_skin_union *skin,
    const sbfi_topology *t, const sbf_asset *asset, sbfi_reporter *reporter, sbfi_arena *scratch);

#endif
