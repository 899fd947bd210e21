/* Eight lanes of single precision on any machine.
 *
 * sbri_wide holds SBRI_LANES floats: 8 with AVX2, 4 with SSE, NEON and WebAssembly, and 1 elsewhere, where it
 * is a plain float. Kernels work on blocks of eight lanes, SBRI_LANES at a time:
 *
 *   for (int lane = 0; lane < 8; lane += SBRI_LANES) { sbri_wide x = sbri_wide_load(block + lane); ... }
 *
 * The operators + - * / work on wides. Lanes never mix, and each operation is the IEEE one, so that all
 * widths give the same bits. There is no reciprocal, no fused multiply-add and no horizontal sum here; sums
 * over lanes use sbri_tree_sum (math/reduce.h).
 *
 * Define SBRI_WIDE_SCALAR to get the one-lane version on any machine. */
#ifndef SBRI_WIDE_H
#define SBRI_WIDE_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "sbfmt/base.h"

enum { SBRI_BLOCK = 8 }; /* lanes of a block */

#if !defined(SBRI_WIDE_SCALAR) && defined(__GNUC__) && defined(__AVX2__)
#define SBRI_LANES 8
#include <immintrin.h>
#elif !defined(SBRI_WIDE_SCALAR) && defined(__GNUC__) && defined(__SSE2__)
#define SBRI_LANES 4
#include <emmintrin.h>
#elif !defined(SBRI_WIDE_SCALAR) && defined(__wasm_simd128__)
#define SBRI_LANES 4
#include <wasm_simd128.h>
#elif !defined(SBRI_WIDE_SCALAR) && defined(__GNUC__) && defined(__ARM_NEON) && defined(__aarch64__)
#define SBRI_LANES 4
#else
#define SBRI_LANES 1
#endif

/* For inner loops with constant arguments, which are to be specialised. */
#if defined(__GNUC__)
#define SBRI_INLINE static inline __attribute__((always_inline))
#else
#define SBRI_INLINE static inline
#endif

/* Four numbers side by side: a point's x, y, z and an unused 0. */
typedef struct sbri_point {
  float x, y, z, w;
} sbri_point;

#if SBRI_LANES > 1
typedef float sbri_wide __attribute__((vector_size(SBRI_LANES * 4)));
typedef int32_t sbri_mask __attribute__((vector_size(SBRI_LANES * 4))); /* all bits of a lane, or none */
typedef float sbri_quad __attribute__((vector_size(16)));
#else
typedef float sbri_wide;
typedef int32_t sbri_mask;
#endif

static inline sbri_wide sbri_wide_load(const float *from) {
  sbri_wide a;
  memcpy(&a, from, sizeof a);
  return a;
}
static inline void sbri_wide_store(float *to, sbri_wide a) {
  memcpy(to, &a, sizeof a);
}
static inline sbri_wide sbri_wide_all(float value) {
#if SBRI_LANES > 1
  return value - (sbri_wide){0};
#else
  return value;
#endif
}

static inline sbri_wide sbri_wide_sqrt(sbri_wide a) {
#if SBRI_LANES == 8
  return (sbri_wide)_mm256_sqrt_ps((__m256)a);
#elif SBRI_LANES == 4 && defined(__SSE2__)
  return (sbri_wide)_mm_sqrt_ps((__m128)a);
#elif SBRI_LANES == 4 && defined(__wasm_simd128__)
  return (sbri_wide)wasm_f32x4_sqrt((v128_t)a);
#elif SBRI_LANES == 4
  return (sbri_wide){sqrtf(a[0]), sqrtf(a[1]), sqrtf(a[2]), sqrtf(a[3])};
#else
  return sqrtf(a);
#endif
}

