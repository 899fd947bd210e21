/* Direct solution with a sparse symmetric matrix of 3 x 3 blocks, for matrices so small that one
 * factorisation and many solutions cost less than many runs of conjugate gradients: L D L^T within the
 * envelope (Jennings, A compact storage scheme for the solution of symmetric linear simultaneous equations,
 * The Computer Journal 9, 1966), the points numbered by reverse Cuthill-McKee. */
#ifndef SBFI_DIRECT_SOLVER_H
#define SBFI_DIRECT_SOLVER_H

#include "mechanics/block_matrix.h"

typedef struct sbfi_direct_solver {
  uint32_t size;        /* rows, 3 a point that takes part */
  uint32_t point_count; /* points that take part: those with something on their diagonal */
  uint32_t *points;     /* (point_count) of the matrix, in the order of elimination */
  uint32_t *order;      /* (points of the matrix) place in `points`; UINT32_MAX: takes no part */
  uint32_t *firsts;     /* (size) column where the row's envelope begins */
  size_t *begins;       /* (size) where the row's envelope begins in `factor` */
  double *factor;       /* L within the envelope, D on the diagonal; 0 on the diagonal: nothing resists */
  double *values;       /* (size) scratch */
  uint32_t null_count;  /* zeros on the diagonal: motions that nothing resists */
} sbfi_direct_solver;

/* Whether the factorisation of a matrix of so many points pays off. */
bool sbfi_direct_solver_helps(uint32_t point_count);

/* Orders the points and factorises. Memory of `arena`; false where it runs out. */
bool sbfi_direct_solver_make(sbfi_direct_solver *solver, const sbfi_block_matrix *matrix, sbfi_arena *arena);

/* Factorises new blocks of the same pattern. */
void sbfi_direct_solver_refresh(sbfi_direct_solver *solver, const sbfi_block_matrix *matrix);

/* x = A^-1 b, vectors (3 x points of the matrix). 0 where a point takes no part, and where nothing resists:
 * forces that do work on a motion that nothing resists have no solution. */
void sbfi_direct_solver_solve(const sbfi_direct_solver *solver, const double *b, double *x);

#endif
