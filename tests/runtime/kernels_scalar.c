#define SBRI_WIDE_SCALAR
#include "kernels_scalar.h"

#define SBRI_KERNELS kernels_scalar
#include "core/kernel_table.h"
