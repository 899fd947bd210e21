/* Inner loops, compiled for each supported instruction set. All give the same bits: lanes do not mix, sums
 * use a fixed tree, and operations are not contracted. */
#ifndef SBRI_KERNELS_H
#define SBRI_KERNELS_H

#include "model/island_tick.h"
#include "sbrun/sbrun.h"

typedef struct sbri_kernels {
  sbr_instructions instructions;
  uint32_t lanes; /* SIMD width */
  void (*vertices)(const sbri_skin *skin, const sbri_point *points, sbri_point *vertices);
  void (*faces)(const sbri_skin *skin, const sbri_point *vertices, sbri_point *faces);
  void (*tangents)(const sbri_skin *skin, const sbri_point *vertices, sbri_point *faces);
  void (*sums)(const sbri_sum_table *table, const sbri_point *faces, sbri_point *sums);
  void (*normals)(const sbri_sum_table *table, const sbri_point *faces, sbri_point *normals);
  /* One control tick of an island, for each scheme with SIMD loops. */
  void (*symplectic_tick)(const sbri_island_tick *tick);
  void (*explicit_euler_tick)(const sbri_island_tick *tick);
  void (*heun_tick)(const sbri_island_tick *tick);
  void (*position_based_tick)(const sbri_island_tick *tick);
  void (*block_descent_tick)(const sbri_island_tick *tick);
} sbri_kernels;

extern const sbri_kernels sbri_kernels_scalar; /* one lane */
extern const sbri_kernels
    sbri_kernels_plain; /* the compiler's default instruction set; may have one lane too */
#if defined(__x86_64__) && defined(__GNUC__)
#define SBRI_HAS_X86_64 1
extern const sbri_kernels sbri_kernels_avx2, sbri_kernels_avx512; /* for processors with these instructions */
#endif

/* Kernels for the given instructions, or the fastest that this machine can run; NULL: it cannot run them. */
const sbri_kernels *sbri_kernels_of(sbr_instructions instructions);

#endif
