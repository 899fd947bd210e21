/* Polygons over the same points, whatever corner they begin at and whichever way they face. */
#ifndef SBFI_POLYGON_REPEATS_H
#define SBFI_POLYGON_REPEATS_H

#include "base/memory.h"
#include "sbfmt/model.h"

/* For each polygon the first one with the same points, itself where there is none before it: `firsts` is
 * (polygon_count). False where memory runs out. */
bool sbfi_polygon_repeats_find(const sbf_polygon_mesh *mesh, uint32_t *firsts, sbfi_arena *scratch);

#endif
