/* One number at a time: what every width has to agree with. */
#define SBRI_WIDE_SCALAR
#define SBRI_KERNELS sbri_kernels_scalar
#include "kernels/kernel_table.h"
