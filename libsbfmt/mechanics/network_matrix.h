/* The second derivatives of a network's energy as a sparse matrix. Held points have no part in it: their rows
 * are 0. */
#ifndef SBFI_NETWORK_MATRIX_H
#define SBFI_NETWORK_MATRIX_H

#include "mechanics/block_matrix.h"
#include "mechanics/neo_hookean.h"
#include "sbfmt/mechanics.h"

typedef struct sbfi_network_matrix {
  const sbf_spring_network *network;
  sbfi_tetrahedron *elements; /* (tetrahedron_count), volume 0 where the network has none */
  double *rest_lengths;       /* (spring_count) m */
  uint32_t *block_indices;    /* (tetrahedron_count x 16 + spring_count x 4) blocks in the matrix */
  sbfi_block_matrix matrix;
} sbfi_network_matrix;

/* The pattern, and what does not change with the places; `rest_lengths` (spring_count), NULL: the distances
 * at rest. Memory of `arena`, but for the network, which must stay. False where memory runs out. */
bool sbfi_network_matrix_make(sbfi_network_matrix *made, const sbf_spring_network *network,
    const float *rest_lengths, sbfi_arena *arena);

/* Takes the network's moduli anew. */
void sbfi_network_matrix_refresh(sbfi_network_matrix *m);

/* The matrix at the places (3 x point_count), prepared for the sweep. Of a spring that is pressed, what
 * resists sideways, negatively, is left out. */
void sbfi_network_matrix_fill(sbfi_network_matrix *m, const double *positions);

#endif
