/* Assigns the polygons of a skin to bones. */
#ifndef SBFI_SECTION_LABELS_H
#define SBFI_SECTION_LABELS_H

#include "build/geometry/topology.h"
#include "build/sections/skin_union.h"

/* Assigns each polygon to the bone of greatest weight over its corners, then smooths the borders: a polygon
 * changes to a neighbour's bone if the border becomes shorter by more than the lost weights, in units of its
 * outline. Where weights are ambiguous, borders become the shortest lines, which on a modelled limb are edge
 * loops. (Descent one polygon at a time on a Potts energy: Besag, On the statistical analysis of dirty
 * pictures, 1986.) Then every bone keeps its largest piece and those of at least a tenth of it; smaller ones
 * join the neighbour with the longest common border. Isolated pieces stay.
 *
 * `labels` is (polygons): a bone, or SBFI_NO_INDEX if no corner has weights. `t` is the union's topology.
 * False if memory runs out. */
bool sbfi_section_labels_make(uint32_t *labels, const sbfi_skin_union *skin, const sbfi_topology *t,
    uint32_t bone_count, sbfi_arena *scratch);

#endif
