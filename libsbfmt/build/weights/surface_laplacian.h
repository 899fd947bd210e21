/* Cotangent Laplacian of a mesh's surface, with shells tied together where they are nearest. */
#ifndef SBFI_SURFACE_LAPLACIAN_H
#define SBFI_SURFACE_LAPLACIAN_H

#include "build/weights/weight_mesh.h"

/* Symmetric; row i has off-diagonal entries begins[i] ... begins[i + 1], ascending by column. Entries are
 * the positive weights w_ij of the form sum w_ij (x_i - x_j)^2 / 2. */
typedef struct sbfi_surface_laplacian {
  uint32_t *begins;  /* (site_count + 1) */
  uint32_t *columns; /* (begins[site_count]) */
  double *values;    /* (begins[site_count]) */
  double *diagonal;  /* (site_count) row sums */
} sbfi_surface_laplacian;

/* False if memory runs out. */
bool sbfi_surface_laplacian_make(
    sbfi_surface_laplacian *laplacian, const sbfi_weight_mesh *mesh, sbfi_arena *arena);

#endif
