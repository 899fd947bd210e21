/* Centre and area vector of a polygon. */
#ifndef SBFI_POLYGON_H
#define SBFI_POLYGON_H

#include "mechanics/vector.h"

/* Mean of the corners; `size` is at least 3. */
static inline sbfi_d3 sbfi_polygon_middle(const sbf_vec3 *positions, const uint32_t *corners, uint32_t size) {
  sbfi_d3 sum = {0, 0, 0};
  for (uint32_t k = 0; k < size; k++) sum = sbfi_d3_add(sum, sbfi_d3_of(positions[corners[k]]));
  return sbfi_d3_scale(sum, 1.0 / size);
}

/* Area vector: half the sum of the cross products around the polygon; its length is the area, its
 * direction the normal. Computed relative to the centre, so that positions far from the origin lose no
 * precision. */
static inline sbfi_d3 sbfi_polygon_area(
    const sbf_vec3 *positions, const uint32_t *corners, uint32_t size, sbfi_d3 middle) {
  sbfi_d3 sum = {0, 0, 0}, last = sbfi_d3_sub(sbfi_d3_of(positions[corners[size - 1]]), middle);
  for (uint32_t k = 0; k < size; k++) {
    sbfi_d3 here = sbfi_d3_sub(sbfi_d3_of(positions[corners[k]]), middle);
    sum = sbfi_d3_add(sum, sbfi_d3_cross(last, here));
    last = here;
  }
  return sbfi_d3_scale(sum, 0.5);
}

#endif
