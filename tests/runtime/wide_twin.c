#define SBRI_WIDE_SCALAR
#include "wide_twin.h"

void twin_scalar(const sbri_point *points, const uint32_t *indices, sbri_point *results) {
  twin_kernel(points, indices, results);
}
