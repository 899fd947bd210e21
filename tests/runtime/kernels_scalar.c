#define SBRI_WIDE_SCALAR
#include "kernels_scalar.h"

#define SBRI_KERNELS kernels_scalar
#include "kernels/kernel_table.h"
