#include "mechanics/angle.h"

#include <math.h>
#include <stdbool.h>

double sbfi_angle(double y, double x) {
  double along = fabs(x), across = fabs(y);
  bool steep = across > along;
  double high = steep ? across : along;
  if (high == 0) return 0;
  double z = (steep ? along : across) / high;
  /* Halves the angle twice; the rest is small enough for a short series. */
  z = z / (1 + sqrt(1 + z * z));
  z = z / (1 + sqrt(1 + z * z));
  double q = z * z, series = 1.0 / 13;
  for (int k = 11; k > 0; k -= 2) series = 1.0 / k - q * series;
  double angle = 4 * z * series;
  if (steep) angle = SBFI_PI / 2 - angle;
  if (x < 0) angle = SBFI_PI - angle;
  return y < 0 ? -angle : angle;
}
