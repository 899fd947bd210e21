/* Computes angles with square roots only, so that every machine gives the same bits. */
#ifndef SBFI_ANGLE_H
#define SBFI_ANGLE_H

#define SBFI_PI 3.14159265358979323846

/* Angle from the x axis to (x, y), in (-pi, pi], to 1e-11; 0 at the origin. */
double sbfi_angle(double y, double x);

#endif