/* mask ? a : b, lane by lane. Comparisons of wides (a < b) give masks; masks combine with & and |. */
static inline sbri_wide sbri_wide_select(sbri_mask mask, sbri_wide a, sbri_wide b) {
#if SBRI_LANES > 1
  return (sbri_wide)(((sbri_mask)a & mask) | ((sbri_mask)b & ~mask));
#else
  return mask ? a : b;
#endif
}
/* a > b ? a : b and a < b ? a : b: b if either is NaN. */
static inline sbri_wide sbri_wide_max(sbri_wide a, sbri_wide b) {
#if SBRI_LANES == 8
  return (sbri_wide)_mm256_max_ps((__m256)a, (__m256)b);
#elif SBRI_LANES == 4 && defined(__SSE2__)
  return (sbri_wide)_mm_max_ps((__m128)a, (__m128)b);
#elif SBRI_LANES == 4 && defined(__wasm_simd128__)
  return (sbri_wide)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
#else
  return sbri_wide_select(a > b, a, b);
#endif
}
static inline sbri_wide sbri_wide_min(sbri_wide a, sbri_wide b) {
#if SBRI_LANES == 8
  return (sbri_wide)_mm256_min_ps((__m256)a, (__m256)b);
#elif SBRI_LANES == 4 && defined(__SSE2__)
  return (sbri_wide)_mm_min_ps((__m128)a, (__m128)b);
#elif SBRI_LANES == 4 && defined(__wasm_simd128__)
  return (sbri_wide)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
#else
  return sbri_wide_select(a < b, a, b);
#endif
}
static inline bool sbri_mask_any(sbri_mask mask) {
#if SBRI_LANES == 8
  return _mm256_movemask_ps((__m256)mask) != 0;
#elif SBRI_LANES == 4 && defined(__SSE2__)
  return _mm_movemask_ps((__m128)mask) != 0;
#elif SBRI_LANES == 4 && defined(__wasm_simd128__)
  return wasm_v128_any_true((v128_t)mask);
#elif SBRI_LANES == 4
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
#else
  return mask != 0;
#endif
}

typedef struct sbri_wide3 {
  sbri_wide x, y, z;
} sbri_wide3;

/* Points with all four of their numbers. */
typedef struct sbri_wide4 {
  sbri_wide x, y, z, w;
} sbri_wide4;

SBRI_INLINE sbri_wide4 sbri_wide_gather4(const sbri_point *points, const uint32_t *indices) {
  sbri_wide4 r;
#if SBRI_LANES == 8
#define SBRI_PAIR(i)                                                                                         \
  _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(&points[indices[i]].x)),                          \
      _mm_loadu_ps(&points[indices[(i) + 4]].x), 1)
  __m256 a = SBRI_PAIR(0), b = SBRI_PAIR(1), c = SBRI_PAIR(2), d = SBRI_PAIR(3);
#undef SBRI_PAIR
  __m256 ab = _mm256_unpacklo_ps(a, b), cd = _mm256_unpacklo_ps(c, d);
  __m256 ab_high = _mm256_unpackhi_ps(a, b), cd_high = _mm256_unpackhi_ps(c, d);
  r.x = (sbri_wide)_mm256_shuffle_ps(ab, cd, 0x44);
  r.y = (sbri_wide)_mm256_shuffle_ps(ab, cd, 0xee);
  r.z = (sbri_wide)_mm256_shuffle_ps(ab_high, cd_high, 0x44);
  r.w = (sbri_wide)_mm256_shuffle_ps(ab_high, cd_high, 0xee);
#elif SBRI_LANES == 4
  sbri_quad a, b, c, d;
  memcpy(&a, &points[indices[0]], sizeof a);
  memcpy(&b, &points[indices[1]], sizeof b);
  memcpy(&c, &points[indices[2]], sizeof c);
  memcpy(&d, &points[indices[3]], sizeof d);
  sbri_quad ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  sbri_quad ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  sbri_quad cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  r.x = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
  r.y = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  r.z = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  r.w = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
#else
  const sbri_point *p = points + indices[0];
  r.x = p->x, r.y = p->y, r.z = p->z, r.w = p->w;
#endif
  return r;
}

/* The points at `indices[0]` to `indices[SBRI_LANES - 1]`, transposed so that each coordinate fills a wide.
 */
SBRI_INLINE sbri_wide3 sbri_wide_gather(const sbri_point *points, const uint32_t *indices) {
  sbri_wide4 r = sbri_wide_gather4(points, indices);
  return (sbri_wide3){r.x, r.y, r.z};
}

