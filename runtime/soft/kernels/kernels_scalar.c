/* One lane: the reference for all other widths. */
#define SBRI_WIDE_SCALAR
#define SBRI_KERNELS sbri_kernels_scalar
#include "soft/kernels/kernel_table.h"
