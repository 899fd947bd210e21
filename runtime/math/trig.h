/* Sine, cosine, arc tangent and exponential from arithmetic alone, so that they give the same bits
 * everywhere. Reductions and polynomials after Moshier, Methods and Programs for Mathematical Functions
 * (1989); the errors stated are the largest found in a sweep against double precision. */
#ifndef SBRI_TRIG_H
#define SBRI_TRIG_H

/* |error| <= 2e-7 for |angle| <= 8192 rad; beyond it the angle is reduced less exactly. */
void sbri_sincos(float angle_rad, float *sine, float *cosine);

/* Angle of (x, y) in (-pi, pi]; |error| <= 4e-7. 0 for the origin. */
float sbri_atan2(float y, float x);

/* Arc cosine, the argument clamped to [-1, 1]; |error| <= 1e-6. */
float sbri_acos(float x);

/* e^x; relative error <= 3e-7 for -87 <= x <= 88, else 0 or the largest float. */
float sbri_exp(float x);

#endif
