/* Small displacements of a network under forces, many forces one after the other: the second derivatives at
 * rest are put together once (network_matrix.h), and each solution is found by conjugate gradients,
 * preconditioned by a symmetric Gauss-Seidel sweep and, where there are many points, a coarse space
 * (coarse_space.h), or by a factorisation (direct_solver.h). */
#ifndef SBFI_LINEAR_STATICS_H
#define SBFI_LINEAR_STATICS_H

#include "mechanics/coarse_space.h"
#include "mechanics/direct_solver.h"
#include "mechanics/network_matrix.h"

typedef struct sbfi_linear_statics {
  sbfi_network_matrix stiffness;
  bool coarse; /* `space` is there */
  sbfi_coarse_space space;
  bool is_direct; /* `direct` is there */
  sbfi_direct_solver direct;
  double *r, *z, *p, *q; /* (3 x points) */
} sbfi_linear_statics;

/* A point whose elements leave it free to move along some way, as one that hangs on a single spring, counts
 * as held there with a tenth of what they resist with. Memory of `arena`, but for the network, which must
 * stay. False where memory runs out. */
bool sbfi_linear_statics_make(
    sbfi_linear_statics *made, const sbf_spring_network *network, sbfi_arena *arena);

/* The same with a factorisation where there are few points. Where some motion of theirs meets no resistance,
 * solutions are by conjugate gradients all the same. */
bool sbfi_linear_statics_make_direct(
    sbfi_linear_statics *made, const sbf_spring_network *network, sbfi_arena *arena);

/* Takes in what has changed of the network's moduli and stiffnesses. */
void sbfi_linear_statics_refresh(sbfi_linear_statics *statics);

/* `displacements` (3 x points) m: in where to start, 0 at held points; out the answer to the forces (3 x
 * points) N, whose part at held points does not count. Goes on until the work that is still missing is about
 * `fraction`^2 of all, so that displacements are right to `fraction` on the whole, or for 200 steps. Returns
 * the number of steps; 1 of a factorised matrix, whose answer is exact wherever it starts. */
uint32_t sbfi_linear_statics_solve(
    sbfi_linear_statics *statics, const double *forces, double fraction, double *displacements);

#endif
