#include "model/bulk_check.h"

/* Blocks of a constant length compile to vector code without data-dependent branches: long blocks, then
 * short ones for the rest. Only a short block with a fault, and the items after the last block, are
 * scanned one by one. If the compiler supports it, the code exists twice: for all processors, and for
 * those with registers of twice the width. */
enum { LONG = 512, SHORT = 32 };

#if defined(__x86_64__) && defined(__GNUC__)
#define INTO_BOTH static inline __attribute__((always_inline))
#define WIDER __attribute__((target("avx2")))
#else
#define INTO_BOTH static inline
#endif

/* Prefetches a page ahead, because processors prefetch within a page only. Uses integer arithmetic,
 * because the address may be out of bounds. */
INTO_BOTH void announce(const void *at, size_t item_count) {
#ifdef __GNUC__
  for (size_t i = 0; i < item_count; i += 16)
    __builtin_prefetch((const void *)((uintptr_t)at + 4096 + 4 * i));
#else
  (void)at, (void)item_count;
#endif
}

INTO_BOTH bool f32_outside(float value, float low, float high) {
  return !(value >= low) | !(value <= high);
}

/* Number of leading items in blocks of `size` without a fault. */
INTO_BOTH size_t pass_f32(const float *at, size_t count, float low, float high, size_t size) {
  size_t done = 0;
  for (; count - done >= size; done += size) {
    int outside = 0;
    if (size == LONG) announce(at + done, size);
    for (size_t i = 0; i < size; i++) outside |= f32_outside(at[done + i], low, high);
    if (outside) break;
  }
  return done;
}

INTO_BOTH size_t find_f32(const float *at, size_t count, float low, float high) {
  if (count == 0) return 0; /* then the list may be NULL */
  size_t done = pass_f32(at, count, low, high, LONG);
  done += pass_f32(at + done, count - done, low, high, SHORT);
  while (done < count && !f32_outside(at[done], low, high)) done++;
  return done;
}

/* `span` is the length of the range: an item below the range wraps around to a large value. */
INTO_BOTH size_t pass_u32(const uint32_t *at, size_t count, uint32_t low, uint32_t span, size_t size) {
  size_t done = 0;
  for (; count - done >= size; done += size) {
    uint32_t outside = 0;
    if (size == LONG) announce(at + done, size);
    for (size_t i = 0; i < size; i++) outside |= at[done + i] - low > span;
    if (outside) break;
  }
  return done;
}

INTO_BOTH size_t find_u32(const uint32_t *at, size_t count, uint32_t low, uint32_t span) {
  if (count == 0) return 0;
  size_t done = pass_u32(at, count, low, span, LONG);
  done += pass_u32(at + done, count - done, low, span, SHORT);
  while (done < count && at[done] - low <= span) done++;
  return done;
}

#ifdef WIDER
WIDER static size_t find_f32_wider(const float *at, size_t count, float low, float high) {
  return find_f32(at, count, low, high);
}
WIDER static size_t find_u32_wider(const uint32_t *at, size_t count, uint32_t low, uint32_t span) {
  return find_u32(at, count, low, span);
}
#endif

size_t sbfi_find_f32_outside(const float *at, size_t count, float low, float high) {
#ifdef WIDER
  if (__builtin_cpu_supports("avx2")) return find_f32_wider(at, count, low, high);
#endif
  return find_f32(at, count, low, high);
}

size_t sbfi_find_u32_outside(const uint32_t *at, size_t count, uint32_t low, uint32_t high) {
  if (low > high) return 0;
#ifdef WIDER
  if (__builtin_cpu_supports("avx2")) return find_u32_wider(at, count, low, high - low);
#endif
  return find_u32(at, count, low, high - low);
}

/* In double, where differences of nearby float32 are exact: the sign is wrong only for a tetrahedron too
 * flat for any computation. */
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
