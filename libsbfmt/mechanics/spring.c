#include "mechanics/spring.h"

double sbfi_springs_energy(
    const sbfi_spring *springs, size_t spring_count, const float *positions, size_t stride) {
  double energy = 0;
  for (size_t i = 0; i < spring_count; i++) {
    const float *a = positions + stride * springs[i].a, *b = positions + stride * springs[i].b;
    double x = (double)b[0] - a[0], y = (double)b[1] - a[1], z = (double)b[2] - a[2];
    energy += sbfi_spring_energy(&springs[i], sqrt(x * x + y * y + z * z));
  }
  return energy;
}
