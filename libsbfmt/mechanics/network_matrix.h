/* Second derivatives of a network's energy as a sparse matrix. Rows of pinned points are 0. */
#ifndef SBFI_NETWORK_MATRIX_H
#define SBFI_NETWORK_MATRIX_H

#include "mechanics/block_matrix.h"
#include "mechanics/neo_hookean.h"
#include "sbfmt/mechanics.h"

typedef struct sbfi_network_matrix {
  const sbf_spring_network *network;
  sbfi_tetrahedron *elements; /* (tetrahedron_count), volume 0 if degenerate */
  double *rest_lengths;       /* (spring_count) m */
  uint32_t *block_indices; /* (tetrahedron_count x 16 + spring_count x 4) indices of blocks in the matrix */
  sbfi_block_matrix matrix;
} sbfi_network_matrix;

/* Creates the pattern and the constant data; `rest_lengths` (spring_count), NULL: the distances at rest.
 * Allocates from `arena`. The network must outlive the result. False if memory runs out. */
bool sbfi_network_matrix_make(sbfi_network_matrix *made, const sbf_spring_network *network,
    const float *rest_lengths, sbfi_arena *arena);

/* Updates the network's moduli. */
void sbfi_network_matrix_refresh(sbfi_network_matrix *m);

/* Fills the matrix at positions (3 x point_count) and prepares the sweep. Drops the negative lateral
 * stiffness of compressed springs. */
void sbfi_network_matrix_fill(sbfi_network_matrix *m, const double *positions);

#endif
