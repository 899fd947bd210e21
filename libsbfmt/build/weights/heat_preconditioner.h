/* Approximate inverse of L + H for conjugate gradients: L is a surface's Laplacian, H a diagonal. */
#ifndef SBFI_HEAT_PRECONDITIONER_H
#define SBFI_HEAT_PRECONDITIONER_H

#include "build/weights/surface_laplacian.h"

/* Number of right-hand sides, one per bone, that are solved together. */
enum { SBFI_HEAT_LANES = 8 };
typedef float sbfi_heat_lanes[SBFI_HEAT_LANES];

/* (D - U^T) D^-1 (D - U), where U is the part of L above the diagonal. D makes the row sums nearly those
 * of L + H (modified incomplete factorization, Gustafsson 1978), so that smooth errors converge as fast as
 * rough ones. */
typedef struct sbfi_heat_preconditioner {
  const sbfi_surface_laplacian *laplacian; /* borrowed */
  uint32_t count;
  float *inverse;   /* (count) of D */
  uint32_t *middle; /* (count) first entry of each row after the diagonal */
} sbfi_heat_preconditioner;

/* `heat` (laplacian rows) is above 0. False if memory runs out. */
bool sbfi_heat_preconditioner_make(sbfi_heat_preconditioner *preconditioner,
    const sbfi_surface_laplacian *laplacian, const double *heat, uint32_t count, sbfi_arena *arena);

/* Computes `z` (count) from `r` (count). */
void sbfi_heat_precondition(
    const sbfi_heat_preconditioner *preconditioner, sbfi_heat_lanes *r, sbfi_heat_lanes *z);

#endif
