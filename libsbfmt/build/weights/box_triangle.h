/* Overlap test of a box and a triangle. */
#ifndef SBFI_BOX_TRIANGLE_H
#define SBFI_BOX_TRIANGLE_H

#include "mechanics/vector.h"

/* By separating axes (Akenine-Moller 2001); contact counts. */
bool sbfi_box_overlaps_triangle(sbfi_d3 middle, sbfi_d3 half, const sbfi_d3 corners[3]);

#endif
