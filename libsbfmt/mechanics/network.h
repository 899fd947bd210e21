/* The stiffness matrix of a network, never written down: only its product with a vector. Vectors are
 * (3 * point_count); held points count as unmoved and receive nothing. */
#ifndef SBFI_NETWORK_H
#define SBFI_NETWORK_H

#include "mechanics/neo_hookean.h"
#include "sbfmt/mechanics.h"

/* y = S K S x with S = diag(scale), (point_count) factors, or K x where `scale` is NULL. */
void sbfi_network_apply(const sbf_spring_network *network, const double *scale, const double *x, double *y);

/* Fields that nothing resists, as the rigid motions of a free body: a solve leaves them out. */
typedef struct sbfi_null_fields {
  void (*project)(const void *user, double *v); /* takes them out of v; NULL: there are none */
  const void *user;
} sbfi_null_fields;

/* Solves S K S y = r by conjugate gradients from y = 0, until the residual is `tolerance` of r, or after so
 * many iterations, or where r pulls at something that nothing resists. `r` becomes the residual; `work` is
 * (6 * point_count). */
void sbfi_network_solve(const sbf_spring_network *network, const double *scale, sbfi_null_fields null_fields,
    double tolerance, uint32_t iterations, double *r, double *y, double *work);

/* The tetrahedron as the network has it; false where it is none. */
bool sbfi_network_tetrahedron(const sbf_spring_network *network, uint32_t t, sbfi_tetrahedron *made);

double sbfi_dot(const double *a, const double *b, size_t count);

#endif
