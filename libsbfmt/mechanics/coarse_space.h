/* A coarse space for solving with a sparse matrix of 3 x 3 blocks: what smooth errors are taken out by.
 *
 * The points are gathered into some fifty patches or more that hang together by the matrix' pattern, and the
 * space is that of each patch moving as one rigid piece (aggregation as in Vanek, Mandel and Brezina,
 * Algebraic multigrid by smoothed aggregation for second and fourth order elliptic problems, Computing 56,
 * 1996, without its smoothing). The matrix on it is small and dense, and factored once. */
#ifndef SBFI_COARSE_SPACE_H
#define SBFI_COARSE_SPACE_H

#include "mechanics/block_matrix.h"
#include "sbfmt/mechanics.h"

typedef struct sbfi_coarse_space {
  uint32_t point_count, patch_count;
  uint32_t *patches; /* (point_count) UINT32_MAX: in none */
  sbfi_d3 *arms;     /* (point_count) from the middle of its patch, over the patch's reach */
  double *factor;    /* (6 x patch_count)^2 lower triangle, L D L^T; 0 on the diagonal: left out */
  double *values;    /* (6 x patch_count) scratch */
} sbfi_coarse_space;

/* Whether one is of use: for a lattice of some size. Springs mostly tie points to held ones, so that errors
 * are not smooth, or hang together in so many pieces that the patches are as many as the points. */
bool sbfi_coarse_space_helps(const sbf_spring_network *network);

/* Of the rows that have something on their diagonal. False where memory runs out. */
bool sbfi_coarse_space_make(
    sbfi_coarse_space *space, const sbfi_block_matrix *matrix, const sbf_vec3 *positions, sbfi_arena *arena);

/* Takes in new blocks of the same pattern; what is on a diagonal then must be there now. */
void sbfi_coarse_space_fill(sbfi_coarse_space *space, const sbfi_block_matrix *matrix);

/* z += P (P^T A P)^-1 P^T r, vectors (3 x point_count). */
void sbfi_coarse_space_add(const sbfi_coarse_space *space, const double *r, double *z);

#endif
