/* Springs along the sides of tetrahedra. */
#ifndef SBFI_SPRINGS_SIDES_H
#define SBFI_SPRINGS_SIDES_H

#include "build/springs/springs.h"

/* Each side once, as the walk over the tetrahedra meets it, the lower number first. Memory of `arena`; false
 * where it runs out. */
bool sbfi_springs_sides(
    sbfi_spring_list *springs, const sbf_uint4 *tetrahedra, uint32_t count, sbfi_arena *arena);

#endif
