/* The kernels with one lane at a time, as they are on machines without lanes. */
#ifndef TEST_KERNELS_SCALAR_H
#define TEST_KERNELS_SCALAR_H

#include "kernels/kernels.h"

extern const sbri_kernels kernels_scalar;

#endif
