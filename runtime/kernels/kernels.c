#include "kernels/kernels.h"

const sbri_kernels *sbri_kernels_choose(void) {
#ifdef SBRI_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) return &sbri_kernels_avx2;
#endif
  return &sbri_kernels_plain;
}

uint32_t sbr_lanes(void) {
  return sbri_kernels_choose()->lanes;
}
