/* Eigenvalues of small symmetric matrices. */
#ifndef SBFI_SYMMETRIC_EIGEN_H
#define SBFI_SYMMETRIC_EIGEN_H

/* Diagonalizes the symmetric n x n `matrix` (row-major, overwritten: eigenvalues on the diagonal) by
 * cyclic Jacobi rotations; column i of `vectors` (n x n) is the unit eigenvector of matrix[i][i]. */
void sbfi_symmetric_compute_eigen(int n, double *matrix, double *vectors);

#endif
