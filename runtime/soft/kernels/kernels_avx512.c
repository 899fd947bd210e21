/* Compiled for AVX-512 where the compiler supports it; see runtime/CMakeLists.txt. It has eight lanes as with
 * AVX2, one block, but thirty-two registers, which the loops over tetrahedra fill. */
#define SBRI_KERNELS sbri_kernels_avx512
#include "model/kernels.h"
#ifdef SBRI_HAS_X86_64
#include "soft/kernels/kernel_table.h"
#endif
