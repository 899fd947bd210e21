/* Scans whole lists at memory bandwidth, because they run on every load, also of a mapped file. */
#ifndef SBFI_BULK_CHECK_H
#define SBFI_BULK_CHECK_H

#include "sbfmt/base.h"

/* Index of the first number outside [low, high] or NaN; `count` if there is none. With finite bounds all
 * accepted numbers are finite. */
size_t sbfi_find_f32_outside(const float *at, size_t count, float low, float high);
size_t sbfi_find_u32_outside(const uint32_t *at, size_t count, uint32_t low, uint32_t high);

/* Index of the first tetrahedron whose det(p1-p0, p2-p0, p3-p0) is not positive, or `count`; its indices
 * must be below the positions' count. */
size_t sbfi_find_not_positive(const sbf_uint4 *tetrahedra, size_t count, const sbf_vec3 *positions);

#endif
