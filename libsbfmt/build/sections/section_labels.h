/* Which bone each polygon of a skin belongs to. */
#ifndef SBFI_SECTION_LABELS_H
#define SBFI_SECTION_LABELS_H

#include "build/geometry/topology.h"
#include "build/sections/skin_union.h"

/* Gives each polygon the bone that holds most of its corners, and then takes the ragged out of the borders: a
 * polygon goes over to a neighbour's bone where that shortens the border by more than the weights it loses,
 * counted in lengths of its own outline. Where weights leave it open, borders so run along the shortest line,
 * which on a modelled limb is an edge loop. (Descent one polygon at a time on a Potts energy: Besag, On the
 * statistical analysis of dirty pictures, 1986.) Then every bone keeps its largest piece and those of a tenth
 * of it and more; smaller ones go to the neighbour they share most border with. Pieces that touch no other
 * bone's stay.
 *
 * `labels` is (polygons): a bone, or SBFI_NO_INDEX where no corner has weights. `t` is the union's topology.
 * False where memory runs out. */
bool sbfi_section_labels_make(uint32_t *labels, const sbfi_skin_union *skin, const sbfi_topology *t,
    uint32_t bone_count, sbfi_arena *scratch);

#endif
