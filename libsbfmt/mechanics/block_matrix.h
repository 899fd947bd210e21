/* Sparse symmetric matrices of 3 x 3 blocks, with one block row per point. */
#ifndef SBFI_BLOCK_MATRIX_H
#define SBFI_BLOCK_MATRIX_H

#include "base/memory.h"
#include "mechanics/vector.h"

typedef struct sbfi_block_matrix {
  uint32_t row_count;
  const uint32_t *begins;    /* (row_count + 1) first block of each row */
  const uint32_t *columns;   /* (begins[row_count]) ascending within a row; every row has its diagonal */
  double *blocks;            /* (begins[row_count] x 9) row-major within a block */
  double *inverses;          /* (row_count x 9) of the diagonal blocks */
  const uint32_t *diagonals; /* (row_count) indices of the diagonal blocks */
} sbfi_block_matrix;

/* Creates the pattern of the pairs (row << 32 | column), in any order, with duplicates; diagonals are
 * added. Sorts `pairs`. Blocks are 0. False if memory runs out. */
bool sbfi_block_matrix_make(
    sbfi_block_matrix *matrix, uint32_t row_count, uint64_t *pairs, size_t pair_count, sbfi_arena *arena);
/* Index of an existing block of the pattern. */
uint32_t sbfi_block_matrix_find(const sbfi_block_matrix *matrix, uint32_t row, uint32_t column);

/* y = A x, vectors (3 x row_count). */
void sbfi_block_matrix_multiply(const sbfi_block_matrix *matrix, const double *x, double *y);
/* Inverts the diagonal blocks, which must be positive definite; others become 0, and the sweep ignores
 * their rows. */
void sbfi_block_matrix_prepare(sbfi_block_matrix *matrix);
/* z = M^-1 r with M = (D + L) D^-1 (D + U): symmetric Gauss-Seidel, positive definite for every matrix. */
void sbfi_block_matrix_sweep(const sbfi_block_matrix *matrix, const double *r, double *z);

#endif
