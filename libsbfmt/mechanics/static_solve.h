/* Where a network of springs and tetrahedra comes to rest under constant forces, large strains included.
 *
 * Newton's method on the energy, each step's linear system by preconditioned conjugate gradients (Nocedal and
 * Wright, Numerical Optimization, algorithm 7.1, line search Newton-CG): the second derivatives are put
 * together as a sparse matrix of 3 x 3 blocks, the preconditioner is one symmetric Gauss-Seidel sweep over it
 * and, for lattices of some size, a coarse space (coarse_space.h)
 * (the diagonal blocks of neo_hookean.h are always positive definite, those of springs are made so), and a
 * direction of negative curvature ends the iteration with what was found, which always leads downhill.
 * Backtracking keeps the energy falling.
 *
 * Double precision, one thread, no libm beyond the square root: the same bits on every machine. A network
 * that nothing holds, or whose load nothing balances, does not converge, and its residual says so. */
#ifndef SBFI_STATIC_SOLVE_H
#define SBFI_STATIC_SOLVE_H

#include "base/progress.h"
#include "sbfmt/mechanics.h"

typedef struct sbfi_static_problem {
  /* `positions` are the places at rest, `masses` tell the held points (0) and weigh the rest, anchors pull
   * towards `positions`. Tetrahedra follow mechanics/neo_hookean.h. */
  const sbf_spring_network *network;
  const float *rest_lengths; /* (spring_count) m; NULL: the distances at rest */
  sbf_vec3 gravity;          /* m/s^2, on every free point's mass */
  const double *forces;   /* (3 x point_count) N beside that; those on held points do not act; NULL: none */
  double tolerance;       /* residual forces' share of the load; 0: 1e-8 */
  uint32_t max_steps;     /* of Newton's method; 0: 100 */
  uint32_t max_products;  /* of the matrix with a vector, in all; 0: as many as it takes */
  sbfi_progress progress; /* told the share of the steps; where it ends the work, that is not converged */
} sbfi_static_problem;

typedef struct sbfi_static_outcome {
  bool converged;
  bool ended;        /* by `progress` */
  double residual;   /* length of the forces that remain over that of the load, or, without a load, over those
                        of the start */
  double energy_j;   /* elastic less the load's work, from the positions at rest */
  double min_ratio;  /* least J of the tetrahedra, 1 where there are none: below 0 something is inside out */
  uint32_t steps;    /* of Newton's method */
  uint32_t products; /* of the matrix with a vector, in all */
} sbfi_static_outcome;

/* `positions` (3 x point_count) m: in where to start, held points where they are held (which need not be
 * where they rest); out the equilibrium. False where memory runs out; not converging is no failure.  */
bool sbfi_static_solve(const sbfi_static_problem *problem, double *positions, sbfi_static_outcome *outcome,
    const sbf_allocator *allocator);

/* The start: `positions` (3 x point_count) at rest. */
void sbfi_static_start(const sbf_spring_network *network, double *positions);

#endif
