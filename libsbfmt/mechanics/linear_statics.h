/* Small displacements of a network under many successive forces. The second derivatives at rest are
 * assembled once (network_matrix.h). Each solution uses conjugate gradients, preconditioned by a symmetric
 * Gauss-Seidel sweep and, for many points, a coarse space (coarse_space.h), or a factorization
 * (direct_solver.h). */
#ifndef SBFI_LINEAR_STATICS_H
#define SBFI_LINEAR_STATICS_H

#include "mechanics/coarse_space.h"
#include "mechanics/direct_solver.h"
#include "mechanics/network_matrix.h"

typedef struct sbfi_linear_statics {
  sbfi_network_matrix stiffness;
  bool coarse; /* `space` is in use */
  sbfi_coarse_space space;
  bool is_direct; /* `direct` is in use */
  sbfi_direct_solver direct;
  double *r, *z, *p, *q; /* (3 x points) */
} sbfi_linear_statics;

/* A point whose elements leave a direction free, such as one on a single spring, gets a tenth of their
 * stiffness in that direction. Allocates from `arena`. The network must outlive the result. False if
 * memory runs out. */
bool sbfi_linear_statics_make(
    sbfi_linear_statics *made, const sbf_spring_network *network, sbfi_arena *arena);

/* The same with a factorization for few points. If some motion has no stiffness, it still uses conjugate
 * gradients. */
bool sbfi_linear_statics_make_direct(
    sbfi_linear_statics *made, const sbf_spring_network *network, sbfi_arena *arena);

/* Updates the network's moduli and stiffnesses. */
void sbfi_linear_statics_refresh(sbfi_linear_statics *statics);

/* `displacements` (3 x points) m: in the initial guess, 0 at pinned points; out the response to the forces
 * (3 x points) N, ignored at pinned points. Iterates until the missing work is about `fraction`^2 of the
 * total, so that displacements are accurate to `fraction` overall, or for 200 steps. Returns the number of
 * steps; 1 for a factorized matrix, which is exact for every initial guess. */
uint32_t sbfi_linear_statics_solve(
    sbfi_linear_statics *statics, const double *forces, double fraction, double *displacements);

#endif
