/* One kernel that uses every operation of math/wide.h. Results are twice
 * TWIN_POINTS; it is compiled twice: at the machine's width (test_wide.c)
 * and with one lane (wide_twin.c). */
#ifndef TEST_WIDE_TWIN_H
#define TEST_WIDE_TWIN_H

#include "math/wide.h"

enum { TWIN_POINTS = 64 };

static inline void twin_kernel(const sbri_point *points, const uint32_t *indices, sbri_point *results) {
  for (int block = 0; block < TWIN_POINTS; block += SBRI_BLOCK)
    for (int lane = block; lane < block + SBRI_BLOCK; lane += SBRI_LANES) {
      sbri_wide3 a = sbri_wide_load_points(points + lane), b = sbri_wide_gather(points, indices + lane), r;
      sbri_wide dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
      sbri_wide length = sbri_wide_sqrt(dx * dx + dy * dy + dz * dz + sbri_wide_all(1e-20f));
      r.x = a.x + dx / length;
      r.y = sbri_wide_max(a.y, sbri_wide_min(b.y, b.x));
      r.z = sbri_wide_select((a.z < b.z) & (a.x > b.y), a.z * dz, b.z - dy);
      if (sbri_mask_any(r.z > sbri_wide_all(1e6f))) r.z = sbri_wide_all(0);
      sbri_wide_store_points(results + lane, r);
      sbri_wide4 q = sbri_wide_gather4(points, indices + lane);
      const float *numbers = &points[0].x;
      q.y = q.y + sbri_wide_gather_floats(numbers, indices + lane);
      uint32_t own[SBRI_BLOCK];
      for (int i = 0; i < SBRI_LANES; i++) own[i] = (uint32_t)(TWIN_POINTS + lane + i);
      sbri_wide_scatter4(results, own, q);
    }
}

void twin_scalar(const sbri_point *points, const uint32_t *indices, sbri_point *results);

#endif
