/* Direct solver for a sparse symmetric matrix of 3 x 3 blocks, for matrices so small that one
 * factorization and many solutions cost less than many conjugate gradient solutions: L D L^T within the
 * envelope (Jennings, A compact storage scheme for the solution of symmetric linear simultaneous
 * equations, The Computer Journal 9, 1966), with points in reverse Cuthill-McKee order. */
#ifndef SBFI_DIRECT_SOLVER_H
#define SBFI_DIRECT_SOLVER_H

#include "mechanics/block_matrix.h"

typedef struct sbfi_direct_solver {
  uint32_t size;        /* rows, 3 per included point */
  uint32_t point_count; /* included points: those with a nonzero diagonal */
  uint32_t *points;     /* (point_count) indices in the matrix, in the order of elimination */
  uint32_t *order;      /* (points of the matrix) index into `points`; UINT32_MAX: excluded */
  uint32_t *firsts;     /* (size) first column of the row's envelope */
  size_t *begins;       /* (size) start of the row's envelope in `factor` */
  double *factor;       /* L within the envelope, D on the diagonal; 0 on the diagonal: no stiffness */
  double *values;       /* (size) scratch */
  uint32_t null_count;  /* zeros on the diagonal: motions without stiffness */
} sbfi_direct_solver;

/* Whether the factorization of a matrix with this many points pays off. */
bool sbfi_direct_solver_helps(uint32_t point_count);

/* Orders the points and factorizes. Allocates from `arena`; false if memory runs out. */
bool sbfi_direct_solver_make(sbfi_direct_solver *solver, const sbfi_block_matrix *matrix, sbfi_arena *arena);

/* Factorizes new blocks of the same pattern. */
void sbfi_direct_solver_refresh(sbfi_direct_solver *solver, const sbfi_block_matrix *matrix);

/* x = A^-1 b, vectors (3 x points of the matrix). 0 at excluded points and for motions without stiffness:
 * forces that do work on such a motion have no solution. */
void sbfi_direct_solver_solve(const sbfi_direct_solver *solver, const double *b, double *x);

#endif
