/* The stiffness matrix of a network in matrix-free form: only products with vectors. Vectors are (3 *
 * point_count); pinned points count as zero and receive nothing. */
#ifndef SBFI_NETWORK_H
#define SBFI_NETWORK_H

#include "mechanics/neo_hookean.h"
#include "sbfmt/mechanics.h"

/* y = S K S x with S = diag(scale), (point_count) factors, or K x if `scale` is NULL. */
void sbfi_network_apply(const sbf_spring_network *network, const double *scale, const double *x, double *y);

/* Fields without stiffness, such as rigid motions of a free body: a solve excludes them. */
typedef struct sbfi_null_fields {
  void (*project)(const void *user, double *v); /* removes them from v; NULL: there are none */
  const void *user;
} sbfi_null_fields;

/* Solves S K S y = r by conjugate gradients from y = 0, until the residual is `tolerance` of r, the
 * iteration limit, or a direction without stiffness. `r` becomes the residual; `work` is (6 *
 * point_count). */
void sbfi_network_solve(const sbf_spring_network *network, const double *scale, sbfi_null_fields null_fields,
    double tolerance, uint32_t iterations, double *r, double *y, double *work);

/* A tetrahedron of the network; false if it is degenerate. */
bool sbfi_network_tetrahedron(const sbf_spring_network *network, uint32_t t, sbfi_tetrahedron *made);

double sbfi_dot(const double *a, const double *b, size_t count);

#endif
