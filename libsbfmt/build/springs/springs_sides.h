/* Springs along the edges of tetrahedra. */
#ifndef SBFI_SPRINGS_SIDES_H
#define SBFI_SPRINGS_SIDES_H

#include "build/springs/springs.h"

/* Each edge once, in the order of the tetrahedra, with the lower index first. Memory of `arena`; returns
 * false if it runs out. */
bool sbfi_springs_sides(
    sbfi_spring_list *springs, const sbf_uint4 *tetrahedra, uint32_t count, sbfi_arena *arena);

#endif
