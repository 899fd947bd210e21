#include "mechanics/bearing_modulus.h"

#include <math.h>

static const double GRAVITY = 9.81; /* m/s^2 */
static const double MOST_STRAIN = 0.05;

/* Of two digits, so that it reads as the round figure it is. */
static double rounded_up(double value) {
  double unit = 1;
  while (value / unit >= 100) unit *= 10;
  return ceil(value / unit) * unit;
}

double sbfi_modulus_to_bear(double modulus, double density, double height, double strain) {
  double needed = density * GRAVITY * height / strain;
  return needed > modulus && needed <= 1e30 ? rounded_up(needed) : modulus;
}

double sbfi_bearing_modulus(const sbf_attributes *attributes, const sbf_vec3_list *surface) {
  double modulus = (double)attributes->young_modulus;
  if (surface->count == 0) return modulus;
  sbf_vec3 low = surface->at[0], high = surface->at[0];
  for (uint32_t i = 1; i < surface->count; i++) {
    sbf_vec3 p = surface->at[i];
    low = (sbf_vec3){fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z)};
    high = (sbf_vec3){fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z)};
  }
  double height = fmax(fmax((double)high.x - low.x, (double)high.y - low.y), (double)high.z - low.z);
  return sbfi_modulus_to_bear(modulus, (double)attributes->density, height, MOST_STRAIN);
}
