/* Polygons with equal points, independent of the first corner and the orientation. */
#ifndef SBFI_POLYGON_REPEATS_H
#define SBFI_POLYGON_REPEATS_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* First polygon with the same points for each polygon, itself if there is no earlier one: `firsts` is
 * (polygon_count). False if memory runs out. */
bool sbfi_polygon_repeats_find(const sbf_polygon_mesh *mesh, uint32_t *firsts, sbfi_arena *scratch);

#endif
