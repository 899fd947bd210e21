/* Length of a set of points. */
#ifndef SBFI_EXTENT_H
#define SBFI_EXTENT_H

#include "mechanics/vector.h"
#include "sbfmt/model.h"

/* Length of a set of points: the diagonal of the bounding box. */
static inline double sbfi_extent(sbf_vec3_list points) {
  sbfi_d3 low = {0, 0, 0}, high = {0, 0, 0};
  for (uint32_t i = 0; i < points.count; i++) {
    sbfi_d3 at = sbfi_d3_of(points.at[i]);
    low = i ? (sbfi_d3){fmin(low.x, at.x), fmin(low.y, at.y), fmin(low.z, at.z)} : at;
    high = i ? (sbfi_d3){fmax(high.x, at.x), fmax(high.y, at.y), fmax(high.z, at.z)} : at;
  }
  return sbfi_d3_length(sbfi_d3_sub(high, low));
}

#endif
