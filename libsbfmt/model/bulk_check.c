#include "model/bulk_check.h"

/* A block whose length the compiler knows becomes straight vector code without a branch on the data; only the
 * block with a fault in it, and the rest behind the last whole one, are looked at item by item. */
enum { BLOCK = 512 };

static inline bool f32_outside(float value, float low, float high) {
  return !(value >= low) | !(value <= high);
}

size_t sbfi_find_f32_outside(const float *at, size_t count, float low, float high) {
  size_t done = 0;
  for (; count - done >= BLOCK; done += BLOCK) {
    int outside = 0;
    for (int i = 0; i < BLOCK; i++) outside |= f32_outside(at[done + (size_t)i], low, high);
    if (outside) break;
  }
  while (done < count && !f32_outside(at[done], low, high)) done++;
  return done;
}

size_t sbfi_find_u32_outside(const uint32_t *at, size_t count, uint32_t low, uint32_t high) {
  if (low > high) return 0;
  size_t done = 0;
  uint32_t span = high - low; /* below `low` wraps around to far above it */
  for (; count - done >= BLOCK; done += BLOCK) {
    uint32_t outside = 0;
    for (int i = 0; i < BLOCK; i++) outside |= at[done + (size_t)i] - low > span;
    if (outside) break;
  }
  while (done < count && at[done] - low <= span) done++;
  return done;
}

/* In double: differences of nearby float32 are exact there, so the sign is wrong only for a tetrahedron so
 * flat that nothing could be computed with it. */
static bool is_positive(const sbf_vec3 *p0, const sbf_vec3 *p1, const sbf_vec3 *p2, const sbf_vec3 *p3) {
  double ax = (double)p1->x - p0->x, ay = (double)p1->y - p0->y, az = (double)p1->z - p0->z;
  double bx = (double)p2->x - p0->x, by = (double)p2->y - p0->y, bz = (double)p2->z - p0->z;
  double cx = (double)p3->x - p0->x, cy = (double)p3->y - p0->y, cz = (double)p3->z - p0->z;
  return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx) > 0;
}

size_t sbfi_find_not_positive(const sbf_uint4 *tetrahedra, size_t count, const sbf_vec3 *positions) {
  size_t i = 0;
  for (; i < count; i++) {
    const uint32_t *p = tetrahedra[i].at;
    if (!is_positive(&positions[p[0]], &positions[p[1]], &positions[p[2]], &positions[p[3]])) break;
  }
  return i;
}
