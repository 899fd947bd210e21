/* Compiled for the instructions that the whole library is. */
#define SBRI_KERNELS sbri_kernels_plain
#include "kernels/kernel_table.h"
