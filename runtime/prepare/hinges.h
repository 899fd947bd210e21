/* The hinges by which a sheet bends: one at each edge between two triangles, with the bending stiffness of a
 * plate. */
#ifndef SBRI_HINGES_H
#define SBRI_HINGES_H

#include "prepare/prepare.h"
#include "sbfmt/mechanics.h"

/* Hinges of the body's surface at rest, none if it is no sheet; allocated in `keep`. Returns false if memory
 * runs out. */
bool sbri_hinges_find(const sbri_island *island, const sbri_body *body, sbfi_arena *keep, sbfi_arena *scratch,
    const sbri_hinge **hinges, uint32_t *hinge_count);

/* Adds hinges to a network over the island's slots, linearised at rest. Includes those of a sheet with
 * flexion springs, which do not resist small bending of a flat sheet. Returns false if memory runs out. */
bool sbri_hinges_add(
    const sbri_island *island, const sbri_body *body, sbfi_arena *scratch, sbf_spring_network *network);

#endif
