/* Compiled for AVX-512 where the compiler knows it; see runtime/CMakeLists.txt. Lanes are eight as with AVX2,
 * a block's worth; what it has more of is registers: thirty-two, which the loops over tetrahedra fill. */
#define SBRI_KERNELS sbri_kernels_avx512
#include "model/kernels.h"
#ifdef SBRI_HAS_X86_64
#include "kernels/kernel_table.h"
#endif
