/* Rotations, x y z w, unit length, in double precision. */
#ifndef SBFI_QUATD_H
#define SBFI_QUATD_H

/* b first; `to` may alias either */
void sbfi_quatd_multiply(const double a[4], const double b[4], double to[4]);
void sbfi_quatd_conjugate(const double a[4], double to[4]);
void sbfi_quatd_rotate(const double a[4], const double v[3], double to[3]);
/* Shortest rotation from one unit vector to another. */
void sbfi_quatd_between(const double from[3], const double to[3], double rotation[4]);
/* Along the shorter arc at constant speed; t from 0 to 1. Bit-identical on every machine. */
void sbfi_quatd_slerp(const double a[4], const double b[4], double t, double to[4]);

#endif
