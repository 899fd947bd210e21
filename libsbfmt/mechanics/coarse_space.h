/* Coarse space for solvers with a sparse matrix of 3 x 3 blocks; it removes smooth errors.
 *
 * Points are grouped into at least about fifty patches connected by the matrix' pattern; each patch moves
 * as a rigid body (aggregation as in Vanek, Mandel and Brezina, Algebraic multigrid by smoothed
 * aggregation for second and fourth order elliptic problems, Computing 56, 1996, without the smoothing).
 * The coarse matrix is small and dense and is factorized once. */
#ifndef SBFI_COARSE_SPACE_H
#define SBFI_COARSE_SPACE_H

#include "mechanics/block_matrix.h"
#include "sbfmt/mechanics.h"

typedef struct sbfi_coarse_space {
  uint32_t point_count, patch_count;
  uint32_t *patches; /* (point_count) UINT32_MAX: no patch */
  sbfi_d3 *arms;     /* (point_count) from the centre of its patch, divided by the patch's radius */
  double *factor;    /* (6 x patch_count)^2 lower triangle, L D L^T; 0 on the diagonal: ignored */
  double *values;    /* (6 x patch_count) scratch */
} sbfi_coarse_space;

/* Whether a coarse space is useful: for lattices of some size. Springs mostly connect points to pinned
 * ones, so errors are not smooth, or form so many pieces that there are as many patches as points. */
bool sbfi_coarse_space_helps(const sbf_spring_network *network);

/* Uses rows with a nonzero diagonal. False if memory runs out. */
bool sbfi_coarse_space_make(
    sbfi_coarse_space *space, const sbfi_block_matrix *matrix, const sbf_vec3 *positions, sbfi_arena *arena);

/* Updates the blocks; the pattern and the set of nonzero diagonals must be unchanged. */
void sbfi_coarse_space_fill(sbfi_coarse_space *space, const sbfi_block_matrix *matrix);

/* z += P (P^T A P)^-1 P^T r, vectors (3 x point_count). */
void sbfi_coarse_space_add(const sbfi_coarse_space *space, const double *r, double *z);

#endif
