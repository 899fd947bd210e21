/* Compiled with -mavx2 where the compiler knows it; see runtime/CMakeLists.txt. */
#define SBRI_KERNELS sbri_kernels_avx2
#include "core/kernels.h"
#ifdef SBRI_HAS_AVX2
#include "core/kernel_table.h"
#endif
