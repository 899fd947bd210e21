#define SBRI_KERNELS sbri_kernels_plain
#include "core/kernel_table.h"
