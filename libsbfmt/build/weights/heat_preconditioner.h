/* An approximate inverse of L + H, for conjugate gradients: L a surface's Laplacian, H a diagonal. */
#ifndef SBFI_HEAT_PRECONDITIONER_H
#define SBFI_HEAT_PRECONDITIONER_H

#include "build/weights/surface_laplacian.h"

/* So many right sides are solved together, one for each bone. */
enum { SBFI_HEAT_LANES = 8 };
typedef float sbfi_heat_lanes[SBFI_HEAT_LANES];

/* (D - U^T) D^-1 (D - U), with U what stands above the diagonal in L. D is chosen so that the sum of each row
 * is nearly that of L + H (modified incomplete factorisation, Gustafsson 1978): smooth errors go as quickly
 * as rough ones. */
typedef struct sbfi_heat_preconditioner {
  const sbfi_surface_laplacian *laplacian; /* borrowed */
  uint32_t count;
  float *inverse;   /* (count) of D */
  uint32_t *middle; /* (count) of each row the first entry behind the diagonal */
} sbfi_heat_preconditioner;

/* `heat` (laplacian rows) is above 0. False where memory runs out. */
bool sbfi_heat_preconditioner_make(sbfi_heat_preconditioner *preconditioner,
    const sbfi_surface_laplacian *laplacian, const double *heat, uint32_t count, sbfi_arena *arena);

/* Fills `z` (count) from `r` (count). */
void sbfi_heat_precondition(
    const sbfi_heat_preconditioner *preconditioner, sbfi_heat_lanes *r, sbfi_heat_lanes *z);

#endif
