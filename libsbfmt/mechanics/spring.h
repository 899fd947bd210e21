/* Spring between two points: E = k/2 (l - l0)^2, with k in N/m and l0 in m, scaled by a fraction for l < l0;
 * with damping also a force of c times the rate of lengthening.
 *
 * Reference for all schemes, the tests and `build`. The schemes' own kernels process eight lanes at once
 * and are tested against it. */
#ifndef SBFI_SPRING_H
#define SBFI_SPRING_H

#include <math.h>

#include "sbfmt/base.h"

typedef struct sbfi_spring {
  uint32_t a, b; /* its ends */
  float stiffness_n_m, rest_length_m, damping_ns_m;
  float slack; /* reduction of the stiffness below the rest length: 1 - compression_ratio */
} sbfi_spring;

/* N/m at that length. */
static inline float sbfi_spring_stiffness(const sbfi_spring *s, float length_m) {
  return length_m < s->rest_length_m ? s->stiffness_n_m - s->stiffness_n_m * s->slack : s->stiffness_n_m;
}

/* (l - l0) / l0; for a rest length of 0 the length itself, as strain relative to one metre. */
static inline float sbfi_spring_strain(const sbfi_spring *s, float length_m) {
  return s->rest_length_m > 0 ? (length_m - s->rest_length_m) / s->rest_length_m : length_m;
}

static inline double sbfi_spring_energy(const sbfi_spring *s, double length_m) {
  double stretch = length_m - s->rest_length_m;
  double fraction = stretch < 0 ? 1 - (double)s->slack : 1;
  return 0.5 * fraction * s->stiffness_n_m * stretch * stretch;
}

/* Factor on the vector from end a to end b that gives the force on a, which is minus that on b. 0 for a
 * spring of length 0. */
static inline float sbfi_spring_force_factor(const sbfi_spring *s, float length_m) {
  float k = sbfi_spring_stiffness(s, length_m);
  return length_m > 0 ? k - k * s->rest_length_m / length_m : 0;
}

/* Limits of a spring's strain, as in attributes and spring_set. */
typedef struct sbfi_spring_bounds {
  float strain_min, strain_max;  /* -1 and 0: no bound */
  float yield_strain, yield_1_s; /* beyond it the rest length flows at that rate; either 0: never */
  float tear_strain;             /* beyond it the spring breaks; 0: never */
} sbfi_spring_bounds;

/* Rest length at which the strain equals the yield strain, or the current one if it is below. */
static inline float sbfi_spring_yielded(float rest_length_m, float length_m, float yield_strain) {
  float strain = rest_length_m > 0 ? (length_m - rest_length_m) / rest_length_m : length_m;
  if (strain > yield_strain) return length_m / (1 + yield_strain);
  if (strain < -yield_strain && yield_strain < 1) return length_m / (1 - yield_strain);
  return rest_length_m;
}

/* Energy of all springs at `positions` (x, y, z of point i at positions[stride * i]), in list order. */
double sbfi_springs_energy(
    const sbfi_spring *springs, size_t spring_count, const float *positions, size_t stride);

#endif
