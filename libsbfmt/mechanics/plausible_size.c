#include "mechanics/plausible_size.h"

#include <math.h>

static const double TALLEST_M = 30, SMALLEST_M = 0.005;

double sbfi_asset_extent(const sbf_asset *asset) {
  sbf_asset_measures is;
  sbf_asset_measure(asset, &is);
  if (!is.bounded) return 0;
  return fmax((double)is.high.x - is.low.x, fmax((double)is.high.y - is.low.y, (double)is.high.z - is.low.z));
}

double sbfi_plausible_scale(double size_m) {
  if (!(size_m > 0) || !isfinite(size_m) || (size_m >= SMALLEST_M && size_m <= TALLEST_M)) return 1;
  double step = size_m > TALLEST_M ? 0.1 : 10, scale = step * step;
  while (size_m * scale > TALLEST_M || size_m * scale < SMALLEST_M) scale *= step;
  return scale;
}
