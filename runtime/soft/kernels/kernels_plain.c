/* Compiled for the instruction set of the whole library. */
#define SBRI_KERNELS sbri_kernels_plain
#include "soft/kernels/kernel_table.h"
