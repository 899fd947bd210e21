/* Two numbers of double precision side by side, where the machine has registers for such, for what comes in
 * pairs: lanes never mix, and each operation is the IEEE one, so that the bits are those of one after the
 * other. Elsewhere a plain double, SBRI_TWINS being 1. The ordinary operators + - * / work between them. */
#ifndef SBRI_TWIN_H
#define SBRI_TWIN_H

#if defined(__GNUC__)
enum { SBRI_TWINS = 2 };
/* May lie anywhere that a double may. */
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
