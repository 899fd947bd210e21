/* Rows of a Laplacian in an order in which neighbours lie near each other. */
#ifndef SBFI_LAPLACIAN_ORDER_H
#define SBFI_LAPLACIAN_ORDER_H

#include "build/weights/surface_laplacian.h"

/* Reorders the rows and columns of `laplacian` (count), which arrive in the order of sites, breadth first
 * from a corner of each connected part (Cuthill and McKee 1969). `site_of_row` (count) receives the order.
 * Memory is read nearly in sequence then, and an incomplete factorisation is as good for shuffled meshes as
 * for ordered ones. False where memory runs out. */
bool sbfi_laplacian_reorder(
    sbfi_surface_laplacian *laplacian, uint32_t count, uint32_t *site_of_row, sbfi_arena *arena);

#endif
