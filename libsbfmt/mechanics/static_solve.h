/* Static equilibrium of a network of springs and tetrahedra under constant forces, including large strains.
 *
 * Newton's method on the energy with preconditioned conjugate gradients for the linear systems (Nocedal and
 * Wright, Numerical Optimization, algorithm 7.1, line search Newton-CG). The second derivatives are a sparse
 * matrix of 3 x 3 blocks. The preconditioner is one symmetric Gauss-Seidel sweep and, for lattices of some
 * size, a coarse space (coarse_space.h). The diagonal blocks of neo_hookean.h are always positive definite;
 * the springs' blocks are made so. A direction of negative curvature ends the iteration with the current
 * result, which is always a descent direction. Backtracking ensures that the energy decreases.
 *
 * Double precision, one thread, only the square root from libm: the same bits on every machine. A network
 * without pins or with an unbalanced load does not converge, which its residual shows. */
#ifndef SBFI_STATIC_SOLVE_H
#define SBFI_STATIC_SOLVE_H

#include "base/progress.h"
#include "sbfmt/mechanics.h"

typedef struct sbfi_static_problem {
  /* `positions` are the rest positions. `masses` are 0 for pinned points and weight the others. Anchors
   * pull towards `positions`. Tetrahedra follow mechanics/neo_hookean.h. */
  const sbf_spring_network *network;
  const float *rest_lengths; /* (spring_count) m; NULL: the distances at rest */
  sbf_vec3 gravity;          /* m/s^2, acts on the mass of all free points */
  const double *forces;      /* (3 x point_count) N, additional; ignored on pinned points; NULL: none */
  double tolerance;          /* residual as a fraction of the load; 0: 1e-8 */
  uint32_t max_steps;        /* of Newton's method; 0: 100 */
  uint32_t max_products;     /* total matrix-vector products; 0: unlimited */
  /* receives the fraction of the steps; if it cancels, the result has not converged */
  sbfi_progress progress;
} sbfi_static_problem;

typedef struct sbfi_static_outcome {
  bool converged;
  bool ended;        /* by `progress` */
  double residual;   /* length of the remaining forces relative to the load, or without a load to the initial
                        forces */
  double energy_j;   /* elastic energy minus the load's work, relative to the rest positions */
  double min_ratio;  /* smallest J of the tetrahedra, 1 if there are none; below 0 some are inverted */
  uint32_t steps;    /* of Newton's method */
  uint32_t products; /* total matrix-vector products */
} sbfi_static_outcome;

/* `positions` (3 x point_count) m: in the initial guess, with pinned points at their positions (which may
 * differ from rest); out the equilibrium. False if memory runs out; missing convergence is not a failure. */
bool sbfi_static_solve(const sbfi_static_problem *problem, double *positions, sbfi_static_outcome *outcome,
    const sbf_allocator *allocator);

/* Initial guess: `positions` (3 x point_count) at rest. */
void sbfi_static_start(const sbf_spring_network *network, double *positions);

#endif
