/* Sine, cosine, arc tangent and exponential with the same bits on every machine: range reduction and
 * truncated power series in double precision, rounded once. NaN gives NaN. */
#ifndef SBRI_TRIG_H
#define SBRI_TRIG_H

/* Within 1 unit in the last place for |angle| <= 1000 rad, within 1e-7 up to 1e9; beyond that the results for
 * 0. */
void sbri_sincos(float angle_rad, float *sine, float *cosine);

/* Angle of (x, y) in (-pi, pi], within 1 unit in the last place. 0 for the origin. */
float sbri_atan2(float y, float x);

/* Arc cosine, the argument clamped to [-1, 1], within 1 unit in the last place. */
float sbri_acos(float x);

/* Natural logarithm within 1 unit in the last place; -87 for 0 and less. */
float sbri_log(float x);

/* a - b, wrapped to [-pi, pi] from at most one turn beyond it. */
float sbri_angle_between(float a, float b);

/* e^x within 1 unit in the last place; 0 below -87, the largest float above 88.7. */
float sbri_exp(float x);

#endif