/* Each lane to its own index; if two lanes have the same index the last one is kept. */
SBRI_INLINE void sbri_wide_scatter4(sbri_point *points, const uint32_t *indices, sbri_wide4 v) {
#if SBRI_LANES == 8
  __m256 xy = _mm256_unpacklo_ps((__m256)v.x, (__m256)v.y),
         xy_high = _mm256_unpackhi_ps((__m256)v.x, (__m256)v.y);
  __m256 zw = _mm256_unpacklo_ps((__m256)v.z, (__m256)v.w),
         zw_high = _mm256_unpackhi_ps((__m256)v.z, (__m256)v.w);
  __m256 rows[4] = {_mm256_shuffle_ps(xy, zw, 0x44), _mm256_shuffle_ps(xy, zw, 0xee),
      _mm256_shuffle_ps(xy_high, zw_high, 0x44), _mm256_shuffle_ps(xy_high, zw_high, 0xee)};
#define SBRI_PUT(i) /* unrolled: a loop would keep the rows in memory */                                     \
  _mm_storeu_ps(&points[indices[i]].x, _mm256_castps256_ps128(rows[i]));                                     \
  _mm_storeu_ps(&points[indices[(i) + 4]].x, _mm256_extractf128_ps(rows[i], 1))
  SBRI_PUT(0);
  SBRI_PUT(1);
  SBRI_PUT(2);
  SBRI_PUT(3);
#undef SBRI_PUT
#elif SBRI_LANES == 4
  sbri_quad xy = __builtin_shufflevector(v.x, v.y, 0, 4, 1, 5),
            zw = __builtin_shufflevector(v.z, v.w, 0, 4, 1, 5);
  sbri_quad xy_high = __builtin_shufflevector(v.x, v.y, 2, 6, 3, 7);
  sbri_quad zw_high = __builtin_shufflevector(v.z, v.w, 2, 6, 3, 7);
  sbri_quad rows[4] = {__builtin_shufflevector(xy, zw, 0, 1, 4, 5),
      __builtin_shufflevector(xy, zw, 2, 3, 6, 7), __builtin_shufflevector(xy_high, zw_high, 0, 1, 4, 5),
      __builtin_shufflevector(xy_high, zw_high, 2, 3, 6, 7)};
  for (int i = 0; i < 4; i++) memcpy(&points[indices[i]], &rows[i], sizeof rows[i]);
#else
  points[indices[0]] = (sbri_point){v.x, v.y, v.z, v.w};
#endif
}

/* The numbers at those indices. */
static inline sbri_wide sbri_wide_gather_floats(const float *numbers, const uint32_t *indices) {
  float lanes[SBRI_LANES];
  for (int i = 0; i < SBRI_LANES; i++) lanes[i] = numbers[indices[i]];
  return sbri_wide_load(lanes);
}

/* The SBRI_LANES points from `points` on. */
static inline sbri_wide3 sbri_wide_load_points(const sbri_point *points) {
  static const uint32_t in_order[SBRI_BLOCK] = {0, 1, 2, 3, 4, 5, 6, 7};
  return sbri_wide_gather(points, in_order);
}

/* Stores points; w becomes 0. */
SBRI_INLINE void sbri_wide_store_points(sbri_point *points, sbri_wide3 v) {
#if SBRI_LANES == 8
  __m256 zero = _mm256_setzero_ps();
  __m256 xy = _mm256_unpacklo_ps((__m256)v.x, (__m256)v.y),
         xy_high = _mm256_unpackhi_ps((__m256)v.x, (__m256)v.y);
  __m256 zw = _mm256_unpacklo_ps((__m256)v.z, zero), zw_high = _mm256_unpackhi_ps((__m256)v.z, zero);
  __m256 rows[4] = {_mm256_shuffle_ps(xy, zw, 0x44), _mm256_shuffle_ps(xy, zw, 0xee),
      _mm256_shuffle_ps(xy_high, zw_high, 0x44), _mm256_shuffle_ps(xy_high, zw_high, 0xee)};
#define SBRI_PUT(i)                                                                                          \
  _mm_storeu_ps(&points[i].x, _mm256_castps256_ps128(rows[i]));                                              \
  _mm_storeu_ps(&points[(i) + 4].x, _mm256_extractf128_ps(rows[i], 1))
  SBRI_PUT(0);
  SBRI_PUT(1);
  SBRI_PUT(2);
  SBRI_PUT(3);
#undef SBRI_PUT
#elif SBRI_LANES == 4
  sbri_quad zero = {0};
  sbri_quad xy = __builtin_shufflevector(v.x, v.y, 0, 4, 1, 5),
            zw = __builtin_shufflevector(v.z, zero, 0, 4, 1, 5);
  sbri_quad xy_high = __builtin_shufflevector(v.x, v.y, 2, 6, 3, 7);
  sbri_quad zw_high = __builtin_shufflevector(v.z, zero, 2, 6, 3, 7);
  sbri_quad rows[4] = {__builtin_shufflevector(xy, zw, 0, 1, 4, 5),
      __builtin_shufflevector(xy, zw, 2, 3, 6, 7), __builtin_shufflevector(xy_high, zw_high, 0, 1, 4, 5),
      __builtin_shufflevector(xy_high, zw_high, 2, 3, 6, 7)};
  memcpy(points, rows, sizeof rows);
#else
  *points = (sbri_point){v.x, v.y, v.z, 0};
#endif
}

