/* Two doubles in one SIMD register if available, for things that come in pairs. Lanes never mix, and each
 * operation is the IEEE one, so the bits equal those of scalar code. Elsewhere a plain double, with
 * SBRI_TWINS 1. The operators + - * / work on them. */
#ifndef SBRI_TWIN_H
#define SBRI_TWIN_H

#if defined(__GNUC__)
enum { SBRI_TWINS = 2 };
/* Aligned like a double. */
typedef double sbri_twin __attribute__((vector_size(16), aligned(8)));

static inline sbri_twin sbri_twin_of(double a, double b) {
  return (sbri_twin){a, b};
}
static inline double sbri_twin_at(sbri_twin a, int lane) {
  return a[lane];
}
#else
enum { SBRI_TWINS = 1 };
typedef double sbri_twin;

static inline sbri_twin sbri_twin_of(double a, double b) {
  (void)b;
  return a;
}
static inline double sbri_twin_at(sbri_twin a, int lane) {
  (void)lane;
  return a;
}
#endif

#endif
