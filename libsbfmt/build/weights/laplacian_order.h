/* Orders the rows of a Laplacian so that neighbours are close to each other in memory. */
#ifndef SBFI_LAPLACIAN_ORDER_H
#define SBFI_LAPLACIAN_ORDER_H

#include "build/weights/surface_laplacian.h"

/* Reorders the rows and columns of `laplacian` (count) from the order of sites to breadth first from a
 * corner of each connected part (Cuthill and McKee 1969). `site_of_row` (count) receives the order. Then
 * memory access is nearly sequential, and an incomplete factorization is as good for shuffled meshes as
 * for ordered ones. False if memory runs out. */
bool sbfi_laplacian_reorder(
    sbfi_surface_laplacian *laplacian, uint32_t count, uint32_t *site_of_row, sbfi_arena *arena);

#endif