/* points[indices[i]] += lane i of v, or -= it, one after the other; their fourth number becomes undefined. */
SBRI_INLINE void sbri_wide_scatter_sum(
    sbri_point *points, const uint32_t *indices, sbri_wide3 v, bool subtract) {
#if SBRI_LANES == 8
  __m256 xy = _mm256_unpacklo_ps((__m256)v.x, (__m256)v.y), z = (__m256)v.z;
  __m256 xy_high = _mm256_unpackhi_ps((__m256)v.x, (__m256)v.y);
  __m256 a = _mm256_shuffle_ps(xy, z, 0x04), b = _mm256_shuffle_ps(xy, z, 0x5e);
  __m256 c = _mm256_shuffle_ps(xy_high, z, 0xa4), d = _mm256_shuffle_ps(xy_high, z, 0xfe);
#define SBRI_SUM(i, row)                                                                                     \
  do {                                                                                                       \
    float *to = &points[indices[i]].x;                                                                       \
    __m128 before = _mm_loadu_ps(to);                                                                        \
    _mm_storeu_ps(to, subtract ? _mm_sub_ps(before, row) : _mm_add_ps(before, row));                         \
  } while (0)
  SBRI_SUM(0, _mm256_castps256_ps128(a));
  SBRI_SUM(1, _mm256_castps256_ps128(b));
  SBRI_SUM(2, _mm256_castps256_ps128(c));
  SBRI_SUM(3, _mm256_castps256_ps128(d));
  SBRI_SUM(4, _mm256_extractf128_ps(a, 1));
  SBRI_SUM(5, _mm256_extractf128_ps(b, 1));
  SBRI_SUM(6, _mm256_extractf128_ps(c, 1));
  SBRI_SUM(7, _mm256_extractf128_ps(d, 1));
#undef SBRI_SUM
#elif SBRI_LANES == 4
  sbri_quad xy = __builtin_shufflevector(v.x, v.y, 0, 4, 1, 5), z = v.z;
  sbri_quad xy_high = __builtin_shufflevector(v.x, v.y, 2, 6, 3, 7);
  sbri_quad rows[4] = {__builtin_shufflevector(xy, z, 0, 1, 4, 4), __builtin_shufflevector(xy, z, 2, 3, 5, 5),
      __builtin_shufflevector(xy_high, z, 0, 1, 6, 6), __builtin_shufflevector(xy_high, z, 2, 3, 7, 7)};
#define SBRI_SUM(i)                                                                                          \
  do {                                                                                                       \
    sbri_point *to = &points[indices[i]];                                                                    \
    sbri_quad sum;                                                                                           \
    memcpy(&sum, to, sizeof sum);                                                                            \
    sum = subtract ? sum - rows[i] : sum + rows[i];                                                          \
    memcpy(to, &sum, sizeof sum);                                                                            \
  } while (0)
  SBRI_SUM(0);
  SBRI_SUM(1);
  SBRI_SUM(2);
  SBRI_SUM(3);
#undef SBRI_SUM
#else
  sbri_point *to = &points[indices[0]];
  if (subtract)
    to->x -= v.x, to->y -= v.y, to->z -= v.z;
  else
    to->x += v.x, to->y += v.y, to->z += v.z;
#endif
}
SBRI_INLINE void sbri_wide_scatter_add(sbri_point *points, const uint32_t *indices, sbri_wide3 v) {
  sbri_wide_scatter_sum(points, indices, v, false);
}

#endif
