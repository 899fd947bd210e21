/* Selection of the kernels for this machine. */
#include "model/kernels.h"

/* In order of speed, fastest first. */
static const sbri_kernels *const tables[] = {
#ifdef SBRI_HAS_X86_64
    &sbri_kernels_avx512, &sbri_kernels_avx2,
#endif
    &sbri_kernels_plain, &sbri_kernels_scalar};

static bool runs(const sbri_kernels *kernels) {
#ifdef SBRI_HAS_X86_64
  if (kernels == &sbri_kernels_avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  if (kernels == &sbri_kernels_avx2) return __builtin_cpu_supports("avx2");
#endif
  return kernels != NULL;
}

const sbri_kernels *sbri_kernels_of(sbr_instructions instructions) {
  for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
    bool wanted = instructions == SBR_INSTRUCTIONS_AUTOMATIC || tables[i]->instructions == instructions;
    if (wanted && runs(tables[i])) return tables[i];
  }
  return NULL;
}

bool sbr_instructions_are_available(sbr_instructions instructions) {
  return sbri_kernels_of(instructions) != NULL;
}

const char *sbr_instructions_get_name(sbr_instructions instructions) {
  static const char *const names[] = {
      "automatic", "scalar", "sse2", "avx2", "avx512", "neon", "wasm_simd128"};
  size_t index = (size_t)instructions;
  return index < sizeof names / sizeof *names ? names[index] : NULL;
}

uint32_t sbr_get_lane_count(void) {
  return sbri_kernels_of(SBR_INSTRUCTIONS_AUTOMATIC)->lanes;
}
