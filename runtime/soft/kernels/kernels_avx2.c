/* Compiled for AVX2 where the compiler knows it; see runtime/CMakeLists.txt. */
#define SBRI_KERNELS sbri_kernels_avx2
#include "model/kernels.h"
#ifdef SBRI_HAS_X86_64
#include "soft/kernels/kernel_table.h"
#endif
