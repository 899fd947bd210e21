/* Sparse symmetric matrices of 3 x 3 blocks, a row of blocks for each point. */
#ifndef SBFI_BLOCK_MATRIX_H
#define SBFI_BLOCK_MATRIX_H

#include "base/memory.h"
#include "mechanics/vector.h"

typedef struct sbfi_block_matrix {
  uint32_t row_count;
  const uint32_t *begins;    /* (row_count + 1) places of each row's blocks */
  const uint32_t *columns;   /* (begins[row_count]) rising within a row; every row has its diagonal */
  double *blocks;            /* (begins[row_count] x 9) row by row within a block */
  double *inverses;          /* (row_count x 9) of the diagonal blocks */
  const uint32_t *diagonals; /* (row_count) places of the diagonal blocks */
} sbfi_block_matrix;

/* The pattern of the pairs, each (row << 32 | column), in any order and repeated; diagonals need not be among
 * them. Sorts `pairs`. Blocks are 0. False where memory runs out. */
bool sbfi_block_matrix_make(
    sbfi_block_matrix *matrix, uint32_t row_count, uint64_t *pairs, size_t pair_count, sbfi_arena *arena);
/* Place of a block that the pattern has. */
uint32_t sbfi_block_matrix_find(const sbfi_block_matrix *matrix, uint32_t row, uint32_t column);

/* y = A x, vectors (3 x row_count). */
void sbfi_block_matrix_multiply(const sbfi_block_matrix *matrix, const double *x, double *y);
/* Inverts the diagonal blocks, which must be positive definite; those that are not become 0, and their rows
 * take no part in the sweep. */
void sbfi_block_matrix_prepare(sbfi_block_matrix *matrix);
/* z = M^-1 r with M = (D + L) D^-1 (D + U): symmetric Gauss-Seidel, positive definite whatever else the
 * matrix is. */
void sbfi_block_matrix_sweep(const sbfi_block_matrix *matrix, const double *r, double *z);

#endif
